#pragma once
// Fitted and held-out patterns of the study.

#include <cstdint>
#include <vector>

#include "pattern/design.hpp"

namespace nacre::calibration_study {

struct StudyDesigns {
  /// In the order of the rounds of a game: ten stratified random patterns, then front-like ones, eight a round.
  std::vector<pattern::Design> fitted;
  /// Never fitted: random and front-like patterns in turn.
  std::vector<pattern::Design> held_out;
};

/// Drawn by the seed; the front-like patterns are those of front_like.txt. At most 42 fitted and 40 held-out ones.
StudyDesigns draw_designs(std::uint64_t seed, int fitted, int held_out);

}  // namespace nacre::calibration_study
