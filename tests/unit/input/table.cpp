#include "perimorph/input/table.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "perimorph/base/errors.hpp"
#include "support/temporary_directory.hpp"

namespace perimorph::input {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class Table : public testing::Test {
 protected:
  std::string file() const { return directory_.path() / "table.csv"; }

  std::vector<TableRow> read(const std::string& text) const {
    std::ofstream(file(), std::ios::binary) << text;
    return read_table(file(), {"time", "value"});
  }

  std::string error(const std::string& text) const {
    try {
      read(text);
    } catch (const base::UserError& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  tests::TemporaryDirectory directory_;
};

TEST_F(Table, RowsAreReadWithTheirLines) {
  const auto rows = read("time [s], force [kN]\r\n0, 0\r\n# a remark\n\n 1.5 ,-2e-3\n+2,7");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_THAT(rows[0].numbers, ElementsAre(0., 0.));
  EXPECT_THAT(rows[1].numbers, ElementsAre(1.5, -2e-3));
  EXPECT_THAT(rows[2].numbers, ElementsAre(2., 7.));
  EXPECT_EQ(rows[1].line, 5);
}

TEST_F(Table, AMarkOfTheEncodingIsNoPartOfTheFirstNumber) {
  EXPECT_THAT(read("\xEF\xBB\xBF"
                   "4,5\n")
                  .at(0)
                  .numbers,
              ElementsAre(4., 5.));
}

TEST_F(Table, AnEmptyFileHasNoRows) { EXPECT_TRUE(read("").empty()); }

TEST_F(Table, WhatIsNoRowIsNamedWithItsLine) {
  const std::string allowed = "; allowed are 2 numbers, separated by commas: time, value";
  EXPECT_EQ(error("0,0\n1;2\n"), file() + ":2: found \"1;2\"" + allowed);
  EXPECT_EQ(error("t,F\n\n0,0,0\n"), file() + ":3: found \"0,0,0\"" + allowed);
  EXPECT_EQ(error("0,0\n1,\n"), file() + ":2: found \"1,\"" + allowed);
  EXPECT_EQ(error("0,zero\n"), file() + ":1: found \"0,zero\"" + allowed);
  EXPECT_EQ(error("0,0\nt,F\n"), file() + ":2: found \"t,F\"" + allowed);
  EXPECT_EQ(error("0,0\n1,1e999\n"), file() + ":2: found \"1,1e999\"" + allowed);
  EXPECT_EQ(error("0,0\n1,nan\n"), file() + ":2: found \"1,nan\"" + allowed);
  EXPECT_THAT(error(std::string("0,0\n1,\x1b[2J\0", 11)), HasSubstr("found \"1,?[2J?\""));
}

TEST_F(Table, WhatIsNoFileIsRefused) {
  EXPECT_THROW(read_table(file(), {"time"}), base::UserError);
  const std::string folder = std::filesystem::path(file()).parent_path();
  try {
    read_table(folder, {"time"});
    FAIL();
  } catch (const base::UserError& error) {
    EXPECT_THAT(error.what(), StartsWith(folder + ": is a directory; a table (.csv) in it is needed"));
  }
}

}  // namespace
}  // namespace perimorph::input
