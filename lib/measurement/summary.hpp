#pragma once
// Replicates: the statistics of one design, whatever the order in which its specimens arrived. Modulus by ISO 527:
// slope between 0.05 and 0.25 % strain; toughness: area under the curve (thesis Eq. 2.6).

#include <optional>
#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// The valid specimens of one design under one set of conditions, and their mean values.
struct Replicates {
  pattern::Design design;
  tester::TestConditions conditions;
  std::string batch_list;              ///< batches joined by a comma
  std::vector<std::string> specimens;  ///< names of the valid specimens, sorted
  int modulus_count = 0, toughness_count = 0;
  double modulus_pa = 0.0, modulus_sd_pa = 0.0;  ///< mean and sample standard deviation; 0 when not measured
  double toughness_pa = 0.0, toughness_sd_pa = 0.0;
  double modulus_batch_step = 0.0,
         toughness_batch_step = 0.0;   ///< means of print_contexts()
  tester::Curve representative_curve;  ///< of the specimen whose toughness is nearest to the mean; empty when none
};

/// Groups valid specimens by design and conditions (modulus and toughness specimens of one design come together).
/// Sorted by design name, then conditions, so that the order of arrival never matters. `tensile` coupons are not
/// included.
std::vector<Replicates> summarise(const std::vector<SpecimenRecord>& specimens);

/// Modulus of a modulus test's specimen: the given value, else the slope of its curve between 0.05 and 0.25 % strain,
/// by least squares, or of the chord where fewer than three points lie there (docs/FORMATS.md); else nothing.
std::optional<double> modulus_of(const SpecimenRecord& specimen);

/// Toughness of a specimen: the given value, else the area under its curve; nothing when it has neither.
std::optional<double> toughness_of(const SpecimenRecord& specimen);

}  // namespace nacre::measurement
