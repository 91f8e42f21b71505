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

TEST(QuotedList, QuotesEachAndPutsTheSeparatorBetween) {
  EXPECT_EQ(quoted_list({"a", "b c"}), "\"a\", \"b c\"");
  EXPECT_EQ(quoted_list({"a", "b"}, " or "), "\"a\" or \"b\"");
  EXPECT_EQ(quoted_list({}), "");
}

}  // namespace
}  // namespace perimorph::base
