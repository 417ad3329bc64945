#include "runtime/round_history.hpp"

#include <gtest/gtest.h>

namespace nacre::runtime {
namespace {

wire::RoundSummary round_zero() {
  wire::RoundSummary round;
  round.gap = round.gamut_hypervolume_staircase = 0.893;
  round.calibration_count = 3;
  round.after.modulus_count = 3;
  round.after.modulus_mean = 1e-9;
  round.after.toughness_count = 3;
  round.after.toughness_mean = 0.0196;
  return round;
}

TEST(RoundInWords, RoundZeroHasMeasuredNothingYet) {
  EXPECT_EQ(in_words(round_zero()),
            "round 0: nothing measured yet; model fitted to 3 base materials (errors E 0 %, T 2 %)");
  EXPECT_EQ(in_words(wire::RoundSummary{}), "round 0: nothing measured yet; model not fitted");
}

TEST(RoundInWords, LaterRoundsSayGapPredictionErrorsAndFit) {
  wire::RoundSummary round = round_zero();
  round.round = 2;
  round.gap = 0.10071;
  round.measured_hypervolume_staircase = 0.7923;
  round.calibration_count = 1;
  round.held_out.toughness_count = 2;
  round.held_out.toughness_mean = 0.253;
  round.equilibrium = true;
  EXPECT_EQ(
      in_words(round),
      "round 2: gap 0.1007 GPa MPa between measured front (0.7923) and simulated front (0.8930); prediction errors "
      "of new designs: T 25 %; model fitted to 1 design (errors E 0 %, T 2 %); equilibrium");
  round.held_out = {};
  round.equilibrium = false;
  EXPECT_EQ(
      in_words(round),
      "round 2: gap 0.1007 GPa MPa between measured front (0.7923) and simulated front (0.8930); prediction errors "
      "of new designs: none measured; model fitted to 1 design (errors E 0 %, T 2 %)");
}

TEST(RoundInWords, ErrorsHaveTwoDigits) {
  wire::RoundSummary round = round_zero();
  round.after.modulus_mean = 0.0634;
  round.after.toughness_mean = 0.0996;
  EXPECT_EQ(in_words(round),
            "round 0: nothing measured yet; model fitted to 3 base materials (errors E 6.3 %, T 10 %)");
}

}  // namespace
}  // namespace nacre::runtime
