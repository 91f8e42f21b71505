#include "perimorph/base/text.hpp"

#include <gtest/gtest.h>

namespace perimorph::base {
namespace {

TEST(DidYouMean, OffersTheNearestName) {
  EXPECT_EQ(did_you_mean("Horizn", {"Horizon", "Micromodulus"}), " - did you mean \"Horizon\"?");
  EXPECT_EQ(did_you_mean("lift", {"right", "left"}), " - did you mean \"left\"?");
  EXPECT_EQ(did_you_mean("rihgt", {"right", "left"}), " - did you mean \"right\"?");
}

TEST(DidYouMean, IgnoresCase) { EXPECT_EQ(did_you_mean("LEFT", {"right", "left"}), " - did you mean \"left\"?"); }

TEST(DidYouMean, OffersNothingThatIsFar) {
  EXPECT_EQ(did_you_mean("Horizon", {"Loading", "Output"}), "");
  EXPECT_EQ(did_you_mean("Horizon", {}), "");
}

TEST(DidYouMean, AllowsAThirdOfALongNameToBeWrong) {
  EXPECT_EQ(did_you_mean("abcdefghi", {"abcdefxyz"}), " - did you mean \"abcdefxyz\"?");
  EXPECT_EQ(did_you_mean("abcdefghi", {"abcdewxyz"}), "");
}

TEST(Printable, ShowsWhatWouldSteerATerminal) {
  EXPECT_EQ(printable("a\tb\nc \xc3\xa4 \xe2\x82\xac"), "a\tb\nc \xc3\xa4 \xe2\x82\xac");  // ae, euro
  EXPECT_EQ(printable("\x1b[31mred\x07\r\x7f"), "\\x1b[31mred\\x07\\x0d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(printable("\xc2"), "\xc2");
}

TEST(QuotedList, QuotesEachAndPutsTheSeparatorBetween) {
  EXPECT_EQ(quoted_list({"a", "b c"}), "\"a\", \"b c\"");
  EXPECT_EQ(quoted_list({"a", "b"}, " or "), "\"a\" or \"b\"");
  EXPECT_EQ(quoted_list({}), "");
}

}  // namespace
}  // namespace perimorph::base
