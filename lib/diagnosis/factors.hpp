#pragma once
// Factors: the conditions of the tests on which homogeneous specimens depend, whatever the law. A factor is at work
// where free levels of its values are needed for the base to fit (analysis of variance with the base as the mean).

#include <string>
#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

bool has_layouts(const Observations& observations);

/// Conditions that vary over the groups, batch and print order behind the others, and of homogeneous specimens alone
/// "material" where there are three and more. None where specimens are notched, or where there are layouts and neither
/// temperature, humidity, age nor machine varies.
std::vector<std::string> varying_factors(const Observations& observations);

/// How many values a factor has where it varies most: within one material, or over the materials.
std::size_t most_values(const Observations& observations, const std::string& factor);

/// One free level for every combination of these factors' values in each material and feature, as columns over the
/// rows: one standard deviation each. They are no levels of a material as a whole, but where "material" is among them:
/// those of its measured rows, the ones that have a value (others are to be predicted), have a mean of zero.
Eigen::MatrixXd level_directions(const Observations& observations, const std::vector<std::string>& factors, double sd);

/// The least sets of factors whose free levels make the base fit. None where it fits without, or with no set.
std::vector<std::vector<std::string>> factors_at_work(const Observations& observations, const FittedModel& base,
                                                      const DiagnosisSettings& settings);

/// Those that are in every set: the data can tell that these are at work.
std::vector<std::string> told_factors(const std::vector<std::vector<std::string>>& sets);

/// Those that no effect of the library describes (contrasts.hpp). Their levels change nothing but what specimens are
/// compared at; a law of theirs may stand in afterwards (condition_laws.hpp). Those of a material would hide every
/// effect.
std::vector<std::string> without_law(std::vector<std::string> factors);

/// What is free beside a model.
struct FreeLevels {
  std::vector<std::string> factors;  ///< levels of these
  bool has_exponents = false;        ///< and exponents of the strain rate in every material at equal values of others
  bool are_of_specimens = false;     ///< levels of machines: a piece keeps its own on another machine
  bool operator==(const FreeLevels&) const = default;
};

/// As columns over the rows, in the sense of level_directions().
Eigen::MatrixXd free_directions(const Observations& observations, const FreeLevels& free, const NoiseRules& rules);

/// These factors but for the strain rate, and materials where they vary.
std::vector<std::string> factors_but_rate(const Observations& observations, std::vector<std::string> factors);

/// With free levels of these factors but for the strain rate, and of materials where they vary, in place of others.
Observations with_levels_but_rate(Observations observations, std::vector<std::string> factors, const NoiseRules& rules);

/// The same, and a free exponent of the strain rate for stiffness and stresses of every material under equal values of
/// the other factors: the part of a law that differs from one to the next.
Observations with_free_exponents(Observations observations, const std::vector<std::string>& factors,
                                 const NoiseRules& rules);

/// A relative change of stiffness from the least to the largest value of a condition.
struct Change {
  std::string along;
  double size = 0.0;
};

/// The largest change of the stiffness of one homogeneous material with one condition that these data leave room for:
/// the far end of the 90 % interval of a straight line in log E. Nothing where none was varied; what happened (batch,
/// print order) is none.
Change largest_change_left(const Observations& observations);

/// Whether stiffness and stresses rise with the strain rate where all other factors are equal. A viscoelastic solid
/// does not soften when it is pulled faster.
bool rises_with_rate(const Observations& observations, const std::vector<std::string>& factors);

}  // namespace nacre::diagnosis
