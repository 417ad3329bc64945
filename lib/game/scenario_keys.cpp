#include "game/scenario_keys.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "base/names.hpp"

namespace nacre::game {
namespace {

/// Reference to one member of a scenario, so that a key can both read and write it.
template <class T>
using Access = std::function<T&(Scenario&)>;

/// Access to a member of one of a scenario's tables, or of the scenario itself.
template <class T>
Access<T> at(T Scenario::*member) {
  return [member](Scenario& scenario) -> T& { return scenario.*member; };
}
template <class Table, class T>
Access<T> at(Table Scenario::*table, T Table::*member) {
  return [table, member](Scenario& scenario) -> T& { return scenario.*table.*member; };
}

template <class T>
const T& value_in(const Access<T>& access, const Scenario& scenario) {
  return access(const_cast<Scenario&>(scenario));  // NOLINT: only read here
}

std::string toml_string(const std::string& text) {
  const toml::value<std::string> value(text);
  std::ostringstream out;
  out << toml::toml_formatter(value, toml::format_flags::none);
  return out.str();
}

/// A floating-point number in the shortest form that reads back equal, with the point that TOML asks for.
std::string toml_float(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

template <class Integer>
ScenarioKey whole_number(std::string_view table, std::string_view name, std::string_view meaning, Integer minimum,
                         std::int64_t maximum, Access<Integer> access) {
  const auto low = static_cast<std::int64_t>(minimum);
  return {table,
          name,
          meaning,
          fmt::format("a whole number from {} to {}", low, maximum),
          [=](const toml::node& node, Scenario& scenario) {
            const auto value = node.value_exact<std::int64_t>();
            if (!value || *value < low || *value > maximum) return false;
            access(scenario) = static_cast<Integer>(*value);
            return true;
          },
          [=](const Scenario& scenario) { return fmt::format("{}", value_in(access, scenario)); }};
}

ScenarioKey number(std::string_view table, std::string_view name, std::string_view meaning, double minimum,
                   double maximum, Access<double> access) {
  return {table,
          name,
          meaning,
          fmt::format("a number from {} to {}", minimum, maximum),
          [=](const toml::node& node, Scenario& scenario) {
            const auto value = node.is_number() ? node.value<double>() : std::nullopt;
            if (!value || !(*value >= minimum && *value <= maximum)) return false;
            access(scenario) = *value;
            return true;
          },
          [=](const Scenario& scenario) { return toml_float(value_in(access, scenario)); }};
}

ScenarioKey flag(std::string_view table, std::string_view name, std::string_view meaning, Access<bool> access) {
  return {table,
          name,
          meaning,
          "true or false",
          [=](const toml::node& node, Scenario& scenario) {
            const auto value = node.value_exact<bool>();
            if (value) access(scenario) = *value;
            return value.has_value();
          },
          [=](const Scenario& scenario) { return value_in(access, scenario) ? "true" : "false"; }};
}

ScenarioKey text(std::string_view table, std::string_view name, std::string_view meaning, std::string allowed,
                 std::function<bool(const std::string&)> is_allowed, Access<std::string> access) {
  return {table,
          name,
          meaning,
          std::move(allowed),
          [=](const toml::node& node, Scenario& scenario) {
            const auto value = node.value_exact<std::string>();
            if (!value || !is_allowed(*value)) return false;
            access(scenario) = *value;
            return true;
          },
          [=](const Scenario& scenario) { return toml_string(value_in(access, scenario)); }};
}

ScenarioKey choice(std::string_view table, std::string_view name, std::string_view meaning,
                   std::vector<std::string> choices, Access<std::string> access) {
  std::string allowed;
  for (const std::string& one : choices) allowed += (allowed.empty() ? "\"" : ", \"") + one + "\"";
  const auto is_choice = [choices](const std::string& value) {
    return std::find(choices.begin(), choices.end(), value) != choices.end();
  };
  return text(table, name, meaning, "one of " + allowed, is_choice, std::move(access));
}

ScenarioKey file_name(std::string_view table, std::string_view name, std::string_view meaning,
                      Access<std::string> access) {
  const auto without_null = [](const std::string& value) { return value.find('\0') == std::string::npos; };
  return text(table, name, meaning, "the name of a file, or \"\" for none", without_null, std::move(access));
}

ScenarioKey fidelity_key() {
  return {"",
          "fidelity",
          "how specimens are simulated and measured",
          R"(one of "tiny", "preview", "full")",
          [](const toml::node& node, Scenario& scenario) {
            const auto value = node.value_exact<std::string>();
            const auto fidelity = tester::fidelity_from_string(value.value_or(""));
            if (!value || !fidelity) return false;
            scenario.fidelity = *fidelity;
            return true;
          },
          [](const Scenario& scenario) { return toml_string(std::string(tester::to_string(scenario.fidelity))); }};
}

std::optional<std::vector<double>> rigid_fractions(const toml::node& node) {
  constexpr std::size_t kMost = 32;
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() > kMost) return std::nullopt;
  std::vector<double> fractions;
  std::set<double> seen;
  for (const toml::node& element : *array) {
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !(*value >= 0.0 && *value <= 1.0) || !seen.insert(*value).second) return std::nullopt;
    fractions.push_back(*value);
  }
  return fractions;
}

ScenarioKey mixtures_key() {
  return {"validation",
          "mixtures",
          "homogeneous mixtures measured in round 1 (rigid fractions): the benchmark line",
          "an array of at most 32 different numbers from 0 to 1",
          [](const toml::node& node, Scenario& scenario) {
            const auto fractions = rigid_fractions(node);
            if (fractions) scenario.validation.mixtures = *fractions;
            return fractions.has_value();
          },
          [](const Scenario& scenario) {
            std::string list;
            for (const double fraction : scenario.validation.mixtures) {
              list += (list.empty() ? "" : ", ") + toml_float(fraction);
            }
            return "[" + list + "]";
          }};
}

/// Options of sbatch: each begins with a dash and is one word for it, whatever it holds.
std::optional<std::vector<std::string>> cluster_options(const toml::node& node) {
  constexpr std::size_t kMost = 32, kLongest = 500;
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() > kMost) return std::nullopt;
  std::vector<std::string> options;
  for (const toml::node& element : *array) {
    const auto option = element.value_exact<std::string>();
    const bool is_option = option && option->starts_with("-") && option->size() <= kLongest &&
                           std::none_of(option->begin(), option->end(), [](char c) { return c >= 0 && c < ' '; });
    if (!is_option) return std::nullopt;
    options.push_back(*option);
  }
  return options;
}

