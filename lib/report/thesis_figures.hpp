#pragma once
// What the thesis reports of its own game, where it does not follow from data/thesis: shown with the run's figures.

#include <algorithm>

namespace nacre::report {

/// A round of the thesis: Table 3.5, and its errors on designs not yet calibrated on, derived from Tables A.3 and A.4.
/// Percent.
struct ThesisRound {
  int round, count;
  double out_of_sample_modulus, out_of_sample_toughness;  // 0: none
  double before_modulus, before_modulus_max, after_modulus, after_modulus_max;
  double before_toughness, before_toughness_max, after_toughness, after_toughness_max;
};
inline constexpr ThesisRound kThesisRounds[] = {
    {1, 18, 0.0, 0.0, 31.09, 93.15, 6.53, 22.95, 135.59, 767.44, 22.85, 62.23},
    {2, 26, 12.2, 97.0, 25.19, 93.15, 6.29, 20.40, 108.26, 767.44, 23.92, 100.53},
    {3, 34, 9.1, 84.0, 21.11, 93.15, 6.32, 22.75, 93.09, 767.44, 24.68, 84.30},
    {4, 42, 6.9, 76.0, 18.95, 93.15, 6.50, 25.40, 82.38, 767.44, 27.10, 88.87},
};
inline constexpr double kThesisLinearModulus = 7.1, kThesisConstantToughness = 31.0;  // on all 42 [derived]

/// Table 3.3: the best designs, and how many times better than the homogeneous line and the tougher base material.
struct ThesisBest {
  int rigid_percent;
  double modulus_gpa, toughness_mpa, gain_modulus, gain_toughness, gain_base;
};
inline constexpr ThesisBest kThesisBest[] = {{79, 1.402, 0.491, 1.35, 2.00, 7.01},
                                             {85, 1.810, 0.473, 1.61, 2.76, 6.75},
                                             {85, 1.764, 0.458, 1.54, 2.48, 6.53},
                                             {84, 1.790, 0.355, 1.27, 1.76, 5.07},
                                             {85, 1.807, 0.304, 1.28, 1.59, 4.33}};
inline constexpr double kThesisModulusGain = std::ranges::max(kThesisBest, {}, &ThesisBest::gain_modulus).gain_modulus;
inline constexpr double kThesisToughnessGain =
    std::ranges::max(kThesisBest, {}, &ThesisBest::gain_toughness).gain_toughness;

}  // namespace nacre::report
