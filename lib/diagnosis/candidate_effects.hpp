#pragma once
// Which effects are candidates on some rows (docs/METHODS.md, "Diagnosis", 3), and whether there are enough rows.

#include <optional>
#include <span>

#include "diagnosis/observations.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {

/// Whether moduli alone can identify an effect: those of the machine, and those that blind trials showed; the others
/// need a further test to be named.
bool is_identified_by_moduli(const material::Effect& effect);

/// Whether a row is the mean modulus of a layout: a signature there does not count for effects that need another test.
bool is_modulus_of_layout(const Observations& observations, Eigen::Index row);

/// Whether an effect has a signature in these rows that counts. `change`: the largest change of every row of the
/// observations.
bool has_signature(const material::Effect& effect, const Eigen::VectorXd& change, const Observations& observations,
                   std::span<const Eigen::Index> rows);

/// Groups that are too few for a diagnosis, and how many it needs of the one or of the other.
struct TooFew {
  int layouts = 0, coupons = 0;
  int layouts_needed = 0, coupons_needed = 0;
};

/// Nothing where there are enough.
std::optional<TooFew> too_few(std::span<const Observation> groups, const NoiseRules& rules);

}  // namespace nacre::diagnosis
