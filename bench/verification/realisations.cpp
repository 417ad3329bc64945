// Error of log T of proposed designs when T is a mean over perturbed parameters: the proposals of played games are
// simulated again and compared with what was measured of them afterwards. Results: docs/decisions/0014.

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "fracture_row.hpp"
#include "game/model.hpp"
#include "game/standings.hpp"
#include "played_game.hpp"
#include "study/study_command.hpp"
#include "study/study_table.hpp"

namespace {

using namespace nacre;
using namespace nacre::verification;

constexpr double kRelative[] = {0.01, 0.05, 0.1, 0.2, 0.3, 0.4};

struct Options {
  std::vector<std::string> runs;
  int draws = 12;
  study::TableOptions table{.table = "realisations.csv"};
};

/// A design of a proposal that was measured afterwards.
struct MeasuredProposal {
  std::string place;  ///< run and round
  pattern::Design design;
  tester::Fidelity fidelity = tester::Fidelity::full;
  material::ParameterSet parameters;
  double measured_log_toughness = 0.0;
};

/// Without round 0, whose model of fracture rests on the base materials alone.
std::vector<MeasuredProposal> measured_proposals(const std::string& run) {
  const PlayedGame game = read_game(run);
  const std::vector<measurement::Replicates> measured = game::calibration_set(game.specimens);
  std::vector<MeasuredProposal> all;
  for (const auto& [round, proposal] : game.proposals) {
    if (round == 0) continue;
    const wire::AdoptedModel& model = game.models.at(round);
    for (const wire::ProposedDesign& each : proposal.designs) {
      const auto of = std::find_if(measured.begin(), measured.end(),
                                   [&](const measurement::Replicates& one) { return one.design == each.design; });
      if (of == measured.end() || of->toughness_count == 0) continue;
      all.push_back({fmt::format("{}/{}", std::filesystem::path(run).filename().string(), round), each.design,
                     model.fidelity, game::material_side(model.parameters), std::log(of->toughness_pa)});
    }
  }
  return all;
}

std::string key_of(const MeasuredProposal& proposed, double relative, int draw) {
  return fmt::format("{} {} {:g} {}", proposed.place, proposed.design.name(), relative, draw);
}

std::vector<study::Wanted> wanted_rows(const Options& options, const std::vector<MeasuredProposal>& designs) {
  std::vector<study::Wanted> wanted;
  const auto want = [&](const MeasuredProposal& proposed, double relative, int draw) {
    const std::string key = key_of(proposed, relative, draw);
    wanted.push_back(
        {key, [=, seed = options.table.seed] {
           RandomStream random(seed, fmt::format("redraw {}", draw));
           material::ParameterSet parameters = proposed.parameters;
           parameters.toughness = material::perturbed(parameters.toughness, relative, random);
           return fracture_row(key, tester::test_toughness({proposed.design, parameters, {}, proposed.fidelity}));
         }});
  };
  for (const MeasuredProposal& proposed : designs) {
    want(proposed, 0.0, 0);
    for (const double relative : kRelative)
      for (int draw = 0; draw < options.draws; ++draw) want(proposed, relative, draw);
  }
  return wanted;
}

/// Errors of log T as the mean of the model's own simulation and `draws` perturbed ones, one error a group of draws.
std::vector<double> errors_of(const Options& options, const std::vector<MeasuredProposal>& designs,
                              const study::StudyTable& table, double relative, int draws) {
  std::vector<double> errors;
  for (const MeasuredProposal& proposed : designs) {
    const auto log_toughness = [&](double perturbation, int draw) -> std::optional<double> {
      const auto row = table.find(key_of(proposed, perturbation, draw));
      if (!row || (*row)[0] <= 0.0) return std::nullopt;
      return std::log((*row)[0]);
    };
    const auto own = log_toughness(0.0, 0);
    if (!own) continue;
    for (int first = 0; first + draws <= options.draws; first += std::max(1, draws)) {
      std::vector<double> logs = {*own};
      for (int draw = first; draw < first + draws; ++draw) {
        if (const auto value = log_toughness(relative, draw)) logs.push_back(*value);
      }
      errors.push_back(mean(logs) - proposed.measured_log_toughness);
      if (draws == 0) break;
    }
  }
  return errors;
}

void print_row(const std::string& head, const std::vector<double>& errors) {
  if (errors.empty()) return;
  fmt::print("| {} | {:.3f} | {:+.3f} |\n", head, root_mean_square(errors), mean(errors));
}

void run(const Options& options) {
  std::vector<MeasuredProposal> designs;
  for (const std::string& folder : options.runs) {
    const std::vector<MeasuredProposal> of_run = measured_proposals(folder);
    designs.insert(designs.end(), of_run.begin(), of_run.end());
  }
  study::StudyTable table(options.table.table, kFractureColumns);
  const int missing = study::fill(table, wanted_rows(options, designs), options.table.seconds, options.table.threads);
  fmt::print("{} proposed and measured designs of {} games\n\n", designs.size(), options.runs.size());
  fmt::print("| T is | error of log T (rms) | (mean) |\n| --- | --- | --- |\n");
  print_row("one simulation", errors_of(options, designs, table, 0.0, 0));
  for (const double relative : kRelative) {
    for (const int draws : {1, 3, 6, options.draws}) {
      print_row(fmt::format("mean of it and {} perturbed by {:g}", draws, relative),
                errors_of(options, designs, table, relative, draws));
    }
  }
  if (missing > 0) fmt::print("\n{} simulations are still missing: run it again\n", missing);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Proposed designs, simulated again with perturbed parameters, against what was measured of them"};
  Options options;
  app.add_option("RUN", options.runs, "folders of played games")->required()->check(CLI::ExistingDirectory);
  app.add_option("--draws", options.draws, "perturbed simulations of a design and size")->check(CLI::Range(6, 100));
  study::add_table_options(app, options.table, "draws");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
