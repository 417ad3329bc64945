#pragma once
// The two testers on designs, in this process, without farm and cache.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "material/starting_model.hpp"
#include "offline/simulated_design.hpp"

namespace nacre::offline {

/// What the caller says of a model in place of what it holds; nothing: the model's.
struct ModelChoice {
  std::optional<std::string> criterion;
  std::optional<double> strength_cv;
};
/// The model that is read over the built-in values, those of W for the criterion chosen. Throws InputError that names
/// the choice as `names` do.
material::ParameterSet chosen_model(const material::ParameterReader& read, const ModelChoice& choice,
                                    const std::array<std::string_view, 2>& names = {"criterion", "strength_cv"});

/// What the testers compute of a design.
tester::Simulation simulation_of(const pattern::Design& design, const SimulateSettings& settings);

/// Runs the tests of all designs on all allowed cores, the long ones first, and sums up what their specimens tell. Each
/// design holds its argument and design. `done` is called after each simulation, from any thread; what it throws ends
/// the rest.
void run_tests(std::vector<SimulatedDesign>& designs, const SimulateSettings& settings,
               const std::function<void()>& done);

/// Why a pattern would never be proposed: a sentence; empty where nacre proposes such, and for homogeneous designs.
std::string departure_from_proposals(const pattern::Design& design);

}  // namespace nacre::offline
