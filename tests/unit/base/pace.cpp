#include "perimorph/base/pace.hpp"

#include <gtest/gtest.h>

#include "perimorph/base/errors.hpp"

namespace perimorph::base {
namespace {

TEST(Pace, StepsOfEqualLengthGiveTheExactTime) {
  Pace pace;
  for (int step = 0; step < 4; ++step) pace.add(2.);
  EXPECT_DOUBLE_EQ(pace.left(6, 0.), 12.);
  EXPECT_DOUBLE_EQ(pace.left(6, 1.5), 10.5);
}

TEST(Pace, AStepThatIsLateIsTakenToGoOnForAsLongAsItIsLate) {
  Pace pace;
  pace.add(2.);
  EXPECT_DOUBLE_EQ(pace.left(3, 100.), 98. + 4.);
  EXPECT_DOUBLE_EQ(pace.left(1, 2.), 0.);
}

TEST(Pace, FollowsAChangeWithinTenSteps) {
  Pace pace;
  for (int step = 0; step < 50; ++step) pace.add(0.);
  for (int step = 0; step < 10; ++step) pace.add(10.);
  EXPECT_NEAR(pace.left(1, 0.), 10., 0.3);
}

TEST(Pace, KnowsNothingBeforeTheFirstStep) { EXPECT_EQ(Pace().left(100, 0.), 0.); }

TEST(Duration, IsShortAndInTheUnitThatFits) {
  EXPECT_EQ(duration(0.), "0 s");
  EXPECT_EQ(duration(0.2), "1 s");
  EXPECT_EQ(duration(40.), "40 s");
  EXPECT_EQ(duration(59.8), "1 min");
  EXPECT_EQ(duration(170.), "3 min");
  EXPECT_EQ(duration(3599.), "1 h 0 min");
  EXPECT_EQ(duration(7500.), "2 h 5 min");
}

TEST(Pace, RefusesTimesThatRunBackwards) {
  EXPECT_THROW(Pace().add(-1.), Bug);
  EXPECT_THROW(Pace().left(0, 1.), Bug);
  EXPECT_THROW(duration(-1.), Bug);
}

}  // namespace
}  // namespace perimorph::base
