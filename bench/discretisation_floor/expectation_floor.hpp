#pragma once
// Discretisation floor of the expected T: means over specimens on elements of size h against h/2, both meshes with the
// same fields of strength.

#include <cstdint>
#include <string>
#include <vector>

#include "floor_rows.hpp"

namespace nacre::discretisation_floor {

/// Which specimens are broken. The fine mesh costs some ten times as much, so it may have fewer.
struct SpecimenPlan {
  int coarse = 0, fine = 0;  ///< specimens 0 .. n - 1 on elements of h / refinement and of h / (2 refinement)
  int refinement = 1;        ///< of the coarse mesh
};

/// Fracture tests of every specimen on both meshes, damping as in wanted_fracture_tests(): first every layout with one
/// specimen, then with the next one.
std::vector<study::Wanted> wanted_specimens(const FloorPlan& plan, const SpecimenPlan& specimens);

/// T of one layout with one parameter set, Pa, by specimen; both begin with the same ones.
struct DesignPair {
  std::size_t set = 0;
  std::vector<double> coarse_pa, fine_pa;
  double log_peak_ratio = 0.0;  ///< log of the ratio of mean peak stresses, fine over coarse
};
/// What the table holds of at least two specimens on both meshes (one where one is planned), up to the first that
/// failed.
std::vector<DesignPair> finished_designs(const FloorPlan& plan, const SpecimenPlan& specimens,
                                         const study::StudyTable& table);

/// Standard deviations of natural logarithms of T(fine) / T(coarse), after one factor per parameter set.
struct ExpectationFloor {
  double shift = 0.0;                               ///< mean of log ratio of the means
  double sd = 0.0;                                  ///< of the log ratio of the means as measured
  double finite_n_sd = 0.0;                         ///< the share of it that the finite number of specimens makes
  double expected_sd = 0.0;                         ///< sqrt(sd^2 - finite_n_sd^2), 0 where that is negative
  double spearman = 0.0;                            ///< of the means, mean over the parameter sets
  double one_sd = 0.0;                              ///< of the log ratio of single specimens
  double one_spearman = 0.0;                        ///< of single specimens, mean over specimens
  double coarse_scatter = 0.0, fine_scatter = 0.0;  ///< between specimens: sd over mean of T, rms over designs
  double peak_share = 0.0;  ///< of sd^2, what the changes of peak stress explain linearly: 0 to 1
  double same_crack = 0.0;  ///< correlation between the meshes of a specimen's departure from the mean of its design
};

/// Every parameter set has at least three designs. With the same specimens on both meshes the variance of a log ratio
/// of means is, by linearisation, c^2/n_c + f^2/n_f - 2 r / max(n_c, n_f), c and f the relative scatters and r the
/// relative covariance of the specimens that both have.
ExpectationFloor expectation_floor(const std::vector<DesignPair>& designs);

/// The figures that so many specimens have, with 90 % intervals of a bootstrap over designs, as a table for
/// docs/studies/toughness.md.
std::string expectation_table(const std::vector<DesignPair>& designs, std::uint64_t seed);

}  // namespace nacre::discretisation_floor
