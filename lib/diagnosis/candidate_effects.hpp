#pragma once
// Which effects are looked for at all on some rows (docs/METHODS.md, "Diagnosis", 3), and whether there is enough to
// look at.

#include <optional>
#include <span>

#include "diagnosis/observations.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {

/// Effects that blind trials showed to be told by moduli alone, and those of the machine; the others need a test beside
/// moduli to be named by.
bool tells_on_moduli(const material::Effect& effect);

/// Whether a row is the mean modulus of a layout: traces there do not count for effects that need another test.
bool is_modulus_of_layout(const Observations& observations, Eigen::Index row);

/// Whether an effect leaves traces in these rows that count. `change`: the most that it moves every row of the
/// observations.
bool has_signature(const material::Effect& effect, const Eigen::VectorXd& change, const Observations& observations,
                   std::span<const Eigen::Index> rows);

/// Why these groups are too few for a diagnosis, as a sentence without its full stop; nothing where they are enough.
std::optional<std::string> why_too_few(std::span<const Observation> groups);

}  // namespace nacre::diagnosis