ScenarioKey cluster_options_key() {
  return {"farm",
          "slurm_options",
          "further options of sbatch, such as \"--partition=short\"",
          "an array of at most 32 texts that begin with a dash",
          [](const toml::node& node, Scenario& scenario) {
            const auto options = cluster_options(node);
            if (options) scenario.farm.slurm_options = *options;
            return options.has_value();
          },
          [](const Scenario& scenario) {
            std::string list;
            for (const std::string& option : scenario.farm.slurm_options) {
              list += (list.empty() ? "" : ", ") + toml_string(option);
            }
            return "[" + list + "]";
          }};
}

/// Run folders and messages carry the name.
bool is_scenario_name(const std::string& name) { return is_plain_name(name, 40); }

std::vector<ScenarioKey> make_top_level_keys() {
  constexpr std::int64_t kLargestSeed = std::numeric_limits<std::int64_t>::max();
  return {
      text("", "name", "name of the scenario, part of the run's name",
           "1 to 40 of the characters A-Z, a-z, 0-9, _ and -", is_scenario_name, at(&Scenario::name)),
      whole_number<std::uint64_t>("", "seed", "every random choice of the run follows from it", 0, kLargestSeed,
                                  at(&Scenario::seed)),
      whole_number<int>("", "rounds", "number of the last round; round 0 is the base materials", 0, 100000,
                        at(&Scenario::rounds)),
      fidelity_key(),
      flag("", "stop_at_equilibrium",
           "end before the last round once two consecutive rounds bring no progress (launch/README.md)",
           at(&Scenario::stop_at_equilibrium)),
      choice("", "hosts", "where the nodes run: this machine, or machines of one local network", {"local", "lan"},
             at(&Scenario::hosts)),
      whole_number<int>("", "port", "UDP port of the run; 0: the launcher takes a free one", 0, 65535,
                        at(&Scenario::port)),
      whole_number<int>("", "farm_threads", "threads of the simulator farm; 0: all allowed cores", 0, 4096,
                        at(&Scenario::farm_threads)),
      file_name("", "benchmark_file",
                "measured homogeneous benchmark line for the selection when no mixtures are measured",
                at(&Scenario::benchmark_file)),
      file_name("", "base_materials_file",
                "measured base materials to which the model of round 0 is fitted; \"\": not fitted",
                at(&Scenario::base_materials_file)),
      file_name("", "model_file", "initial parameters of round 0, extensions included; \"\": the built-in ones",
                at(&Scenario::model_file)),
      file_name("", "ranges_file", "ranges of the fitted parameters, for other inks; \"\": those of the thesis",
                at(&Scenario::ranges_file)),
      file_name("", "numerics_floor_file",
                "discretisation floor: errors of the simulation itself, below which a diagnosis finds no cause",
                at(&Scenario::discretisation_floor_file)),
  };
}

