#pragma once
// Before anything is printed: which causes a set of specimens could distinguish, and which few further specimens would
// change that most. Linear model: signatures projected off the columns of the base.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/scatter.hpp"
#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

enum class PlanStatus {
  told_apart,  ///< can be named
  visible,     ///< but collinear with a rival
  invisible,
  not_shown,  ///< the specimens have no signature of it
};
std::string_view to_string(PlanStatus status);

/// One effect in a plan. Sizes are values of the effect's first parameter, in its unit.
struct PlannedEffect {
  std::string name, family, unit;
  PlanStatus status = PlanStatus::not_shown;
  std::optional<double> smallest_seen;        ///< from here on it is distinguished from none with 5 % error
  std::optional<double> smallest_told_apart;  ///< from here on it is named: distinguished from every rival, with a
                                              ///< signature that no unmodelled cause has
  double absorption = 0.0;                    ///< share of its signature that the base imitates, at a typical size
  double signal_to_noise = 0.0;               ///< at a typical size (0.3 of its range)
  std::string nearest_rival;
  double rival_cosine = 0.0;  ///< collinearity with it
};

/// A few further specimens, and the change by them.
struct PlannedAddition {
  std::string words;                   ///< "turned twins"
  std::vector<std::string> specimens;  ///< design, test and conditions of each, in words
  int replicates = 3;
  struct Change {
    std::string effect;
    PlanStatus from = PlanStatus::not_shown, to = PlanStatus::not_shown;  ///< before and after
    std::optional<double> told_apart_from;                                ///< smallest_told_apart after
  };
  std::vector<Change> changes;
  double score = 0.0;  ///< sum over effects of log of the factor by which smallest_told_apart falls
};

struct Plan {
  std::vector<PlannedEffect> effects;      ///< in the order of material::effect_library()
  std::vector<PlannedAddition> additions;  ///< the most helpful first; those that change nothing are left out
  int specimens = 0, groups = 0;
};

/// `specimens`: with or without measured values; only what they are and how they are tested is used. Start parameters
/// stand for the truth; fracture tests are simulated around them as in a diagnosis (and kept in the store). Without
/// `additions` only the specimens themselves are judged. Throws NothingMeasured where there are none.
Plan plan_diagnosis(std::vector<measurement::SpecimenRecord> specimens, const DiagnosisSettings& settings,
                    const AssumedScatter& scatter = {}, bool additions = true);

/// Signal-to-noise ratio of a cause, modelled or not: of the difference of `changed` from `specimens` (the same
/// specimens in the same order, both with values; coupons are compared as far as both were pulled), as far as the base
/// model cannot imitate it. Start parameters stand for the truth. Throws InputError as diagnose() does, and where the
/// two do not show the same features.
double signal_of_change(std::vector<measurement::SpecimenRecord> specimens,
                        std::vector<measurement::SpecimenRecord> changed, const DiagnosisSettings& settings,
                        const AssumedScatter& scatter);

}  // namespace nacre::diagnosis
