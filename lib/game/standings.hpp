#pragma once
// The state of the game: measured fronts, their hypervolume with its error, the homogeneous benchmark, out-of-sample
// prediction errors.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"
#include "measurement/summary.hpp"
#include "optimize/pareto.hpp"
#include "sysid/prediction.hpp"

namespace nacre::game {

/// Valid values of one pattern, in Pa, specimens sorted by name.
struct MeasuredValues {
  std::vector<double> modulus_pa;
  std::vector<double> toughness_pa;
};

/// Whether these are the standard conditions, to which proposals and their predictions refer.
bool is_standard(const tester::TestConditions& conditions);

/// The groups tested under standard conditions: a twin pulled ten times faster does not measure the design itself.
std::vector<measurement::Replicates> under_standard_conditions(std::vector<measurement::Replicates> measured);

/// Valid specimens of patterns tested under standard conditions, by pattern: what the measured front is made of.
/// Coupons without the eightfold symmetry, homogeneous designs and turned twins are no competitors of proposals.
/// `specimens` sorted by name.
std::map<pattern::Pattern, MeasuredValues> measured_values(std::span<const measurement::SpecimenRecord> specimens);

/// Means of the patterns that have both E and T.
std::vector<optimize::Performance> measured_performances(const std::map<pattern::Pattern, MeasuredValues>& values);

/// Bootstrap standard error of the measured staircase hypervolume, GPa MPa: each pattern's replicates are drawn anew, E
/// and T by themselves, their deviations from the mean widened by sqrt(n / (n - 1)) since a bootstrap of few replicates
/// is too narrow by that factor. 0 when no pattern has two replicates. Deterministic in the seed.
double hypervolume_error(const std::map<pattern::Pattern, MeasuredValues>& values, std::uint64_t seed,
                         int resamples = 1000);

/// l1 of 2.3.4: homogeneous designs that have both E and T, measured under standard conditions, by increasing rigid
/// fraction.
std::vector<optimize::Performance> benchmark_line(const std::vector<measurement::SpecimenRecord>& specimens);

/// Designs that the model is calibrated on: layouts printed upright with at least one valid value. Specimens under
/// the same nominal conditions are replicates even where callipers read 3.17 and 3.24 mm.
std::vector<measurement::Replicates> calibration_set(const std::vector<measurement::SpecimenRecord>& specimens);

/// Names, sorted, of the valid specimens that one request about all of them can list: every one where `most_bytes`
/// hold the names as LCM writes them (5 bytes more than letters) with a number each (4 bytes), else of each design in
/// each test under each nominal conditions equally many replicates, the first by name, as many as fit.
std::vector<std::string> specimens_to_name(const std::vector<measurement::SpecimenRecord>& specimens,
                                           std::size_t most_bytes);

/// The pattern of a design with eightfold symmetry; nothing for other layouts and mixtures.
std::optional<pattern::Pattern> eightfold_pattern(const pattern::Design& design);

/// Those of the calibration set that are patterns and measured in both tests under standard conditions: what families
/// are made of.
std::vector<measurement::Replicates> patterns_with_both(const std::vector<measurement::SpecimenRecord>& specimens);

/// Designs with the predictions that were made before they were measured, one each.
struct PredictedDesigns {
  std::vector<measurement::Replicates> measured;
  std::vector<sysid::Prediction> predicted;
};
/// Those of `measured` that have a prediction, in their order. Predictions are of standard conditions, by
/// canonical design name.
PredictedDesigns predicted_among(const std::vector<measurement::Replicates>& measured,
                                 const std::map<std::string, sysid::Prediction>& predictions);

}  // namespace nacre::game