std::vector<ScenarioKey> make_farm_keys() {
  constexpr auto table = &Scenario::farm;
  return {
      choice("farm", "executor",
             "where simulations run: threads of the farm's machine, tasks of a Slurm cluster, or a GPU and threads",
             {"local", "slurm", "cuda"}, at(table, &FarmSettings::executor)),
      cluster_options_key(),
      whole_number<int>("farm", "batch_s", "work of one task of the cluster, in seconds of one core", 1, 3600,
                        at(table, &FarmSettings::batch_s)),
  };
}

std::vector<ScenarioKey> make_proposal_keys() {
  constexpr auto table = &Scenario::proposal;
  return {
      choice("proposal", "algorithm", "search algorithm for the gamut",
             {"nsga2", "nsga2-single-pixel", "nsga2-rollback", "random", "learned", "tsemo", "dgemo"},
             at(table, &ProposalSettings::algorithm)),
      whole_number<int>("proposal", "samples", "simulations per gamut, all searches together", 1, 1'000'000,
                        at(table, &ProposalSettings::samples)),
      whole_number<int>("proposal", "seeds", "independent searches merged into one gamut", 1, 64,
                        at(table, &ProposalSettings::seeds)),
      whole_number<int>("proposal", "population", "population of each search", 2, 10'000,
                        at(table, &ProposalSettings::population)),
      whole_number<int>("proposal", "designs", "designs chosen for the laboratory each round", 1, 100,
                        at(table, &ProposalSettings::designs)),
      whole_number<int>(
          "proposal", "redraws",
          "further specimens of every candidate; its T is their mean (where all are alike: perturbed parameters)", 0,
          100, at(table, &ProposalSettings::realisations)),
  };
}

