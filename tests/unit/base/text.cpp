#include "perimorph/base/text.hpp"

#include <gtest/gtest.h>

#include "perimorph/base/errors.hpp"

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

TEST(Assertion, ThrowsABugWithPlaceConditionAndValues) {
  try {
    const int n = 3;
    PERIMORPH_ASSERT(n < 2, "n is {}", n);
    FAIL() << "nothing was thrown";
  } catch (const Bug& bug) {
    EXPECT_NE(std::string(bug.what()).find("text.cpp:"), std::string::npos);
    EXPECT_NE(std::string(bug.what()).find("n < 2 does not hold: n is 3"), std::string::npos);
  }
}

}  // namespace
}  // namespace perimorph::base
