#include "perimorph/base/errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

namespace perimorph::base {
namespace {

using testing::HasSubstr;

/// What an assertion says of a number that must be below two; "" if it does not look.
std::string complaint_about(int n, bool is_costly) {
  try {
    if (is_costly) {
      PERIMORPH_DEBUG_ASSERT(n < 2, "n is {}", n);
    } else {
      PERIMORPH_ASSERT(n < 2, "n is {}", n);
    }
  } catch (const Bug& bug) {
    return bug.what();
  }
  return "";
}

TEST(Assertion, ThrowsABugWithPlaceRankConditionAndValues) {
  const int rank = Tpetra::getDefaultComm()->getRank();

  const std::string complaint = complaint_about(3, false);

  EXPECT_THAT(complaint, HasSubstr("errors.cpp:"));
  EXPECT_THAT(complaint, HasSubstr(fmt::format(": rank {}: n < 2 does not hold: n is 3", rank)));
  EXPECT_EQ(complaint_about(1, false), "");
}

TEST(Assertion, LooksWhereItIsCostlyOnlyIfTheBuildAsksForIt) {
#ifdef PERIMORPH_DEBUG_ASSERTIONS
  EXPECT_EQ(complaint_about(3, true).empty(), false);
#else
  EXPECT_EQ(complaint_about(3, true), "");
#endif
  EXPECT_EQ(complaint_about(1, true), "");
}

TEST(Assertion, DoesNotEvaluateACostlyConditionElsewhere) {
  int n_evaluated = 0;
  const auto holds = [&] { return ++n_evaluated > 0; };
  PERIMORPH_DEBUG_ASSERT(holds(), "evaluated {} times", n_evaluated);
#ifdef PERIMORPH_DEBUG_ASSERTIONS
  EXPECT_EQ(n_evaluated, 1);
#else
  EXPECT_EQ(n_evaluated, 0);
#endif
}

}  // namespace
}  // namespace perimorph::base
