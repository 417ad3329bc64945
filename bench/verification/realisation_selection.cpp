// Proposals with T as a mean over realisations against proposals with T of one simulation, from the same gamut of the
// same model, and what the game's virtual laboratory would measure of both. Reads games that were played without
// realisations. Results: docs/decisions/0014.

#include <cmath>
#include <map>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/statistics.hpp"
#include "fracture_row.hpp"
#include "game/model.hpp"
#include "laboratory/laboratory.hpp"
#include "laboratory/laboratory_file.hpp"
#include "optimize/pareto.hpp"
#include "played_game.hpp"
#include "proposal_agent/realisations.hpp"
#include "select/select.hpp"
#include "study/study_command.hpp"
#include "study/study_table.hpp"

namespace {

using namespace nacre;
using namespace nacre::verification;
namespace lab = nacre::laboratory;

struct Options {
  std::vector<std::string> runs;
  int draws = 3, designs = 8, first_round = 1;
  study::TableOptions table{.table = "realisation_selection.csv"};
};

/// A round of a game: its model, its gamut, and the laboratory that would measure.
struct StudiedRound {
  std::string place;
  const wire::AdoptedModel* model = nullptr;
  const std::vector<explore::Evaluated>* gamut = nullptr;
  const lab::Truth* truth = nullptr;
};

class SelectionStudy {
 public:
  explicit SelectionStudy(const Options& options) : options_(options), table_(options.table.table, kFractureColumns) {}

  /// The gamut with the toughness of its candidates as means over realisations.
  std::vector<explore::Evaluated> averaged_gamut(const StudiedRound& round) {
    wire::SimulateRequest model;
    model.fidelity = round.model->fidelity;
    model.parameters = game::material_side(round.model->parameters);
    proposal_agent::Realisations realisations(*round.gamut, round.model->measured, options_.draws, options_.table.seed,
                                              round.place);
    for (auto requests = realisations.next(model); !requests.empty(); requests = realisations.next(model)) {
      simulate(requests);
      for (const wire::SimulateRequest& request : requests) realisations.take(request.request_id, response(request));
    }
    return realisations.gamut();
  }

  /// E and T of a design in the laboratory, without scatter.
  optimize::Performance measured(const StudiedRound& round, const pattern::Pattern& pattern) {
    const std::string key = fmt::format("{} laboratory {}", round.place, pattern.key());
    if (!table_.find(key)) {
      const auto of = [&](tester::TestKind test) {
        return lab::respond(*round.truth, {pattern, test, {}, round.model->fidelity, {}}).value();
      };
      table_.add(key, {tester::area_under(of(tester::TestKind::toughness).curve),
                       of(tester::TestKind::modulus).modulus_pa, 0.0});
    }
    const std::vector<double> row = *table_.find(key);
    return {row[1], row[0]};
  }

 private:
  static std::string key_of(const wire::SimulateRequest& request, const pattern::Design& design) {
    return request.request_id + " " + design.name();
  }
  void simulate(const std::vector<wire::SimulateRequest>& requests) {
    std::vector<study::Wanted> wanted;
    for (const wire::SimulateRequest& request : requests) {
      for (const pattern::Design& design : request.designs) {
        const std::string key = key_of(request, design);
        wanted.push_back(
            {key, [=, &request] {
               return fracture_row(key, tester::test_toughness({design, request.parameters, {}, request.fidelity}));
             }});
      }
    }
    study::fill(table_, wanted, options_.table.seconds, options_.table.threads);
  }
  std::vector<wire::SimulatedDesign> response(const wire::SimulateRequest& request) const {
    std::vector<wire::SimulatedDesign> results;
    for (const pattern::Design& design : request.designs) {
      wire::SimulatedDesign result;
      result.design = design;
      result.toughness_pa = table_.find(key_of(request, design)).value()[0];
      if (result.toughness_pa <= 0.0) result.failure = "no result";
      results.push_back(result);
    }
    return results;
  }

  Options options_;
  study::StudyTable table_;
};

/// Of all designs that one way of choosing proposed.
struct Outcome {
  std::vector<double> errors;        ///< of log T
  std::vector<double> hypervolumes;  ///< of each round's designs, as measured
};

void add_proposals(Outcome& outcome, SelectionStudy& study, const StudiedRound& round,
                   std::vector<explore::Evaluated> gamut, int designs) {
  std::vector<optimize::Performance> measured;
  for (const select::Selected& each :
       select::select_with_reserve(std::move(gamut), round.model->measured, round.model->benchmark, designs)) {
    measured.push_back(study.measured(round, each.pattern));
    outcome.errors.push_back(std::log(each.predicted.toughness_pa / measured.back().toughness_pa));
  }
  outcome.hypervolumes.push_back(optimize::hypervolume_staircase_gpa_mpa(measured));
}

void print_row(const std::string& head, const Outcome& outcome) {
  std::vector<double> relative;
  for (const double error : outcome.errors) relative.push_back(std::abs(std::expm1(error)));
  fmt::print("| {} | {} | {:.3f} | {:+.3f} | {:.1f} % | {:.3f} |\n", head, outcome.errors.size(),
             root_mean_square(outcome.errors), mean(outcome.errors), 100.0 * mean(relative),
             mean(outcome.hypervolumes));
}

void run(const Options& options) {
  SelectionStudy study(options);
  Outcome one, means;
  for (const std::string& folder : options.runs) {
    const PlayedGame game = read_game(folder);
    const lab::Truth truth = lab::read_laboratory(std::filesystem::path(folder) / "laboratory.truth.toml");
    for (const auto& [number, gamut] : game.gamuts) {
      if (number < options.first_round) continue;
      const StudiedRound round{fmt::format("{}/{}", std::filesystem::path(folder).filename().string(), number),
                               &game.models.at(number), &gamut, &truth};
      add_proposals(one, study, round, gamut, options.designs);
      add_proposals(means, study, round, study.averaged_gamut(round), options.designs);
      fmt::print(stderr, "{}: hypervolume of what is proposed {:.3f} by one simulation, {:.3f} by means\n", round.place,
                 one.hypervolumes.back(), means.hypervolumes.back());
    }
  }
  fmt::print(
      "| T of candidates | designs | error of log T (rms) | (mean) | mean error | hypervolume of a proposal |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  print_row("one simulation", one);
  print_row(fmt::format("mean of it and {} realisations", options.draws), means);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Proposals of games with and without realisations, and what their laboratories would measure of them"};
  Options options;
  app.add_option("RUN", options.runs, "folders of games played with redraws = 0")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--draws", options.draws, "realisations of a candidate")->check(CLI::Range(1, 100));
  app.add_option("--designs", options.designs, "designs of a proposal")->check(CLI::Range(1, 100));
  app.add_option("--first-round", options.first_round, "rounds before it are left out")->check(CLI::Range(0, 1000));
  study::add_table_options(app, options.table, "draws");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
