// Blind trials of the diagnosis (docs/METHODS.md, "Diagnosis"): the virtual laboratory hides effects, nacre diagnose
// sees the measurements alone, the truth is opened for scoring. A folder per trial and a line in the study's table; a
// trial that has a line is not repeated.

#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/files.hpp"
#include "power.hpp"
#include "runtime/process.hpp"
#include "score.hpp"
#include "study/study_command.hpp"
#include "study/text_table.hpp"
#include "true_gain.hpp"

namespace {

using namespace nacre;
using namespace nacre::blind_trials;
namespace fs = std::filesystem;

struct Options {
  TrialOptions trials;
  std::string fidelity = "full", work = "blind_trials", table, only, commit, report, gains, figure;
  double seconds = 1e9;
};

/// Seeds of a report follow from the commit under test, so that they cannot be chosen.
std::uint64_t report_seed(const std::string& commit) {
  return 1'000'000 + std::stoull(commit.substr(0, 7), nullptr, 16) * 1000;
}

/// Hides, prints, measures, diagnoses; a trial that was diagnosed before and has no line yet is opened only.
TrialDiagnosis play(const BlindTrial& trial, const Options& options) {
  const fs::path folder = fs::path(options.work) / trial.name;
  if (!fs::exists(folder / "diagnosis.json")) {
    generate(trial, options.trials, folder);
    diagnose(trial, options.trials, folder);
    if (trial.kind == "resolved") {
      print_what_was_ordered(trial, options.trials, folder);
      diagnose(trial, options.trials, folder);
    }
  }
  return open_trial(trial, options.commit, folder);
}

/// Gains in cross-validation of the trials that were named rightly, with that of the true model: a line in the table of
/// gains each.
void compare_gains(const Options& options, const std::vector<Score>& scores) {
  study::TextTable table(options.gains, {"trial", "named", "truth", "named_features", "truth_features"});
  for (const Score& s : scores) {
    if (s.trial.kind != "effect" || !s.right_name || table.find(s.trial.name)) continue;
    const TrueGain gain = true_gain(s.trial, options.trials, fs::path(options.work) / s.trial.name);
    std::vector<std::string> cells;
    for (const double value : {gain.named, gain.truth, gain.named_features, gain.truth_features})
      cells.push_back(fmt::format("{:.4f}", value));
    table.add(s.trial.name, cells);
    fmt::print(stderr, "{}: {}\n", s.trial.name, fmt::join(cells, ", "));
  }
}

void run(Options options) {
  options.trials.fidelity = *tester::fidelity_from_string(options.fidelity);
  if (!options.report.empty()) options.trials.first_seed = report_seed(options.report);
  if (options.trials.pools.empty()) options.trials.pools = options.work + "-pools";
  const auto began = std::chrono::steady_clock::now();
  study::TextTable table(options.table.empty() ? options.work + ".csv" : options.table, diagnosis_columns());
  std::vector<Score> scores;
  int waiting = 0;
  for (const BlindTrial& trial : all_trials(options.trials)) {
    if (!options.only.empty() && trial.name.find(options.only) == std::string::npos) continue;
    const bool finished = table.find(trial.name).has_value();
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!finished && spent > options.seconds) {
      ++waiting;
      continue;
    }
    if (!finished) table.add(trial.name, to_cells(play(trial, options)));
    scores.push_back(score_of(trial, diagnosis_from_cells(*table.find(trial.name))));
    if (!finished)
      fmt::print(stderr, "{}: {} {}\n", trial.name, scores.back().diagnosis.verdict,
                 scores.back().right_name ? "(right)" : "");
  }
  if (waiting > 0) fmt::print(stderr, "{} trials are still waiting: run it again\n", waiting);
  fmt::print("{}", report_of(scores));
  if (!options.gains.empty()) compare_gains(options, scores);
  if (options.figure.empty()) return;
  fmt::print("\n{}", power_table(scores));
  write_file_atomically(options.figure, power_figure(scores));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Blind trials of the diagnosis"};
  Options options;
  study::add_fidelity_option(app, options.fidelity);
  options.trials.program = (runtime::this_program().parent_path() / "nacre").string();
  app.add_option("--program", options.trials.program, "nacre under test; default: the one next to this program")
      ->capture_default_str();
  app.add_option("--work", options.work, "Folder of the trials")->capture_default_str();
  app.add_flag("--fracture", options.trials.fracture, "Toughness specimens besides the moduli");
  app.add_option("--nulls", options.trials.nulls)->capture_default_str();
  app.add_option("--outside", options.trials.outside)->capture_default_str();
  app.add_option("--forms", options.trials.forms, "Trials of known effects in another form")->capture_default_str();
  app.add_option("--doubles", options.trials.doubles)->capture_default_str();
  app.add_option("--alike", options.trials.alike)->capture_default_str();
  app.add_option("--homogeneous", options.trials.homogeneous, "Trials of tabulated moduli of blends")
      ->capture_default_str();
  app.add_option("--loops", options.trials.loops, "Trials of coupons that are unloaded on their way")
      ->capture_default_str();
  app.add_option("--machines", options.trials.machines, "Trials of tabulated moduli from two machines")
      ->capture_default_str();
  app.add_option("--spectra", options.trials.spectra, "Trials of tabulated moduli over seven decades of the rate")
      ->capture_default_str();
  app.add_option("--warm", options.trials.warm, "Trials of tabulated moduli at three temperatures")
      ->capture_default_str();
  app.add_option("--fracture-nulls", options.trials.fracture_nulls, "Trials of fracture tests with nothing hidden")
      ->capture_default_str();
  app.add_option("--fracture-seeds", options.trials.fracture_seeds, "Trials of each effect on fracture, and size")
      ->capture_default_str();
  app.add_option("--pools", options.trials.pools,
                 "Folder of what trials of fracture tests share; default: the folder of the trials, -pools");
  app.add_option("--distorted", options.trials.distorted, "Trials of moduli that a smooth law distorts")
      ->capture_default_str();
  app.add_option("--pairs", options.trials.pairs)->capture_default_str();
  app.add_option("--seeds", options.trials.seeds_per_effect, "Trials of each effect, size and scatter")
      ->capture_default_str();
  app.add_option("--power", options.trials.power, "Trials of each known effect at signal-to-noise ratios of 3 to 12")
      ->capture_default_str();
  app.add_option("--first-seed", options.trials.first_seed, "Tuning seeds begin here")
      ->check(CLI::Range(1, 999'999))
      ->capture_default_str();
  app.add_option("--table", options.table,
                 "CSV of finished trials, read and continued; default: the folder of the trials, .csv");
  app.add_option("--commit", options.commit, "Commit under test, for the table")->required();
  app.add_option("--report", options.report, "Commit under test, hexadecimal: a report, with seeds of its own")
      ->excludes("--first-seed");
  app.add_option("--only", options.only, "Trials whose name contains this");
  app.add_option(
      "--gains", options.gains,
      "CSV of gains in cross-validation, of the named and of the true model, for trials that were named rightly");
  app.add_option("--figure", options.figure,
                 "SVG of the power against the signal-to-noise ratio; prints its numbers too");
  app.add_option("--seconds", options.seconds, "Begins nothing new after so long");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
