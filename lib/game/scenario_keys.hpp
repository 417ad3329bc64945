#pragma once
// The keys of a scenario file, each described once: its table and name, its meaning, how it is read, checked and
// written.

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "game/scenario.hpp"

namespace nacre::game {

/// One key of a scenario file.
struct ScenarioKey {
  std::string_view table;  ///< empty at the top level
  std::string_view name;
  std::string_view meaning;  ///< comment of the written file
  std::string allowed;       ///< what a value has to be, for errors and comments
  /// Stores the value of `node` and says whether it is allowed; leaves the scenario alone when it is not.
  std::function<bool(const toml::node& node, Scenario& scenario)> read;
  /// The value as TOML.
  std::function<std::string(const Scenario& scenario)> write;

  /// `table.name`, or `name` at the top level.
  std::string path() const;
};

/// All keys, tables together, in the order of a written file.
std::span<const ScenarioKey> scenario_keys();

}  // namespace nacre::game
