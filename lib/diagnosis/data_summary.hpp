#pragma once
// What a measurement set shows by itself, before any model: means with their scatter, and changes with the conditions
// of the tests.

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/procedure.hpp"
#include "measurement/specimen_record.hpp"
#include "measurement/surroundings.hpp"

namespace nacre::diagnosis {

enum class Quantity { modulus, toughness, strength };
/// "modulus", "toughness", "strength" (the largest stress)
std::string_view to_string(Quantity quantity);

/// Mean of one quantity of one design under one test and set of conditions. Geometric; Pa, J/m3 = Pa.
struct MeasuredMean {
  std::string design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  measurement::Surroundings surroundings;  ///< of one of the pieces; those of the others are equal to within its limits
  Quantity quantity = Quantity::modulus;
  int pieces = 0;  ///< tests of one piece count once
  double mean_pa = 0.0;
  double low_pa = 0.0, high_pa = 0.0;  ///< 90 % interval of the mean; the mean itself where nothing is replicated
  double scatter = 0.0;                ///< relative standard deviation of single pieces; 0: one piece
};

/// How much a quantity changes with one condition: rate, thickness, orientation, batch, print order, or a further
/// column of the set.
struct ConditionTrend {
  std::string of;  ///< name of a homogeneous material, or "layouts": changes within designs, all together
  Quantity quantity = Quantity::modulus;
  std::string condition;         ///< column of the set
  std::string from, to;          ///< values between which it changes: the smallest and the largest, or two words
  int pieces = 0;                ///< that tell it
  double ratio = 1.0;            ///< quantity at `to` over that at `from`
  double low = 1.0, high = 1.0;  ///< 90 % interval
  double chance = 1.0;           ///< of a change as large by scatter alone, times the number of all trends (Bonferroni)
  double exponent = 0.0;         ///< with a strain rate r: the quantity grows as r^exponent
  double exponent_low = 0.0, exponent_high = 0.0;
};

struct DataSummary {
  std::vector<MeasuredMean> means;     ///< by design, test, conditions
  std::vector<ConditionTrend> trends;  ///< the surest first
};

/// Least squares on logarithms of the means of pieces, against log rate, a number (its logarithm where positive values
/// span a factor of ten), or one word against the first. Where every piece was tested under several values the changes
/// are those within pieces. Without any freedom left the scatter is assumed (NoiseRules::assumed_sd).
DataSummary summary_of_data(const std::vector<measurement::SpecimenRecord>& specimens, const NoiseRules& rules);

/// The surest trend along a column that no effect and no factor of a diagnosis is about ("layer_height_mm"), where
/// chance gives it more seldom than this; nothing where there is none.
const ConditionTrend* trend_along_a_further_column(const DataSummary& data, double chance);

}  // namespace nacre::diagnosis
