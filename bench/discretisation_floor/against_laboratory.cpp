// Residuals between virtual laboratory and testers at the same truth, without scatter and without effects: the
// discretisation floor of every error budget. Results: docs/studies/discretisation-floor.md.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "base_refit.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/laboratory.hpp"
#include "pattern/random_pattern.hpp"
#include "study/study_command.hpp"
#include "tester/modulus.hpp"
#include "tester/toughness.hpp"

namespace {

using namespace nacre;
using namespace nacre::discretisation_floor;
using laboratory::Truth;

struct Options {
  int layouts = 40, toughness_layouts = 40;
  std::uint64_t seed = 1;
  std::string fidelity = "preview";
  std::string output, table;
  int threads = 0;
};

/// A number per design; nothing where a simulation failed.
using Values = std::vector<std::optional<double>>;

/// `value_of` of every pattern, in parallel.
template <class ValueOf>
Values values_of(const std::vector<pattern::Pattern>& patterns, int threads, const ValueOf& value_of) {
  Values values(patterns.size());
  parallel_for(
      static_cast<int>(patterns.size()),
      [&](int i) {
        const Result<double> value = value_of(patterns[i]);
        if (value)
          values[i] = *value;
        else
          std::fprintf(stderr, "%s: %s\n", patterns[i].key().c_str(), value.error().message.c_str());
      },
      threads);
  return values;
}

/// Logarithms of both where both exist.
std::pair<std::vector<double>, std::vector<double>> paired_logs(const Values& a, const Values& b) {
  std::pair<std::vector<double>, std::vector<double>> logs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i] || !b[i]) continue;
    logs.first.push_back(std::log(*a[i]));
    logs.second.push_back(std::log(*b[i]));
  }
  return logs;
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(a[i] - b[i]);
  return result;
}

Values laboratory_values(const Truth& truth, const std::vector<pattern::Pattern>& patterns, tester::TestKind test,
                         tester::Fidelity fidelity, int threads) {
  return values_of(patterns, threads, [&](const pattern::Pattern& pattern) -> Result<double> {
    const auto response =
        laboratory::respond(truth, {.design = pattern, .test = test, .conditions = {}, .fidelity = fidelity});
    if (!response) return tl::unexpected(response.error());
    return test == tester::TestKind::modulus ? response->modulus_pa : tester::area_under(response->curve);
  });
}

Values tester_moduli(const material::ModulusParameters& theta, const std::vector<pattern::Pattern>& patterns,
                     tester::Fidelity fidelity, int threads) {
  material::ParameterSet parameters = material::default_parameters();
  parameters.modulus = theta;
  return values_of(patterns, threads, [&](const pattern::Pattern& pattern) -> Result<double> {
    const auto result =
        tester::test_modulus({.design = pattern, .parameters = parameters, .conditions = {}, .fidelity = fidelity});
    if (!result) return tl::unexpected(result.error());
    return result->modulus_pa;
  });
}

Values tester_toughnesses(const material::ToughnessParameters& eta, const std::vector<pattern::Pattern>& patterns,
                          tester::Fidelity fidelity, int threads) {
  material::ParameterSet parameters = material::default_parameters();
  parameters.toughness = eta;
  return values_of(patterns, threads, [&](const pattern::Pattern& pattern) -> Result<double> {
    const auto result =
        tester::test_toughness({.design = pattern, .parameters = parameters, .conditions = {}, .fidelity = fidelity});
    if (!result) return tl::unexpected(result.error());
    return result->toughness_pa;
  });
}

/// Modulus keys of one fidelity: at the truth, after a common factor, after a refit of the six constants.
std::string study_moduli(const Truth& truth, const std::vector<pattern::Pattern>& patterns, tester::Fidelity fidelity,
                         int threads, std::string& table) {
  const Values laboratory = laboratory_values(truth, patterns, tester::TestKind::modulus, fidelity, threads);
  const Values testers = tester_moduli(truth.modulus, patterns, fidelity, threads);
  const auto [target, at_truth] = paired_logs(laboratory, testers);
  if (target.size() != patterns.size()) throw InputError("a modulus simulation failed, see above");
  const std::vector<double> raw = minus(target, at_truth);
  const ModulusRefit refit = refit_moduli(target, truth.modulus, [&](const material::ModulusParameters& theta) {
    std::vector<double> logs;
    for (const auto& value : tester_moduli(theta, patterns, fidelity, threads)) logs.push_back(std::log(value.value()));
    return logs;
  });
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    table += fmt::format("{},modulus,{},{:.2f},{:.6g},{:.6g},{:.5f}\n", tester::to_string(fidelity), patterns[i].key(),
                         patterns[i].rigid_fraction(), *laboratory[i], *testers[i], refit.residual[i]);
  }
  return fmt::format(
      "modulus_layouts = {}\nlog_modulus_mean = {:.4f}  # laboratory - tester at the truth\n"
      "log_modulus_sd_rescaled = {:.5f}  # after one common factor\n"
      "log_modulus_sd = {:.5f}  # after a refit of {} constants\n",
      patterns.size(), mean(raw), standard_deviation(raw), root_mean_square(refit.residual, refit.free_parameters),
      refit.free_parameters);
}

