#pragma once
// Before anything is printed: which causes a set of specimens could tell apart, and which few more would change that
// most.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/scatter.hpp"

namespace nacre::diagnosis {

/// What a plan can say of one effect. Sizes are values of the effect's first parameter, in its unit.
struct PlannedEffect {
  std::string name, family, unit;
  std::string status;                         ///< told_apart, visible (but like a rival), invisible, not_shown
  std::optional<double> smallest_seen;        ///< from here on it is told from nothing with 5 % error
  std::optional<double> smallest_told_apart;  ///< from here on it is named: told from every rival, with traces that
                                              ///< no cause outside the library leaves
  double absorption = 0.0;                    ///< share of its signature that the base imitates, at a typical size
  double signal_to_noise = 0.0;               ///< at a typical size (0.3 of its range)
  std::string nearest_rival;
  double rival_cosine = 0.0;
};

/// A few specimens more, and what they would change.
struct PlannedAddition {
  std::string words;                   ///< "turned twins"
  std::vector<std::string> specimens;  ///< design, test and conditions of each, in words
  int replicates = 3;
  struct Change {
    std::string effect, from, to;           ///< status before and after
    std::optional<double> told_apart_from;  ///< smallest_told_apart after
  };
  std::vector<Change> changes;
  double score = 0.0;  ///< sum over effects of log of how much smaller a size is told apart
};

struct Plan {
  std::vector<PlannedEffect> effects;      ///< in the order of the library
  std::vector<PlannedAddition> additions;  ///< the most helpful first; those that change nothing are left out
  int specimens = 0, groups = 0;
  std::string too_few;  ///< why a diagnosis of the set as it is would say nothing; empty: it would not
};

/// `specimens`: with or without measured values; only what they are and how they are tested is used. Start parameters
/// stand for the truth; fracture tests are simulated around them as in a diagnosis (and kept in the store). Without
/// `additions` only what the specimens themselves can tell. Specimens that are too few for a diagnosis show no effect;
/// what to add is said all the same. Throws TooFewSpecimens where not even additions make them enough.
Plan plan_diagnosis(std::vector<measurement::SpecimenRecord> specimens, const DiagnosisSettings& settings,
                    const AssumedScatter& scatter = {}, bool additions = true);

/// Signal-to-noise of a cause, of the library or not: of how `changed` differ from `specimens` (the same specimens in
/// the same order, both with values; coupons are compared as far as both were pulled), as far as the base model cannot
/// imitate it. Start parameters stand for the truth. Throws InputError as diagnose() does, and where the two do not
/// show the same features.
double signal_of_change(std::vector<measurement::SpecimenRecord> specimens,
                        std::vector<measurement::SpecimenRecord> changed, const DiagnosisSettings& settings,
                        const AssumedScatter& scatter);

/// The JSON document of `nacre diagnose --plan --json`.
std::string to_json(const Plan& plan);

}  // namespace nacre::diagnosis
