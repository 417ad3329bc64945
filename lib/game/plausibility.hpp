#pragma once
// Whether a specimen's values are plausible by the current model: wrong units are off by factors of ten and more,
// models by less.

#include <map>
#include <optional>
#include <string>

#include "material/parameters.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::game {

/// Doubts about the units of valid specimens. A modulus is compared with the simulated one of the design
/// (milliseconds, once for all replicates), a notched specimen's curve by the slope of its beginning.
class UnitDoubts {
 public:
  UnitDoubts(const material::ParameterSet& model, tester::Fidelity fidelity) : model_(model), fidelity_(fidelity) {}
  /// As a sentence; nothing where there is none.
  std::optional<std::string> about(const measurement::SpecimenRecord& specimen);
  int simulations() const { return simulated_pa_.size(); }

 private:
  /// Nothing where the simulation fails.
  std::optional<double> simulated_pa(const measurement::SpecimenRecord& specimen);

  material::ParameterSet model_;
  tester::Fidelity fidelity_;
  std::map<std::string, std::optional<double>> simulated_pa_;  ///< by simulation_key()
};

}  // namespace nacre::game
