// Numbers over increments.

#include "perimorph/discretization/amplitude.hpp"

#include <gtest/gtest.h>

namespace perimorph::discretization {
namespace {

TEST(Amplitude, IsLinearBetweenItsKnotsAndConstantOutside) {
  const Amplitude amplitude({{1., 2.}, {3., 6.}, {4., 6.}, {6., 0.}});
  EXPECT_EQ(amplitude.at(0.), 2.);
  EXPECT_EQ(amplitude.at(1.), 2.);
  EXPECT_DOUBLE_EQ(amplitude.at(2.5), 5.);
  EXPECT_EQ(amplitude.at(3.), 6.);
  EXPECT_EQ(amplitude.at(3.7), 6.);
  EXPECT_DOUBLE_EQ(amplitude.at(5.), 3.);
  EXPECT_EQ(amplitude.at(9.), 0.);
}

TEST(Amplitude, RefusesKnotsOutOfOrder) {
  EXPECT_THROW(Amplitude({}), base::Bug);
  EXPECT_THROW(Amplitude({{1., 2.}, {1., 3.}}), base::Bug);
}

TEST(Ramp, GrowsWithTheLoadFactorOrByItsAmplitude) {
  const Amplitude amplitude({{0., 0.}, {10., 5.}, {20., -5.}});
  const Ramp<double> linear{3., 1.}, driven{3., 1., &amplitude};
  EXPECT_EQ(linear.at(4.), 13.);
  EXPECT_EQ(linear.rate_in(4., 1.), 3.);
  EXPECT_DOUBLE_EQ(driven.at(4.), 7.);
  EXPECT_DOUBLE_EQ(driven.rate_in(4., 1.), 1.5);
  EXPECT_DOUBLE_EQ(driven.rate_in(10.5, 1.5), 0.);  // up, and down again
  EXPECT_EQ(driven.rate_in(4., 0.), 0.);
}

TEST(Ramp, IsTheSameWhereItHasTheSameValues) {
  const Amplitude one({{0., 0.}, {1., 5.}}), same({{0., 0.}, {1., 5.}}), other({{0., 0.}, {1., 6.}});
  EXPECT_TRUE((Ramp<double>{3., 1., &one} == Ramp<double>{3., 1., &same}));
  EXPECT_FALSE((Ramp<double>{3., 1., &one} == Ramp<double>{3., 1., &other}));
  EXPECT_FALSE((Ramp<double>{3., 1., &one} == Ramp<double>{3., 1.}));
  EXPECT_FALSE((Ramp<double>{3., 1.} == Ramp<double>{3., 2.}));
}

}  // namespace
}  // namespace perimorph::discretization
