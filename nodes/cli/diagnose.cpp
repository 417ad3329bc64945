// Part of the command line (command.hpp): nacre diagnose, what the simulation gets wrong, and why.

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "base/counted.hpp"
#include "base/files.hpp"
#include "base/output_path.hpp"
#include "command.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/json.hpp"
#include "diagnosis/kept_emulator.hpp"
#include "diagnosis/plan.hpp"
#include "diagnosis/table_trends.hpp"
#include "diagnosis/words.hpp"
#include "material/effect_words.hpp"
#include "material/extensions.hpp"
#include "offline/diagnose.hpp"
#include "output.hpp"
#include "pattern/coupons.hpp"
#include "progress.hpp"
#include "report/diagnosis_page.hpp"
#include "report/report_diagnosis.hpp"
#include "shipped_files.hpp"

namespace nacre::cli {
namespace {

struct DiagnoseOptions {
  std::string set;
  std::string parameters, ranges;
  std::string fidelity = "preview";
  std::string table, measured, predicted;
  std::string discretisation_floor;
  std::string store, report;
  int search_budget = 40;
  std::uint64_t seed = 1;
  int bootstraps = 2000;
  bool json = false, plan = false, no_fracture = false, kept_emulator = false;
};

/// Orientation, and what is unlike the usual test: " at 90 degrees, at 0.00617 /s, 1.6 mm thick".
std::string conditions_in_words(const tester::TestConditions& c) {
  const tester::TestConditions usual;
  std::string words = fmt::format(" at {:.0f} degrees", c.orientation_deg);
  if (c.strain_rate_per_s != usual.strain_rate_per_s) words += fmt::format(", at {:.3g} /s", c.strain_rate_per_s);
  if (c.thickness_mm != usual.thickness_mm) words += fmt::format(", {:.3g} mm thick", c.thickness_mm);
  return words;
}

std::string size_or_dash(const std::optional<double>& size) { return size ? fmt::format("{:.3g}", *size) : "-"; }

/// One line per candidate effect under headings, which the page of --report explains; then those that do not apply.
void print_candidates(const diagnosis::Diagnosis& d) {
  constexpr const char* kHeadings = "  {:<34} {:<26} {:>18} {:>7} {:>9} {:>6}  {}\n";
  std::string unseen;
  bool is_first = true;
  for (const diagnosis::CandidateEffect& c : d.candidates) {
    if (!diagnosis::was_weighed(c.status)) {
      unseen += (unseen.empty() ? "" : ", ") + material::effect_in_words(c.name);
      continue;
    }
    if (std::exchange(is_first, false)) {
      fmt::print(kHeadings, "candidate effect", "status", "improvement of fit", "chance", "imitated", "SNR",
                 "visible from");
      fmt::print(kHeadings, "", "", "(chi squared)", "", "by base", "", "");
    }
    const std::string_view unit = material::find_effect(c.name)->parameters.front().unit;
    fmt::print("  {:<34} {:<26} {:>18.1f} {:>7.4f} {:>7.0f} % {:>6.1f}  {}{}\n", material::effect_in_words(c.name),
               report::status_in_words(to_string(c.status), c.p_family_wise), c.statistic, c.p_family_wise,
               100 * c.absorption, c.signal_to_noise, size_or_dash(c.smallest_seen),
               c.smallest_seen ? material::unit_behind_number(unit) : "");
  }
  if (!unseen.empty()) fmt::print("  these tests cannot say: {}\n", unseen);
}

/// What the residuals follow, and which tests would tell more.
void print_trends_and_next_tests(const diagnosis::Diagnosis& d) {
  for (std::size_t i = 0; i < d.contrasts.size() && i < 3; ++i) {
    fmt::print("  the residuals follow {} by {:.1f} standard deviations (chance {:.4f})\n", d.contrasts[i].name,
               d.contrasts[i].statistic, d.contrasts[i].p_family_wise);
  }
  for (const diagnosis::NextExperiment& e : d.next_experiments) {
    fmt::print("  next test: {} of {}{}{}, {}: {}\n", tester::to_string(e.test), pattern::readable_name(e.design),
               conditions_in_words(e.conditions), diagnosis::surroundings_in_words(e),
               counted(e.replicates, "specimen"), e.reason);
  }
}

int diagnose_table(const DiagnoseOptions& options) {
  const auto [trends, rejected] =
      diagnosis::table_trends(options.table, options.measured, options.predicted, options.seed);
  for (const auto& row : rejected) warn_about_table(row, options.table);
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const diagnosis::Trend& t : trends) {
    document.push_back(
        {{"column", t.column}, {"spearman", t.spearman}, {"p_family_wise", t.p_family_wise}, {"rows", t.rows}});
    if (!options.json)
      fmt::print("{:<32} rank correlation with the error {:+.3f}, chance {:.4f} ({})\n", t.column, t.spearman,
                 t.p_family_wise, counted(t.rows, "row"));
  }
  if (options.json) print_json({{"trends", document}, {"rejected", rejected_json(rejected)}});
  return 0;
}

diagnosis::DiagnosisSettings settings_from(const DiagnoseOptions& options) {
  diagnosis::DiagnosisSettings settings;
  const material::StartingModel model = starting_model_from_options(options.parameters, options.ranges);
  settings.ranges = model.ranges;
  settings.start = model.parameters;
  if (!settings.start.extensions.empty())
    warn(fmt::format("{}: its extensions are not used: a diagnosis begins with the base model", options.parameters));
  settings.fidelity = fidelity_from_option(options.fidelity);
  settings.seed = options.seed;
  settings.bootstraps = options.bootstraps;
  settings.floor =
      diagnosis::read_modulus_floor(discretisation_floor_file(options.discretisation_floor), settings.fidelity);
  settings.fracture_discretisation = diagnosis::read_fracture_discretisation(
      discretisation_floor_file(options.discretisation_floor), settings.fidelity);
  settings.store = options.store;
  settings.search_budget = options.search_budget;
  return settings;
}

measurement::MeasurementSet of_tests_wanted(measurement::MeasurementSet set, const DiagnoseOptions& options) {
  return options.no_fracture ? offline::without_fractures(std::move(set)) : set;
}

/// The status of an effect in a plan.
std::string_view plan_in_words(diagnosis::PlanStatus status) {
  switch (status) {
    case diagnosis::PlanStatus::told_apart:
      return "can be named";
    case diagnosis::PlanStatus::visible:
      return "visible, but not told apart";
    case diagnosis::PlanStatus::invisible:
      return "not visible";
    case diagnosis::PlanStatus::not_shown:
      break;
  }
  return "these tests cannot show it";
}

void print_plan(const diagnosis::Plan& plan) {
  fmt::print("{} in {}; the effect sizes from which a cause is visible, and from which it can be named\n",
             counted(plan.specimens, "specimen"), counted(plan.groups, "group"));
  constexpr const char* kLine = "  {:<34} {:<28} {:>12} {:>10} {:<24}  {}\n";
  fmt::print(kLine, "candidate effect", "status", "visible from", "named from", "unit",
             "most similar effect (collinearity)");
  for (const diagnosis::PlannedEffect& e : plan.effects) {
    fmt::print(kLine, material::effect_in_words(e.name), plan_in_words(e.status), size_or_dash(e.smallest_seen),
               size_or_dash(e.smallest_told_apart), e.unit,
               e.nearest_rival.empty()
                   ? "none"
                   : fmt::format("{} ({:.2f})", material::effect_in_words(e.nearest_rival), e.rival_cosine));
  }
  for (const diagnosis::PlannedAddition& a : plan.additions) {
    fmt::print("add {} ({} x {} specimens):\n", a.words, a.specimens.size(), a.replicates);
    for (const auto& c : a.changes)
      fmt::print("    {}: {} -> {}, named from {}\n", material::effect_in_words(c.effect), plan_in_words(c.from),
                 plan_in_words(c.to), size_or_dash(c.told_apart_from));
  }
}

int plan(const DiagnoseOptions& options) {
  if (options.set.empty())
    throw InputError("nacre diagnose --plan needs a measurement set, with or without measured values");
  const measurement::MeasurementSet set = of_tests_wanted(measurement::read_planned_set(options.set), options);
  warn_about(set, options.set);
  diagnosis::DiagnosisSettings settings = settings_from(options);
  Progress progress("plan");
  settings.progress = [&](double share, std::string_view phase) { progress.set_share(share, std::string(phase)); };
  const diagnosis::Plan plan = diagnosis::plan_diagnosis(set.specimens, settings);
  progress.end();
  if (options.json) {
    auto document = nlohmann::ordered_json::parse(to_json(plan));
    document["rejected"] = rejected_json(set.rejected);
    print_json(document);
    return 0;
  }
  print_plan(plan);
  return 0;
}

/// Throws InputError where options do not go together: none is left without effect.
void check_usage(const DiagnoseOptions& options) {
  const bool table = !options.table.empty();
  if (table && options.plan) throw InputError("nacre diagnose: expected either --plan or --table, not both");
  if (table && !options.set.empty())
    throw InputError("nacre diagnose: expected either a measurement set or --table, not both");
  if (!options.report.empty() && (table || options.plan))
    throw InputError("nacre diagnose: expected no --report with --plan or --table: the page is of a diagnosis");
  if (table && (options.measured.empty() || options.predicted.empty()))
    throw InputError("nacre diagnose --table: expected --measured and --predicted with the names of columns");
}

int diagnose(const DiagnoseOptions& options) {
  check_usage(options);
  if (!options.report.empty())
    prepare_output_file(options.report,
                        {options.set, options.parameters, options.ranges, options.discretisation_floor, options.store});
  if (options.plan) return plan(options);
  if (!options.table.empty()) return diagnose_table(options);
  if (options.set.empty())
    throw InputError("nacre diagnose needs a measurement set, or --table with --measured and --predicted");
  const measurement::MeasurementSet set = of_tests_wanted(measurement::read_plausible_set(options.set), options);
  warn_about(set, options.set);
  diagnosis::DiagnosisSettings settings = settings_from(options);
  Progress progress("diagnose");
  settings.progress = [&](double share, std::string_view phase) { progress.set_share(share, std::string(phase)); };
  if (options.kept_emulator) settings.fractures = diagnosis::kept_emulator(set.specimens, settings);
  const auto [d, unit_doubts] = offline::diagnose_set(set, settings);
  progress.end();
  warn_all(unit_doubts);
  if (!options.report.empty())
    write_file_atomically(options.report, report::render_diagnosis_page(d, options.set, settings.fidelity));
  if (options.json) {
    print_json(offline::diagnosis_json(d, set.rejected));
  } else {
    fmt::print("{}: {}\n", report::verdict_in_words(std::string(diagnosis::to_string(d.verdict))), d.summary);
    print_candidates(d);
    print_trends_and_next_tests(d);
  }
  return 0;
}

}  // namespace

