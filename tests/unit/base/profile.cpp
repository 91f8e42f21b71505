#include "perimorph/base/profile.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace perimorph::tests {
namespace {

using base::Phase;

TEST(Profile, CountsTheTimeOfAnInnerPhaseOnce) {
  constexpr double outer = 0.02, inner = 0.1;
  const auto wait = [](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); };
  base::Profile profile;
  {
    const auto bonds = profile.measure(Phase::bonds);
    wait(outer);
    for (int i = 0; i < 2; ++i) {
      const auto residual = profile.measure(Phase::residual);
      wait(0.5 * inner);
    }
  }
  EXPECT_GE(profile.seconds(Phase::residual), inner);
  EXPECT_GE(profile.seconds(Phase::bonds), outer);
  EXPECT_LE(profile.seconds(Phase::bonds) + profile.seconds(Phase::residual), profile.elapsed());
}

}  // namespace
}  // namespace perimorph::tests
