// Files that cannot be read, and files made to do harm.

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "case_fixture.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

// --- files that cannot be read ---

TEST_F(CaseFile, MissingFile) {
  EXPECT_EQ(error_of_file(file()), file() + ": there is no such file; a case file (.xml) is needed");
}

TEST_F(CaseFile, FileWithoutAName) { EXPECT_EQ(error_of_file(""), "case file: its name is empty"); }

TEST_F(CaseFile, DirectoryForAFile) {
  EXPECT_EQ(error_of_file(folder_), folder_.string() + ": is a directory; a case file (.xml) in it is needed");
}

TEST_F(CaseFile, PipeForAFileDoesNotWait) {
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  EXPECT_THAT(error_of_file(file()), HasSubstr("is not a regular file"));
}

TEST_F(CaseFile, UnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  std::ofstream(file()) << valid;
  std::filesystem::permissions(file(), std::filesystem::perms::none);
  EXPECT_THAT(error_of_file(file()), HasSubstr("cannot be read: Permission denied"));
}

TEST_F(CaseFile, EmptyFile) {
  EXPECT_EQ(error(""), file() + ": is empty; a <ParameterList> is needed");
  EXPECT_EQ(error(" \n\n"), file() + ": is empty; a <ParameterList> is needed");
}

TEST_F(CaseFile, BinaryFile) {
  EXPECT_THAT(error(std::string("\x7f"
                                "ELF\0\0\1",
                                7)),
              HasSubstr("is not a text file; XML in UTF-8 is needed"));
}

TEST_F(CaseFile, HugeFileIsNotRead) {
  std::ofstream(file()) << valid;
  std::filesystem::resize_file(file(), (16 << 20) + 1);  // sparse
  EXPECT_THAT(error_of_file(file()), HasSubstr("is too large (16777217 bytes); a case file (.xml) has at most 16 MiB"));
}

// --- harm ---

TEST_F(CaseFile, BillionLaughsAreNotExpanded) {
  std::string entities = "<!DOCTYPE lolz [<!ENTITY lol0 \"lol\">";
  for (int i = 1; i < 10; ++i) {
    entities += fmt::format("<!ENTITY lol{} \"", i);
    for (int j = 0; j < 10; ++j) entities += fmt::format("&lol{};", i - 1);
    entities += "\">";
  }

  const std::string message = error(entities + "]>\n" + replaced(valid, "\"30000\"", "\"&lol9;\""));

  EXPECT_THAT(message, HasSubstr(":1: found a document type (entities are not expanded)"));
  EXPECT_THAT(message, HasSubstr("/Material/Young's Modulus: found \"&lol9;\", which is not a number"));
}

TEST_F(CaseFile, ExternalEntityIsNotRead) {
  std::ofstream(folder_ / "secret") << "30000";
  const std::string doctype =
      "<!DOCTYPE x [<!ENTITY secret SYSTEM \"file://" + (folder_ / "secret").string() + "\">]>\n";

  const std::string message = error(doctype + replaced(valid, "\"30000\"", "\"&secret;\""));

  EXPECT_THAT(message, HasSubstr("found \"&secret;\", which is not a number"));
}

TEST_F(CaseFile, DeepNestingIsRefused) {
  std::string open, close;
  for (int i = 0; i < 200000; ++i) {
    open += "<ParameterList name=\"a\">";
    close += "</ParameterList>";
  }

  const std::string message = error(
      replaced(valid, R"xml(<ParameterList name="MueLu">)xml", R"xml(<ParameterList name="MueLu">)xml" + open + close));

  EXPECT_THAT(message, HasSubstr(":62: lists are nested too deeply; allowed are 32 levels"));
}

TEST_F(CaseFile, DeepOverrideIsRefused) {
  std::string path = "Solver/MueLu";
  for (int i = 0; i < 50000; ++i) path += "/a";
  EXPECT_THAT(error(valid, {path + "=1"}), HasSubstr("allowed is \"Section/Sub/Name=value\""));
}

TEST_F(CaseFile, DeepOpenTagsAreASyntaxError) {
  std::string open;
  for (int i = 0; i < 200000; ++i) open += "<ParameterList name=\"a\">";
  EXPECT_THAT(error(open), HasSubstr("the XML is broken here"));
}

TEST_F(CaseFile, HugeNameAndValueAreCutInTheMessage) {
  const std::string huge(10 << 20, '1');
  EXPECT_LT(error(replaced(valid, R"xml(value="100")xml", "value=\"" + huge + "\"")).size(), 1000u);
  EXPECT_LT(error(replaced(valid, R"xml(name="Horizon")xml", "name=\"" + huge + "\"")).size(), 1000u);
  EXPECT_LT(error(replaced(valid, "<Parameter " + horizon, "<" + huge)).size(), 1000u);
}

TEST_F(CaseFile, ControlCharactersDoNotReachTheTerminal) {
  EXPECT_THAT(error(replaced(valid, R"xml(value="1.5")xml", "value=\"\x1b[31m\"")), HasSubstr("found \"?[31m\""));
}

}  // namespace
