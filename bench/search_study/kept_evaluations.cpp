#include "kept_evaluations.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/processor_time.hpp"
#include "base/result.hpp"
#include "explore/mechanics.hpp"
#include "explore/synthetic.hpp"
#include "material/parameter_file.hpp"
#include "tester/modulus.hpp"
#include "tester/simulation_key.hpp"
#include "tester/toughness.hpp"

namespace nacre::search_study {
namespace {

std::string table_path(const Options& options) {
  return fmt::format("{}/evaluations-{}-{}-kernel{}.csv", options.work, options.fidelity, options.set,
                     tester::kKernelVersion);
}

/// Nothing: the stand-in of the unit tests takes the testers' place.
std::optional<tester::Fidelity> fidelity_named(const std::string& name) {
  if (name == "stand-in") return std::nullopt;
  const auto fidelity = tester::fidelity_from_string(name);
  if (!fidelity) throw InputError(fidelity.error().message);
  return *fidelity;
}

/// Throws InputError where the folder holds evaluations of another model under the name of this set.
void check_set(const Options& options, const material::ParameterSet& parameters) {
  if (options.params.empty() != (options.set == Options{}.set))
    throw InputError::format("--set {}: expected a name of its own for --params FILE, and `{}` without", options.set,
                             Options{}.set);
  std::filesystem::create_directories(options.work);
  const std::filesystem::path file = fmt::format("{}/parameters-{}.toml", options.work, options.set);
  const std::string text = material::to_toml(parameters);
  if (!std::filesystem::exists(file)) write_file_atomically(file, text);
  if (read_file(file) != text)
    throw InputError::format("{}: is the model of --set {}, expected the same one or another name", file.string(),
                             options.set);
}

material::ParameterSet parameters_of(const Options& options) {
  const material::ParameterSet built_in = material::default_parameters();
  const material::ParameterSet parameters =
      options.params.empty() ? built_in : material::read_parameters(options.params, built_in);
  check_set(options, parameters);
  return parameters;
}

}  // namespace

KeptEvaluations::KeptEvaluations(const Options& options)
    : fidelity_(fidelity_named(options.fidelity)),
      parameters_(parameters_of(options)),
      table_(table_path(options), {"modulus_pa", "toughness_pa"}) {}

KeptEvaluations::KeptPerformance KeptEvaluations::operator()(const pattern::Pattern& pattern, int specimen) {
  const auto performance = [](double modulus_pa, double toughness_pa) {
    return modulus_pa < 0.0 ? std::nullopt : std::optional(optimize::Performance{modulus_pa, toughness_pa});
  };
  const std::string key = specimen == 0 ? pattern.key() : fmt::format("{}/{}", pattern.key(), specimen);
  if (const auto known = table_.find(key)) return {performance((*known)[0], (*known)[1]), 0.0};
  if (!fidelity_) return {explore::synthetic_performance(pattern), 0.0};
  const double begin = processor_time_s();
  const tester::Simulation simulation{pattern, parameters_, {}, *fidelity_, specimen};
  const auto modulus = tester::test_modulus(simulation);
  const auto toughness = tester::test_toughness(simulation);
  const bool sound = modulus && toughness;
  table_.add(key, {sound ? modulus->modulus_pa : -1.0, sound ? toughness->toughness_pa : -1.0});
  // Looked up again: an answer must not depend on whether it was just simulated, and the file keeps nine digits.
  const double spent = processor_time_s() - begin;
  const auto kept = table_.find(key).value();
  return {performance(kept[0], kept[1]), spent};
}

explore::Mechanics mechanics_of(const Options& options) {
  explore::Mechanics mechanics;
  if (const auto fidelity = fidelity_named(options.fidelity)) {
    mechanics = explore::mechanics_by_tester(parameters_of(options), *fidelity, options.threads);
  } else {
    mechanics.modulus_of = [](std::span<const pattern::Pattern> patterns) {
      std::vector<std::optional<double>> moduli;
      for (const pattern::Pattern& pattern : patterns)
        moduli.push_back(explore::synthetic_performance(pattern).modulus_pa);
      return moduli;
    };
  }
  if (options.believed_modulus) mechanics.modulus_of = {};
  if (options.cells == "loads" || options.cells == "none") mechanics.cell_modulus = {};
  if (options.cells == "modulus" || options.cells == "none") mechanics.cell_loads = {};
  return mechanics;
}

}  // namespace nacre::search_study
