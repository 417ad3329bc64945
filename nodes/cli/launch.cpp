// Part of the command line (command.hpp): nacre launch, which plays a game, and nacre record, its recorder.

#include <cstdio>
#include <string>

#include "analyser/analyser_core.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "dashboard/round_price.hpp"
#include "game/reference_tables.hpp"
#include "game/scenario.hpp"
#include "game/starting_point.hpp"
#include "material/unit_doubts.hpp"
#include "measurement/limits.hpp"
#include "output.hpp"
#include "replay_laboratory.hpp"
#include "runtime/interrupts.hpp"
#include "runtime/launcher.hpp"
#include "runtime/recorder.hpp"
#include "shipped_files.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::cli {
namespace {

/// Reads the files that a scenario names as its nodes will: what they refuse is said with the user's own path, before a
/// run is made that could only fail.
void check_inputs(const game::Scenario& scenario) {
  validation_agent::make_core(scenario);
  analyser::make_core(scenario);
  if (scenario.laboratory.virtual_lab) make_laboratory(scenario);
}

/// Own inks in one place and the thesis' in another: most likely something was forgotten.
void warn_about_inks(const game::Scenario& scenario) {
  const bool thesis_base = scenario.base_materials_file.ends_with(game::Scenario{}.base_materials_file);
  const bool own_model = !scenario.model_file.empty() || !scenario.ranges_file.empty();
  if (own_model && thesis_base)
    warn(
        "round 0 is fitted to the thesis' base materials; only the extensions of a model_file are kept. For other inks "
        "name their base_materials_file, or \"\" to begin with the model as it is");
  const bool own_inks = !scenario.ranges_file.empty() || (!scenario.base_materials_file.empty() && !thesis_base);
  if (own_inks && scenario.laboratory.virtual_lab && scenario.laboratory.file.empty())
    warn(
        "the virtual laboratory measures the thesis' inks: expected a laboratory.file with constants of yours "
        "([modulus], [toughness])");
}

/// Values of the user's own that no ink explains, but a mistaken unit.
void warn_about_units(const game::Scenario& scenario) {
  const material::StartingModel model = game::starting_model(scenario);
  if (!scenario.ranges_file.empty()) warn_all(material::unit_doubts(scenario.ranges_file, model.ranges));
  if (!scenario.model_file.empty())
    warn_all(material::unit_doubts(scenario.model_file, model.parameters, model.ranges));
  if (scenario.base_materials_file.empty()) return;
  for (const measurement::Replicates& material : game::read_base_materials(scenario.base_materials_file)) {
    if (measurement::kUsualModulusPa.hold(material.modulus_pa) && measurement::kToughnessPa.hold(material.toughness_pa))
      continue;
    warn(fmt::format("{}: {}: E {:g} GPa, T {:g} MPa: no usual material, is the unit right?",
                     scenario.base_materials_file, material.design.name(), 1e-9 * material.modulus_pa,
                     1e-6 * material.toughness_pa));
  }
}

/// What a game with people will ask of them, before it begins.
void say_price(const game::Scenario& scenario) {
  if (scenario.laboratory.virtual_lab || scenario.rounds < 1) return;
  fmt::print("{}\n", in_words(dashboard::price_of_round(scenario, {}, 1)));
  if (scenario.rounds > 1)
    fmt::print("each round after it: {}\n", in_words(dashboard::price_of_round(scenario, {}, 2).all));
  std::fflush(stdout);
}

/// Throws InputError for options that do not go together.
void check_together(const runtime::LaunchOptions& options) {
  if (options.scenario.empty() == options.resume.empty()) {
    throw InputError("nacre launch: expected either a SCENARIO.toml or --resume RUN");
  }
  if (!options.resume.empty() && options.seed) {
    throw InputError("nacre launch: --seed belongs to a new run; a resumed one keeps its seed");
  }
  if (!options.resume.empty() && !options.run_name.empty()) {
    throw InputError("nacre launch: --run names a new run; a resumed one keeps its folder");
  }
  if (!options.resume.empty() && options.logs) {
    throw InputError("nacre launch: --logs says where a new run is kept; a resumed one stays in its folder");
  }
  if (!options.only.empty() && options.resume.empty()) {
    throw InputError("nacre launch: --only joins a run: expected --resume RUN, its folder or a copy of it");
  }
  if (!options.only.empty() && options.max_log_mb > 0) {
    throw InputError("nacre launch: --max-log-mb belongs to the machine that records: expected it without --only");
  }
  if (!options.only.empty() && !options.elsewhere.empty()) {
    throw InputError("nacre launch: expected either --only or --elsewhere, not both");
  }
}

int play(const runtime::LaunchOptions& typed) {
  check_together(typed);
  runtime::LaunchOptions options = typed;
  if (!options.scenario.empty()) {
    options.scenario = scenario_file(typed.scenario);
    const game::Scenario scenario = game::read_scenario(options.scenario);
    check_inputs(scenario);
    warn_about_inks(scenario);
    warn_about_units(scenario);
    say_price(scenario);
  }
  return runtime::launch(options);
}

struct RecordOptions {
  std::string log;
  int port = 0;
  std::string hosts = "local";
  int max_log_mb = 0;
};

/// The first line on standard output tells the launcher that nothing published from now on is missed.
int record(const RecordOptions& options) {
  const runtime::Interrupts interrupts;
  runtime::RecorderOptions settings;
  settings.log = options.log;
  settings.most_bytes = 1'000'000 * static_cast<std::int64_t>(options.max_log_mb);
  settings.url = runtime::bus_url(options.port, options.hosts == "lan");
  settings.report = [](runtime::LogLevel level, const std::string& text) {
    level >= runtime::LogLevel::warning ? warn(text) : remark(text);
  };
  settings.ready = [&] {
    fmt::print("recording into {}\n", options.log);
    check_standard_output();
  };
  return runtime::run_recorder(settings, [&] { return interrupts.any(); });
}

void add_max_log(CLI::App& command, int& max_log_mb) {
  command
      .add_option(
          "--max-log-mb", max_log_mb,
          "Megabytes after which run.lcm goes on in run-2.lcm, run-3.lcm, ..., each with the latest state first; "
          "default: one file")
      ->check(CLI::Range(1, 1'000'000));
}

}  // namespace