void add_diagnose(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DiagnoseOptions>();
  CLI::App& command = add_command(app, action, "diagnose",
                                  "Show what the simulation gets wrong about measurements, and why", options, diagnose);
  command.add_option("SET", options->set, "Measurement set: a folder with measurements.csv (docs/FORMATS.md)");
  command.add_option("--params", options->parameters, "Parameter file with the initial guess of the base model");
  add_ranges(command, options->ranges);
  add_fidelity(command, options->fidelity)->capture_default_str();
  command.add_option("--discretisation-floor", options->discretisation_floor,
                     "File of discretisation errors; default: data/discretisation_floor.toml");
  command.add_flag("--no-fracture", options->no_fracture,
                   "Leave fracture tests out: a minute in place of an hour, and no word of effects on fracture alone");
  command.add_flag("--plan", options->plan,
                   "Before anything is measured: which effects these specimens could tell apart, and which few more "
                   "specimens would help");
  command.add_option("--report", options->report, "One self-contained HTML page for the person who measured");
  command.add_option("--store", options->store,
                     "File that keeps the fracture simulations, so that an interrupted diagnosis goes on; that of "
                     "nacre calibrate can be used");
  command
      .add_flag("--kept-emulator", options->kept_emulator,
                "Fracture tests at models about --params that do not follow the data: with --store another set of the "
                "same layouts needs no simulation")
      ->needs("--params");
  command
      .add_option("--search", options->search_budget,
                  "Most parameter sets tried for the base model of fracture tests; 0: begin at --params")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_option("--bootstraps", options->bootstraps, "Bootstrap samples behind the thresholds")
      ->check(CLI::Range(1000, 1'000'000))
      ->capture_default_str();
  add_seed(command, options->seed, "Seed of the bootstrap")->capture_default_str();
  command.add_option("--table", options->table,
                     "CSV table of any data, without patterns: prints only which columns the residuals follow");
  command.add_option("--measured", options->measured, "Column of measured values in --table")->needs("--table");
  command.add_option("--predicted", options->predicted, "Column of predicted values in --table")->needs("--table");
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
