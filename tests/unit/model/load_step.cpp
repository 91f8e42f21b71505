#include "perimorph/model/load_step.hpp"

#include <gtest/gtest.h>

namespace perimorph::model {
namespace {

TEST(LoadStep, HalvesComeBackToWholeIncrements) {
  LoadStep step = LoadStep{6., 1.}.halved().halved();
  EXPECT_EQ(step.end(), 6.25);
  step = step.next(true);  // 6.25 is no multiple of 0.5
  EXPECT_EQ(step.end(), 6.5);
  step = step.next(true);
  EXPECT_EQ(step.end(), 7.);
  step = step.next(true);
  EXPECT_EQ(step.end(), 8.);
  EXPECT_EQ(step.next(true).end(), 9.);
}

TEST(LoadStep, ItGrowsOnlyWhereItMay) {
  const LoadStep step = LoadStep{3., 0.5}.next(false).next(false);
  EXPECT_EQ(step.begin, 4.);
  EXPECT_EQ(step.size, 0.5);
}

TEST(LoadStep, AfterEightHalvesItIsTheSmallest) {
  LoadStep step;
  for (int i = 0; i < 8; ++i) {
    EXPECT_FALSE(step.is_smallest());
    step = step.halved();
  }
  EXPECT_TRUE(step.is_smallest());
}

}  // namespace
}  // namespace perimorph::model