void add_launch(CLI::App& app, Action& action) {
  const auto options = std::make_shared<runtime::LaunchOptions>();
  CLI::App& command = add_command(app, action, "launch",
                                  "Play a game: propose, measure, calibrate, diagnose, round by round", options, play);
  command.add_option("SCENARIO", options->scenario,
                     "Scenario file (launch/README.md), or the name of one that comes with nacre, such as demo");
  command.add_option("--resume", options->resume, "Folder of a run to continue");
  command.add_option("--run", options->run_name, "Name of the run and its folder; default: date-time-scenario");
  command.add_option("--logs", options->logs, "Folder where the new run is kept; default: logs");
  command.add_option("--port", options->port, "UDP port of the run instead of the scenario's; 0: any free one")
      ->check(CLI::Range(0, 65535));
  command.add_option("--programs", options->program_folder, "Folder of the nodes' programs; default: that of nacre");
  command.add_flag("--dashboard", options->dashboard, "Show the run in the browser while it plays; prints the address");
  add_seed(command, options->seed, "Seed instead of the scenario's");
  command
      .add_option_function<double>(
          "--restart-s",
          [options](double wait_s) {
            options->restarts.first_wait =
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(wait_s));
          },
          "Seconds until a node that died is started again, the first time in a row; default: 0.5")
      ->check(CLI::Range(0.001, 30.0));
  add_max_log(command, options->max_log_mb);
  command.add_option("--elsewhere", options->elsewhere,
                     "Node that is started on another machine (hosts = \"lan\"); repeatable");
  command.add_option("--debug", options->debug,
                     "Node that waits at its start until a debugger attaches; its process number is said; repeatable");
  command.add_option("--only", options->only,
                     "With --resume: start this node alone, for a run launched on another machine; repeatable");
}

void add_record(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RecordOptions>();
  CLI::App& command =
      add_command(app, action, "record", "Record all messages of a run (started by launch)", options, record);
  command.add_option("--log", options->log, "LCM log to append to")->required();
  command.add_option("--port", options->port, "UDP port of the run")->required()->check(CLI::Range(1, 65535));
  command.add_option("--hosts", options->hosts, "local or lan")->check(CLI::IsMember({"local", "lan"}));
  add_max_log(command, options->max_log_mb);
}

}  // namespace nacre::cli
