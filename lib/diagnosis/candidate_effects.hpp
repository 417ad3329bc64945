#pragma once
// Which effects are candidates on some rows (docs/METHODS.md, "Diagnosis", 3).

#include <span>
#include <string>

#include "diagnosis/observations.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {

/// Whether moduli alone can identify an effect: those of the machine, and those that blind trials showed; the others
/// need a further test to be named.
bool is_identified_by_moduli(const material::Effect& effect);

/// Whether one of these effects is a law of the strain rate.
bool have_rate_law(std::span<const std::string> effects);

/// Whether a row is the mean modulus of a layout: a signature there does not count for effects that need another test.
bool is_modulus_of_layout(const Observations& observations, Eigen::Index row);

/// Whether an effect has a signature in these rows that counts. `change`: the largest change of every row of the
/// observations.
bool has_signature(const material::Effect& effect, const Eigen::VectorXd& change, const Observations& observations,
                   std::span<const Eigen::Index> rows);

/// Whether an effect is nothing but other constants of the phases on these specimens: a power of the rate where all
/// were tested at one rate, and none was held or unloaded.
bool is_other_constants(const material::Effect& effect, const Observations& observations);

/// Whether no effect but those that moduli of layouts identify can be told here: there are moduli alone, and no
/// homogeneous material was tested under two conditions.
bool only_moduli_of_layouts_tell(const Observations& observations);

}  // namespace nacre::diagnosis
