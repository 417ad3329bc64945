#include "game/scenario.hpp"

#include <algorithm>
#include <set>

#include <toml++/toml.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "base/shipped_files.hpp"
#include "base/toml_file.hpp"
#include "game/budget.hpp"
#include "game/scenario_keys.hpp"

namespace nacre::game {
namespace {

std::string names_in_table(std::string_view table) {
  std::string names;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.table == table) names += (names.empty() ? "" : ", ") + std::string(key.name);
  }
  return names;
}

bool is_table_name(std::string_view name) {
  const auto keys = scenario_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const ScenarioKey& key) { return key.table == name && !name.empty(); });
}

std::string table_names() {
  std::set<std::string> names;
  for (const ScenarioKey& key : scenario_keys()) {
    if (!key.table.empty()) names.insert(fmt::format("[{}]", key.table));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void read_entry(std::string_view source, std::string_view table, std::string_view name, const toml::node& node,
                Scenario& scenario) {
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.table != table || key.name != name) continue;
    if (key.read(node, scenario)) return;
    throw InputError::format("{}: {} = {}: expected {}", place(source, node), key.path(), shown(node), key.allowed);
  }
  const std::string kind = table.empty() ? "at the top level" : fmt::format("in [{}]", table);
  throw InputError::format("{}: unknown key {} {}: expected one of {}{}", place(source, node), name, kind,
                           names_in_table(table), table.empty() ? ", or a table " + table_names() : "");
}

void read_table(std::string_view source, std::string_view table, const toml::table& entries, Scenario& scenario) {
  for (const auto& [name, node] : entries) {
    const toml::table* inner = node.as_table();
    if (table.empty() && is_table_name(name.str())) {
      if (inner == nullptr) {
        throw InputError::format("{}: {} = {}: expected a table [{}]", place(source, node), name.str(), shown(node),
                                 name.str());
      }
      read_table(source, name.str(), *inner, scenario);
    } else if (inner != nullptr && table.empty()) {
      throw InputError::format("{}: unknown table [{}]: expected one of {}", place(source, node), name.str(),
                               table_names());
    } else {
      read_entry(source, table, name.str(), node, scenario);
    }
  }
}

/// Place of the first of these keys (`table.name`, or `name`) that the file has; the file itself when it has none.
std::string place_of(std::string_view source, const toml::table& entries,
                     std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    const std::size_t dot = key.find('.');
    const auto node = dot == std::string_view::npos ? entries[key] : entries[key.substr(0, dot)][key.substr(dot + 1)];
    if (node) return place(source, *node.node());
  }
  return std::string(source);
}

/// A budget must allow what is always measured.
void check_budget(std::string_view source, const toml::table& entries, const Scenario& scenario) {
  const auto expect = [&](std::string_view key, int value, int least, std::string_view what) {
    if (value == 0 || value >= least) return;
    throw InputError::format("{}: {} = {}: expected 0, or at least {}: base materials and one design {}",
                             place_of(source, entries, {key}), key, value, least, what);
  };
  if (scenario.rounds < 1) return;
  expect("budget.specimens_per_round", scenario.budget.specimens_per_round, least_specimens(scenario, 1), "in round 1");
  expect("budget.total", scenario.budget.total, least_specimens_of_all(scenario), "a round");
}

/// Checks that concern several keys.
void check_together(std::string_view source, const toml::table& entries, const Scenario& scenario) {
  const ValidationSettings& validation = scenario.validation;
  if (validation.enough_valid > validation.replicates) {
    throw InputError::format("{}: validation.enough_valid = {}: expected at most validation.replicates = {}",
                             place_of(source, entries, {"validation.enough_valid", "validation.replicates"}),
                             validation.enough_valid, validation.replicates);
  }
  const ProposalSettings& proposal = scenario.proposal;
  if (proposal.seeds > proposal.samples) {
    throw InputError::format("{}: proposal.seeds = {}: expected at most proposal.samples = {}",
                             place_of(source, entries, {"proposal.seeds", "proposal.samples"}), proposal.seeds,
                             proposal.samples);
  }
  check_budget(source, entries, scenario);
}

/// The document and its scenario.
std::pair<toml::table, Scenario> parse(std::string_view text, std::string_view source) {
  toml::table entries = read_toml(text, source);
  Scenario scenario;
  read_table(source, "", entries, scenario);
  check_together(source, entries, scenario);
  return {std::move(entries), std::move(scenario)};
}

/// Folders in which a file named in a scenario is searched, nearest first.
std::vector<std::filesystem::path> search_folders(const std::filesystem::path& scenario_path) {
  std::vector<std::filesystem::path> folders;
  const auto add_with_parents = [&](std::filesystem::path folder) {
    while (true) {
      folders.push_back(folder);
      if (folder == folder.parent_path()) return;
      folder = folder.parent_path();
    }
  };
  add_with_parents(std::filesystem::absolute(scenario_path).parent_path());
  add_with_parents(std::filesystem::current_path());
  folders.push_back(shipped_folder());
  return folders;
}

void resolve_file(const toml::table& entries, std::string_view key, const std::filesystem::path& scenario_path,
                  std::string& file) {
  if (file.empty()) return;
  const auto is_file = [](const std::filesystem::path& path) {
    std::error_code unreadable;
    return std::filesystem::is_regular_file(path, unreadable);
  };
  const std::filesystem::path name(file);
  if (name.is_absolute() && is_file(name)) return;
  if (name.is_relative()) {
    for (const auto& folder : search_folders(scenario_path)) {
      const auto candidate = (folder / name).lexically_normal();
      if (!is_file(candidate)) continue;
      file = candidate.string();
      return;
    }
  }
  throw InputError::format(
      "{}: {} = \"{}\": no such file; expected a path, absolute or relative to the scenario, to a "
      "folder above it or to the working folder",
      place_of(scenario_path.string(), entries, {key}), key, file);
}

}  // namespace

std::vector<std::string> Scenario::nodes() const {
  std::vector<std::string> names(kNodes.begin(), kNodes.end());
  if (!laboratory.virtual_lab) std::erase(names, "virtual_lab");
  return names;
}

Scenario parse_scenario(std::string_view text, std::string_view source) { return parse(text, source).second; }

Scenario read_scenario(const std::filesystem::path& path) {
  auto [entries, scenario] = parse(read_file(path), path.string());
  resolve_file(entries, "benchmark_file", path, scenario.benchmark_file);
  resolve_file(entries, "base_materials_file", path, scenario.base_materials_file);
  resolve_file(entries, "model_file", path, scenario.model_file);
  resolve_file(entries, "ranges_file", path, scenario.ranges_file);
  resolve_file(entries, "numerics_floor_file", path, scenario.discretisation_floor_file);
  resolve_file(entries, "laboratory.file", path, scenario.laboratory.file);
  return std::move(scenario);
}

std::string to_toml(const Scenario& scenario) {
  std::string text = "# Scenario of nacre; launch/README.md explains how to write one.\n";
  std::string_view table;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.table != table) {
      table = key.table;
      text += fmt::format("\n[{}]\n", table);
    }
    text += fmt::format("{} = {}  # {}; {}\n", key.name, key.write(scenario), key.meaning, key.allowed);
  }
  return text;
}

}  // namespace nacre::game
