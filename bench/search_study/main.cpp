// The study "A search that needs twenty times fewer simulations" (docs/studies/search.md). Every command may be stopped
// at any moment and goes on where it was: evaluations, batches and growth are files that are only ever appended to.

#include <algorithm>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "explore/gamut_csv.hpp"
#include "explore/learned.hpp"
#include "study/study_command.hpp"

namespace {

using nacre::search_study::Options;

void add_common(CLI::App& command, Options& options) {
  command.add_option("--work", options.work, "folder of evaluations, batches and growth")->capture_default_str();
  command.add_option("--fidelity", options.fidelity, "of the testers; stand-in: the formula of the unit tests instead")
      ->check(CLI::IsMember({"tiny", "preview", "full", "stand-in"}))
      ->capture_default_str();
  command.add_option("--params", options.params, "parameter file; default: the built-in parameters");
  command.add_option("--set", options.set, "name of the parameter set in file names")->capture_default_str();
  command.add_option("--variant", options.variant, "name of the run; default: the algorithm");
  command.add_option("--first-seed", options.first_seed)->capture_default_str();
  command.add_option("--seeds", options.seeds)->capture_default_str();
}

void add_learning(CLI::App& command, Options& options) {
  auto& learned = options.search.learned;
  command.add_option("--predictor", learned.predictor)->capture_default_str();
  command.add_option("--choice", learned.choice)->capture_default_str();
  command.add_option("--generations", learned.generations)->capture_default_str();
  command.add_option("--surrogate-population", learned.population)->capture_default_str();
  command.add_option("--optimism", learned.optimism)->capture_default_str();
  command.add_option("--most-samples", learned.most_samples)->capture_default_str();
  command.add_option("--members", learned.members)->capture_default_str();
  command.add_option("--warm-start", learned.warm_start)->capture_default_str();
  command.add_option("--weight-decay", learned.weight_decay)->capture_default_str();
  command.add_option("--dropout", learned.dropout)->capture_default_str();
  command.add_option("--floor-deviations", learned.floor_deviations)->capture_default_str();
  command.add_option("--specimens", learned.specimens)->capture_default_str();
  command.add_option("--apart", learned.apart)->capture_default_str();
  command.add_option("--barred-start", learned.barred_start)->capture_default_str();
  command.add_option("--barred-candidates", learned.barred_candidates)->capture_default_str();
  command.add_flag("--believed-modulus", options.believed_modulus,
                   "the modulus of finalists is believed like their toughness, not computed");
  command.add_option("--cells", options.cells, "what predictors know of unit cells in elastic equilibrium")
      ->check(CLI::IsMember({"both", "modulus", "loads", "none"}))
      ->capture_default_str();
  command.add_option("--former", options.former, "gamut.csv of other parameters or another fidelity, learnt from too")
      ->check(CLI::ExistingFile);
  command.add_flag_function(
      "--thesis", [&learned](std::int64_t) { learned = nacre::explore::thesis_learning(); }, "the learning of 2.3.3");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace nacre::search_study;
  CLI::App app("How many simulations a search of the gamut needs");
  app.require_subcommand(1);
  Options options;
  CLI::App* run = app.add_subcommand("run", "Search, seed after seed");
  CLI::App* held_out = app.add_subcommand("held-out", "Predict what a finished run asked for next");
  CLI::App* expected = app.add_subcommand("expected", "Test the fronts that runs report with further specimens");
  CLI::App* summary =
      app.add_subcommand("summary", "Samples to the goal, final hypervolumes and times of all variants");
  CLI::App* growth = app.add_subcommand("growth", "Draw hypervolume against samples");
  CLI::App* predicted = app.add_subcommand("predicted", "Draw predicted against simulated");
  for (CLI::App* command : {run, held_out, expected, summary, growth, predicted}) add_common(*command, options);
  for (CLI::App* command : {run, held_out, expected, predicted}) add_learning(*command, options);
  for (CLI::App* command : {run, expected})
    command->add_option("--algorithm", options.search.algorithm)->check(CLI::IsMember(nacre::explore::algorithms()));
  run->add_option("--budget", options.search.budget)->capture_default_str();
  run->add_option("--population", options.search.population)->capture_default_str();
  run->add_option("--batch", options.search.batch)->capture_default_str();
  run->add_option("--known", options.known, "gamut.csv of the same parameters and fidelity to start from")
      ->check(CLI::ExistingFile);
  run->add_option("--minutes", options.minutes, "stop after this time; run again to go on");
  for (CLI::App* command : {held_out, predicted}) {
    command->add_option("--checkpoints", options.checkpoints, "samples learnt from; a picture takes the first")
        ->capture_default_str();
    command->add_option("--next", options.next, "samples predicted")->capture_default_str();
  }
  expected->add_option("--checkpoints", options.checkpoints, "fracture tests after which fronts are taken")
      ->capture_default_str();
  expected->add_option("--again", options.again, "specimens of each of a front's designs")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  for (CLI::App* command : {run, expected}) command->add_option("--threads", options.threads, "0: all allowed cores");
  growth->add_option("--variants", options.variants, "curves")->capture_default_str();
  growth->add_option("--most", options.most, "samples where the picture ends")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  growth->add_option("--out", options.out, "the picture")->required();
  predicted->add_option("--out", options.out, "begin of the pictures' names")->required();
  summary->add_option("--reference", options.reference, "variant whose final hypervolume is the goal")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (options.variant.empty()) options.variant = options.search.algorithm;
  bool finished = true;
  const int status = nacre::study::exit_status_of([&] {
    if (!options.known.empty()) options.search.known = nacre::explore::read_gamut_csv(options.known);
    if (!options.former.empty()) options.search.former = nacre::explore::read_gamut_csv(options.former);
    if (*run) finished = run_searches(options);
    if (*held_out) predict_held_out(options);
    if (*expected) expect_fronts(options);
    if (*summary) summarise(options);
    if (*growth) draw_growth(options);
    if (*predicted) draw_predicted(options);
  });
  if (!finished) fmt::print("time is up; run the same command again\n");
  return status != 0 ? status : finished ? 0 : 1;
}
