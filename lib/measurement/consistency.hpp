#pragma once
// Which replicates agree (thesis 2.2.2: at least four are tested, at least three with the most common and consistent
// behaviour count). Outliers are proposed with their reason; a person decides.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// When a replicate is an outlier. The scatters are the usual ones of printed replicates (standard deviations of the
/// logarithm): a smaller difference never makes a specimen an outlier.
struct ConsistencySettings {
  int fewest_tested = 4;
  int fewest_consistent = 3;
  double usual_modulus_scatter = 0.03;
  double usual_toughness_scatter = 0.12;
  double usual_peak_scatter = 0.06;
  double usual_curve_distance = 0.15;  ///< area between two curves over their mean area
  double far = 4.0;                    ///< distance from the others, in scatters, beyond which a specimen is an outlier
};

/// Why a specimen is proposed as an outlier.
struct OutlierReason {
  std::string kind;       ///< `modulus`, `toughness`, `peak`, `curve`, `path`
  double distance = 0.0;  ///< in scatters; 0 for a path
  std::string text;       ///< a sentence with the figures
};

struct ProposedOutlier {
  std::string specimen;
  std::vector<OutlierReason> reasons;  ///< strongest first
};

enum class GroupState {
  complete,      ///< enough are tested, enough agree
  more_needed,   ///< too few tested, or too few valid
  inconsistent,  ///< more outliers than may be left out
};
std::string_view to_string(GroupState state);

/// One design in one test under (nominally) the same conditions, temperature, humidity and age.
struct ReplicateGroup {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions = {};
  std::vector<std::string> tested = {};  ///< all specimens, sorted
  std::vector<std::string> valid = {};   ///< of them those that count now
  std::vector<ProposedOutlier> proposed = {};
  GroupState state = GroupState::more_needed;
  int wanted = 0;  ///< specimens still to be tested
  /// Of the valid ones: mean, and relative standard deviation of two and more; nothing where there are none.
  std::optional<double> mean_pa = {}, scatter = {};
  std::optional<double> mean_without_pa = {}, scatter_without = {};  ///< the same without the proposed outliers
  std::string representative = {};  ///< valid, not proposed, nearest to the mean and with a curve; may be empty
};

/// Every group, sorted by design, test and conditions. Each valid specimen is compared with the others of its group:
/// its modulus, or its toughness, the peak of its curve and the area between its curve and theirs (of coupons peak and
/// curve, up to the largest strain that all were pulled to), and the course of the crack that a person noted (column
/// `path`, but for case, blanks and punctuation) against the most common one. At most as many are proposed as leave
/// `fewest_consistent`, the worst first; with more outliers the group is inconsistent.
std::vector<ReplicateGroup> review_replicates(const std::vector<SpecimenRecord>& specimens,
                                              const ConsistencySettings& settings = {});

/// Valid specimens whose modulus or toughness is more than eight times the median of their group, or less than an
/// eighth of it, as sentences: wrong units are off by factors of ten and more. Of two, both are named. Values that are
/// implausible by themselves are left out.
struct UnitDoubt {
  std::string specimen;
  std::string text;
};
std::vector<UnitDoubt> doubts_of_units(const std::vector<SpecimenRecord>& specimens);

}  // namespace nacre::measurement