std::vector<ScenarioKey> make_validation_keys() {
  constexpr auto table = &Scenario::validation;
  return {
      whole_number<int>("validation", "random_patterns", "stratified random patterns measured in round 1", 0, 1000,
                        at(table, &ValidationSettings::random_patterns)),
      whole_number<int>("validation", "replicates", "specimens per design and test", 1, 100,
                        at(table, &ValidationSettings::replicates)),
      whole_number<int>("validation", "enough_valid",
                        "an order is complete with this many valid specimens; 0: with all replicates", 0, 100,
                        at(table, &ValidationSettings::enough_valid)),
      whole_number<int>("validation", "calibration_evaluations", "evaluations of the toughness set per round", 0,
                        100'000, at(table, &ValidationSettings::calibration_evaluations)),
      whole_number<int>("validation", "modulus_evaluations", "evaluations of the modulus set per round", 0, 100'000,
                        at(table, &ValidationSettings::modulus_evaluations)),
      whole_number<int>("validation", "calibration_batch", "parameter sets evaluated at once", 1, 64,
                        at(table, &ValidationSettings::calibration_batch)),
      mixtures_key(),
      flag("validation", "approval", "proposed designs wait for a person's `nacre approve`",
           at(table, &ValidationSettings::approval)),
  };
}

std::vector<ScenarioKey> make_remaining_keys() {
  constexpr auto diagnosis = &Scenario::diagnosis;
  constexpr auto budget = &Scenario::budget;
  constexpr auto laboratory = &Scenario::laboratory;
  return {
      flag("diagnosis", "enabled", "diagnose after each round which cause explains the prediction errors",
           at(diagnosis, &DiagnosisStageSettings::enabled)),
      whole_number<int>("diagnosis", "discrimination_orders",
                        "extra tests per round, each with its replicates, that discriminate between rival causes", 0,
                        20, at(diagnosis, &DiagnosisStageSettings::discrimination_orders)),
      whole_number<int>("diagnosis", "bootstraps", "bootstrap resamples for the decision threshold", 1000, 1'000'000,
                        at(diagnosis, &DiagnosisStageSettings::bootstraps)),
      whole_number<int>("diagnosis", "simulations",
                        "fracture tests that the farm may simulate for each diagnosis; 0: it leaves them out", 0,
                        1'000'000, at(diagnosis, &DiagnosisStageSettings::simulations)),
      whole_number<int>("budget", "specimens_per_round",
                        "most specimens a round orders: fewer replicates, then fewer designs; 0: no limit", 0,
                        1'000'000, at(budget, &BudgetSettings::specimens_per_round)),
      whole_number<int>("budget", "total", "most specimens that all rounds order together; 0: no limit", 0, 1'000'000,
                        at(budget, &BudgetSettings::total)),
      flag("laboratory", "virtual_lab", "true: the virtual laboratory measures; false: a person does (nacre inject)",
           at(laboratory, &LaboratorySettings::virtual_lab)),
      file_name("laboratory", "file", "LAB.toml of the virtual laboratory; \"\": its truth is drawn from the seed",
                at(laboratory, &LaboratorySettings::file)),
      number("laboratory", "layers_per_minute", "layers that the printer makes in a minute, a full tray at a time",
             0.001, 1000.0, at(laboratory, &LaboratorySettings::layers_per_minute)),
      number("laboratory", "minutes_per_test", "time of one specimen at the testing machine, measuring it included",
             0.01, 10'000.0, at(laboratory, &LaboratorySettings::minutes_per_test)),
      number("laboratory", "tray_x_mm", "printable part of the printer's tray", 175.0, 10'000.0,
             at(laboratory, &LaboratorySettings::tray_x_mm)),
      number("laboratory", "tray_y_mm", "the same, front to back", 175.0, 10'000.0,
             at(laboratory, &LaboratorySettings::tray_y_mm)),
  };
}

std::vector<ScenarioKey> make_family_keys() {
  constexpr auto table = &Scenario::families;
  return {
      flag("families", "enabled", "after the last round: families of good designs, each with a model of its own",
           at(table, &FamilySettings::enabled)),
      whole_number<int>("families", "rank", "seeds are measured designs of non-domination rank up to this", 1, 100,
                        at(table, &FamilySettings::rank)),
      whole_number<int>("families", "samples", "variants simulated around the seeds of a family", 1, 100'000,
                        at(table, &FamilySettings::samples)),
      whole_number<int>("families", "designs", "variants of a family chosen for the laboratory", 1, 100,
                        at(table, &FamilySettings::designs)),
      whole_number<int>("families", "calibration_evaluations", "evaluations of the toughness set for a family's model",
                        0, 100'000, at(table, &FamilySettings::calibration_evaluations)),
      whole_number<int>("families", "modulus_evaluations", "evaluations of the modulus set for a family's model", 0,
                        100'000, at(table, &FamilySettings::modulus_evaluations)),
  };
}

std::vector<ScenarioKey> make_keys() {
  std::vector<ScenarioKey> keys = make_top_level_keys();
  for (auto part :
       {make_farm_keys(), make_proposal_keys(), make_validation_keys(), make_family_keys(), make_remaining_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

}  // namespace

std::string ScenarioKey::path() const { return table.empty() ? std::string(name) : fmt::format("{}.{}", table, name); }

std::span<const ScenarioKey> scenario_keys() {
  static const std::vector<ScenarioKey> keys = make_keys();
  return keys;
}

}  // namespace nacre::game