/// Toughness keys of one fidelity: at the truth and after a common factor.
std::string study_toughness(const Truth& truth, const std::vector<pattern::Pattern>& patterns,
                            tester::Fidelity fidelity, int threads, std::string& table) {
  const Values laboratory = laboratory_values(truth, patterns, tester::TestKind::toughness, fidelity, threads);
  const Values testers = tester_toughnesses(truth.toughness, patterns, fidelity, threads);
  const auto [target, at_truth] = paired_logs(laboratory, testers);
  const std::vector<double> raw = minus(target, at_truth);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (!laboratory[i] || !testers[i]) continue;
    table += fmt::format("{},toughness,{},{:.2f},{:.6g},{:.6g},{:.5f}\n", tester::to_string(fidelity),
                         patterns[i].key(), patterns[i].rigid_fraction(), *laboratory[i], *testers[i],
                         std::log(*laboratory[i] / *testers[i]) - mean(raw));
  }
  return fmt::format(
      "toughness_layouts = {}\nlog_toughness_mean = {:.4f}  # laboratory - tester at the truth\n"
      "log_toughness_sd = {:.5f}  # after one common factor\ntoughness_spearman = {:.3f}\n",
      raw.size(), mean(raw), standard_deviation(raw), rank_correlation(target, at_truth));
}

void run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  Truth truth = laboratory::draw_truth(options.seed, tester::Fidelity::full);
  truth.effects = {};
  RandomStream random(options.seed, "numerics floor");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(options.layouts, random);
  std::string table = "fidelity,test,pattern,rigid_fraction,laboratory_pa,tester_pa,log_residual\n";
  std::string text = fmt::format(
      "# Residuals between virtual laboratory and testers at the same truth, without scatter and effects; natural\n"
      "# logarithms. Method and figures: docs/studies/discretisation-floor.md.\n"
      "command = \"laboratory_floor --layouts {} --toughness-layouts {} --fidelity {} --seed {}\"\nseed = {}\n",
      options.layouts, options.toughness_layouts, options.fidelity, options.seed, options.seed);
  const auto count = std::min(patterns.size(), static_cast<std::size_t>(options.toughness_layouts));
  const std::vector<pattern::Pattern> fractured(patterns.begin(),
                                                patterns.begin() + static_cast<std::ptrdiff_t>(count));
  std::string full_moduli;
  for (const tester::Fidelity fidelity : {tester::Fidelity::full, tester::Fidelity::preview, tester::Fidelity::tiny}) {
    text += fmt::format("\n[{}]\n", tester::to_string(fidelity));
    // The modulus specimen of preview is that of full.
    const bool same_as_full = fidelity == tester::Fidelity::preview;
    if (!same_as_full) full_moduli = study_moduli(truth, patterns, fidelity, options.threads, table);
    text += full_moduli;
    if (tester::to_string(fidelity) != options.fidelity || fractured.empty()) continue;
    text += study_toughness(truth, fractured, fidelity, options.threads, table);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{}\n# {:.0f} s\n", text, seconds);
  if (!options.output.empty()) write_file_atomically(options.output, text);
  if (!options.table.empty()) write_file_atomically(options.table, table);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Discretisation floor: the virtual laboratory against the testers at the same truth"};
  Options options;
  app.add_option("--layouts", options.layouts, "Random layouts, stratified 50-85 %")->check(CLI::Range(10, 1000));
  app.add_option("--toughness-layouts", options.toughness_layouts, "How many of them have a fracture test too; 0: none")
      ->check(CLI::Range(0, 1000));
  app.add_option("--fidelity", options.fidelity, "Of the toughness specimens")
      ->check(CLI::IsMember({"tiny", "preview", "full"}));
  app.add_option("--seed", options.seed, "Of truth and layouts");
  app.add_option("--threads", options.threads, "0: all allowed cores")->check(CLI::Range(0, 1024));
  app.add_option("--out", options.output, "TOML file to write");
  app.add_option("--table", options.table, "CSV file with every design");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
