#pragma once
// Is another round worth it: by how much rounds have made the measured hypervolume grow, and what the next is expected
// to add.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "optimize/pareto.hpp"

namespace nacre::game {

/// A pattern with both properties measured: means and their standard errors (0: of a single specimen, unknown).
struct MeasuredDesign {
  int round = 0;  ///< in which it was measured first
  optimize::Performance mean;
  double modulus_error_pa = 0.0, toughness_error_pa = 0.0;
};

/// Of the staircase hypervolume, in GPa MPa.
struct Growth {
  double mean_gpa_mpa = 0.0;
  double error_gpa_mpa = 0.0;                    ///< standard deviation
  double low_gpa_mpa = 0.0, high_gpa_mpa = 0.0;  ///< 5 and 95 % quantiles

  static void fields(auto& field, auto& m) {
    field("mean_gpa_mpa", m.mean_gpa_mpa);
    field("error_gpa_mpa", m.error_gpa_mpa);
    field("interval90_gpa_mpa", std::array{m.low_gpa_mpa, m.high_gpa_mpa});
  }
};

/// What the designs measured first in `round` added to those before them, by what is known of both today. The mean is
/// that of the measured means; error and quantiles from draws of all of them within their errors.
Growth growth_in_round(std::span<const MeasuredDesign> measured, int round, std::uint64_t seed);

/// How predictions scatter: ln(measured / predicted) = b + e, one b for all designs of a round, one e a design, both
/// normal about zero: the bias that a round shows is calibrated away before the next.
struct PredictionScatter {
  double of_round = 0.0, of_design = 0.0;  ///< standard deviations of b and e
};

/// Method of moments (one-way random effects): of_design^2 = sum (x - mean of its round)^2 / (N - R), of_round^2 =
/// sum x^2 / N - of_design^2, at least 0, for N errors of R rounds; with N = R all is of_design. Both are widened by
/// the ratio of the 90 % quantiles of Student's t with N - R degrees of freedom and of the normal, since few errors do
/// not tell a scatter well. At least one error.
PredictionScatter prediction_scatter(std::span<const int> rounds, std::span<const double> log_errors);

/// What designs that are predicted, not measured, are expected to add when they are measured together: E and sd of
/// HV(measured and new) - HV(measured), over 4000 draws of the measured means within their errors and of the new
/// designs' E and T, each the prediction times exp(b + e). E and T are independent. For one design, exact measurements
/// and b = 0 the mean is explore::expected_improvement (Emmerich et al. 2006).
Growth expected_growth(std::span<const MeasuredDesign> measured, std::span<const optimize::Performance> predicted,
                       const PredictionScatter& modulus, const PredictionScatter& toughness, std::uint64_t seed);

}  // namespace nacre::game
