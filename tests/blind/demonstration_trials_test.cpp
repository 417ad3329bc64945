// The laboratories of the demonstration: what was measured in its game of seed 1, in those of other seeds too.

#include <gtest/gtest.h>

#include "base/expected.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/modulus_floor.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/measure_set.hpp"

namespace nacre::blind {
namespace {

using diagnosis::Verdict;

/// Random layouts, the proposals of two rounds, base materials and mixtures.
laboratory::Campaign measured_in_the_demonstration() {
  laboratory::Campaign campaign;
  campaign.tests = {tester::TestKind::modulus};
  for (const char* name : {"01ff1bf8d7ffff", "01fffcfffbffff", "0de7fdfff9ffff", "17febd912908e9", "3f8f5e70f7f18d",
                           "49e7fdfff9ffff", "501f0c2ff87fff", "53df3ffff9ffff", "76fbff45ffff79", "776bdfff7efd7f",
                           "7bf67fdeb5bebf", "7f9ffdbdcf7f75", "soft", "interface", "rigid", "mix:0.65", "mix:0.85"})
    campaign.designs.push_back(expected(pattern::design_from_name(name)));
  return campaign;
}

diagnosis::Diagnosis diagnosed(std::uint64_t seed, int replicates) {
  laboratory::Truth truth = laboratory::draw_truth(seed, tester::Fidelity::preview);
  truth.replicates = replicates;
  diagnosis::DiagnosisSettings settings;
  settings.start = material::default_parameters();
  settings.fidelity = truth.fidelity;
  settings.floor =
      diagnosis::read_modulus_floor(NACRE_SOURCE_DIR "/data/discretisation_floor.toml", tester::Fidelity::preview);
  return diagnosis::diagnose(laboratory::measure(truth, measured_in_the_demonstration()), settings);
}

/// Seed, replicates.
class Demonstration : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  const diagnosis::Diagnosis diagnosis_ = diagnosed(GetParam().first, GetParam().second);
};

// Corner debonding of 0.88, which is not in the library. With 28 layouts and four replicates it had been named
// droplet_mixing.
using WithACauseThatNobodyKnows = Demonstration;
TEST_P(WithACauseThatNobodyKnows, IsUnexplained) {
  EXPECT_EQ(diagnosis_.verdict, Verdict::unexplained) << diagnosis_.summary;
  EXPECT_TRUE(diagnosis_.effects.empty());
}
INSTANTIATE_TEST_SUITE_P(Seed1, WithACauseThatNobodyKnows, testing::Values(std::pair{1, 3}, std::pair{1, 4}));

using WithNothingHidden = Demonstration;
TEST_P(WithNothingHidden, TheBaseIsSufficient) {
  EXPECT_EQ(diagnosis_.verdict, Verdict::base_sufficient) << diagnosis_.summary;
}
INSTANTIATE_TEST_SUITE_P(Seed2, WithNothingHidden, testing::Values(std::pair{2, 3}));

}  // namespace
}  // namespace nacre::blind
