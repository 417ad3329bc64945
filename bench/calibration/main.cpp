// The study "System identification that predicts what it has not seen" (docs/studies/calibration). Every command may be
// interrupted and goes on where it stopped: simulations are kept in the folder --work, results are rows in the folder
// --out that are not computed twice.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "commands.hpp"

int main(int argc, char** argv) {
  using namespace nacre::calibration_study;
  CLI::App app("Calibration against virtual laboratories");
  app.require_subcommand(1);
  Options options;
  const auto add_common = [&](CLI::App& command) {
    command.add_option("--fidelity", options.fidelity, "tiny, preview or full")->capture_default_str();
    command.add_option("--begin-at", options.begin_at, "cheaper fidelity to calibrate at first");
    command.add_option("--first-seed", options.first_seed)->capture_default_str();
    command.add_option("--seeds", options.seeds, "laboratories")->capture_default_str();
    command.add_option("--fitted", options.fitted, "designs to calibrate on")->capture_default_str();
    command.add_option("--predicted", options.predicted, "designs to predict")->capture_default_str();
    command.add_option("--criterion", options.criterion, "by which the laboratory's material fails")
        ->capture_default_str();
    command.add_flag("--next", options.next_round, "predict the designs of the next round too");
    command.add_option("--search", options.searches, "how eta is searched; several may follow")->capture_default_str();
    command.add_option("--budget", options.budget, "evaluations of the toughness set")->capture_default_str();
    command.add_option("--ensemble", options.ensemble, "further parameter sets for predictions")->capture_default_str();
    command.add_option("--out", options.out, "folder of results")->capture_default_str();
    command.add_option("--work", options.work, "folder of kept simulations")->capture_default_str();
    command.add_option("--minutes", options.minutes, "stop after this time; run again to go on")->capture_default_str();
    command.add_option("--effect", options.effects, "hidden effects NAME=VALUE of the laboratory");
  };
  CLI::App* base = app.add_subcommand("base", "Base materials of Table 3.4, one at a time");
  CLI::App* measure =
      app.add_subcommand("measure", "Let the laboratories measure everything that the other commands will ask for");
  CLI::App* held_out = app.add_subcommand("held-out", "Calibrate, and predict designs that were not calibrated on");
  CLI::App* thesis =
      app.add_subcommand("thesis", "The schedule of the thesis: Bayesian optimisation, 5 + 200 x 3 evaluations");
  for (CLI::App* command : {base, measure, held_out, thesis}) add_common(*command);
  CLI11_PARSE(app, argc, argv);
  try {
    if (*base) study_base_materials(options);
    if (*measure) measure_laboratories(options);
    if (*held_out) study_held_out(options);
    if (*thesis) run_thesis_schedule(options);
  } catch (const TimeIsUp&) {
    fmt::print("time is up; run the same command again\n");
    return 1;
  } catch (const nacre::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
