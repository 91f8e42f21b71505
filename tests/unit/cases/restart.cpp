// Which parameters decide whether a run may go on from a checkpoint.

#include <gmock/gmock.h>

#include "perimorph/cases/case.hpp"

namespace perimorph::cases {
namespace {

using testing::HasSubstr;

std::string lines(const std::vector<std::string>& overrides = {}) {
  return deciding_lines(read_case(PERIMORPH_SOURCE_DIR "/inputs/notched_beam/notched_beam.xml", overrides));
}

TEST(DecidingLines, HaveWhatIsComputed) {
  const std::string all = lines();
  EXPECT_THAT(all, HasSubstr("/Peridynamics/Horizon = "));
  EXPECT_THAT(all, HasSubstr("/Loading/Breaking Fraction = 1\n"));
  EXPECT_NE(all, lines({"Loading/Breaking Fraction=0.5"}));
  EXPECT_NE(all, lines({"Mesh/Scale=2"}));
  EXPECT_NE(all, lines({"Output/Crack=true"}));  // its table goes on
}

TEST(DecidingLines, HaveNotHowFarItGoesHowItIsSolvedAndWhatIsWritten) {
  EXPECT_EQ(lines(), lines({"Title=another", "Loading/Increments=7", "Loading/Maximum Damage Iterations=3",
                            "Loading/Maximum Zone Growths=3", "Solver/Tolerance=1e-9", "Solver/Renewal Cost=50",
                            "Solver/MueLu/verbosity=none", "Output/Every=5", "Output/Spread Files=true",
                            "Output/Checkpoint Every=5", "Output/Checkpoint Minutes=1", "Output/Bonds={3}"}));
}

TEST(DecidingLines, ATitleWithABlankLineHidesNothing) {
  for (const std::string text :
       {"one\n\ntwo", "\n", "\n\n\n/Peridynamics/Horizon = 1\n\n", "one\r\n\r\n/Title = two", "{\n\n}"}) {
    const std::string title = "Title=" + text;
    EXPECT_EQ(lines(), lines({title}));
    EXPECT_NE(lines({title}), lines({title, "Peridynamics/Horizon=1.6"}));
  }
}

}  // namespace
}  // namespace perimorph::cases
