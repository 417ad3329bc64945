#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "diagnosis/fracture_discretisation.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "diagnosis/modulus_floor.hpp"
#include "diagnosis/procedure.hpp"
#include "material/ranges.hpp"
#include "tester/names.hpp"
#include "tester/simulation.hpp"

namespace nacre::diagnosis {

/// Fracture tests that are simulated before a diagnosis (fracture_plan.hpp, kept_emulator.hpp).
struct SimulatedFractures {
  std::vector<FractureRun> runs;            ///< base models, and effects on top of them
  std::vector<std::string> unaffordable;    ///< effects on fracture tests that none shows: no candidates
  std::vector<RefinedLayout> refined = {};  ///< layouts on half elements; none: the table of floors says it all
  int simulations = 0;                      ///< done for it in this process
  std::optional<material::ToughnessParameters> centre = {};  ///< about which they lie; nothing: the start
};

struct DiagnosisSettings {
  material::ParameterSet start;                                   ///< initial guess of the base fit
  material::ParameterRanges ranges = material::default_ranges();  ///< moduli and ratios may leave them: CoordinateMap
  tester::Fidelity fidelity = tester::Fidelity::full;
  Procedure procedure;
  int bootstraps = 2000;  ///< at least 2 / the level of a name: fewer could never reach it
  std::uint64_t seed = 1;
  ModulusFloor floor;                              ///< from data/discretisation_floor.toml
  FractureDiscretisation fracture_discretisation;  ///< from the same file
  int search_budget = 40;  ///< evaluations of the fracture tests in search of a base fit; 0: begin at `start`
  std::optional<SimulatedFractures> fractures;  ///< nothing: this process simulates what it needs
  std::filesystem::path store;                  ///< file that keeps fracture simulations; empty: none
  int threads = 0;                              ///< 0 all allowed cores
  bool check_discretisation = true;             ///< simulate three specimens with other discretisations too
  /// Called now and then with the share of the work done (0..1) and the present step.
  std::function<void(double, std::string_view)> progress = {};
};

/// No row to diagnose: the result is insufficient().
class NothingMeasured : public InputError {
  using InputError::InputError;
};

}  // namespace nacre::diagnosis
