#pragma once
// The search of the gamut in this process.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "explore/search.hpp"
#include "material/parameters.hpp"
#include "tester/names.hpp"

namespace nacre::offline {

struct ExploreSettings {
  explore::SearchSettings search;  ///< its mechanics are filled in
  material::ParameterSet parameters;
  tester::Fidelity fidelity = tester::Fidelity::full;
  std::filesystem::path cache;    ///< database that keeps the simulations; empty: none
  std::filesystem::path batches;  ///< record of the search beside the cache; empty: none
};

/// By which a record of a search (explore::BatchLog) knows its model: parameters and fidelity.
std::string model_identity(const ExploreSettings& settings);

/// Which option does not fit the algorithm or the parameters, its name first ("specimens: ..."); empty: none.
std::string search_fault(const ExploreSettings& settings);

/// What is told while a search runs; what these throw ends it.
struct ExploreEvents {
  std::function<void()> simulated;                                   ///< a pattern, from any thread
  std::function<bool()> stopped;                                     ///< whether to end after running simulations
  std::function<void(const std::vector<explore::Evaluated>&)> told;  ///< all so far, after each batch
};

struct Explored {
  std::vector<explore::Evaluated> gamut;  ///< known patterns, then those simulated, in order of evaluation
  int failed = 0;                         ///< simulations without a result
};

/// Searches until the budget is spent, or until it is stopped: a batch that was not simulated whole is then left out.
/// Throws InputError for settings out of range, or a cache or record that cannot be used.
Explored explore_gamut(ExploreSettings settings, const ExploreEvents& events);

/// The JSON of what was found: evaluated, failed, front, hypervolume_gpa_mpa, gamut, the name of its file or null.
nlohmann::ordered_json to_json(const Explored& explored, const std::string& file);

}  // namespace nacre::offline
