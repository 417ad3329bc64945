#include "report/paper_source.hpp"

#include <algorithm>
#include <cmath>

#include "base/named_table.hpp"
#include "base/names.hpp"
#include "families/families_file.hpp"
#include "game/model.hpp"
#include "game/reference_tables.hpp"
#include "game/standings.hpp"
#include "pattern/pattern_key.hpp"
#include "report/report_data.hpp"
#include "run/journal_messages.hpp"
#include "run/run.hpp"
#include "sysid/objective.hpp"

namespace nacre::report {
namespace {

namespace fs = std::filesystem;

/// The requests of a node to the simulator farm, in order, and the responses.
struct FarmTraffic {
  std::vector<wire::SimulateRequest> requests;
  std::map<std::string, std::vector<wire::SimulatedDesign>> responses;  ///< whole ones, by request
};

FarmTraffic farm_traffic(const fs::path& run_dir, const std::string& node) {
  FarmTraffic traffic;
  wire::ResponseCollector collector;
  const auto take_request = [&](const std::string& payload) {
    if (auto request = wire::read<wire::SimulateRequest>(payload)) traffic.requests.push_back(std::move(*request));
  };
  const auto take_response = [&](const std::string& payload) {
    auto part = wire::read<wire::SimulateResult>(payload);
    if (!part) return;
    const std::string id = part->request_id;
    if (auto whole = collector.add(std::move(*part))) traffic.responses.emplace(id, std::move(*whole));
  };
  run::JournalMessages(run_dir, node).read({{"SIMULATED", take_response}}, {{"SIMULATE", take_request}});
  return traffic;
}

std::vector<SearchPath> searches_of(const FarmTraffic& traffic) {
  std::map<std::pair<int, int>, SearchPath> paths;
  for (const wire::SimulateRequest& request : traffic.requests) {
    const auto round = number_between("proposal_agent/r", "/s", request.request_id);
    const auto branch =
        round ? number_between(fmt::format("proposal_agent/r{}/s", *round), "/", request.request_id) : std::nullopt;
    if (!branch) continue;
    const auto response = traffic.responses.find(request.request_id);
    if (response == traffic.responses.end()) continue;
    SearchPath& path = paths[{*round, *branch}];
    path.round = *round;
    path.branch = *branch;
    for (const wire::SimulatedDesign& design : response->second)
      if (design.failure.empty()) path.samples.push_back({design.modulus_pa, design.toughness_pa});
  }
  std::vector<SearchPath> all;
  for (auto& [place, path] : paths) all.push_back(std::move(path));
  return all;
}

/// A simulated design as the testing machine would record it.
game::DesignValues as_measured(const optimize::Performance& simulated, const tester::Curve& curve,
                               const material::Extensions& extensions) {
  const sysid::Prediction recorded = sysid::observed(
      {.modulus_pa = simulated.modulus_pa, .toughness_pa = simulated.toughness_pa, .curve = curve}, extensions);
  return {recorded.modulus_pa, recorded.toughness_pa};
}

/// Whether two sets of eta are the same to a test of this design: of a pure material only its own constants count.
bool same_toughness_model(const pattern::Design& design, const material::ToughnessParameters& a,
                          const material::ToughnessParameters& b) {
  const std::string name = design.name();
  if (a.gamma_per_s != b.gamma_per_s) return false;
  if (name == "soft") return a.e_tb_pa == b.e_tb_pa && a.nu_tb == b.nu_tb && a.w_tb_j_per_m3 == b.w_tb_j_per_m3;
  if (name == "rigid") return a.e_vw_pa == b.e_vw_pa && a.nu_vw == b.nu_vw && a.w_vw_j_per_m3 == b.w_vw_j_per_m3;
  if (name == "interface") return a.e_if_pa == b.e_if_pa && a.nu_if == b.nu_if && a.w_if_j_per_m3 == b.w_if_j_per_m3;
  return a == b;
}

/// What adopted models predict for designs under standard conditions, as far as the validation agent requested it.
ModelPredictions predictions_in(const FarmTraffic& traffic, const std::map<int, material::ParameterSet>& models) {
  ModelPredictions predictions;
  for (const wire::SimulateRequest& request : traffic.requests) {
    const auto response = traffic.responses.find(request.request_id);
    if (response == traffic.responses.end() || request.conditions != tester::TestConditions{}) continue;
    for (const auto& [round, model] : models) {
      const material::ParameterSet own = game::material_side(model);
      if (own.extensions != request.parameters.extensions) continue;
      const bool modulus = request.modulus && own.modulus == request.parameters.modulus;
      for (const wire::SimulatedDesign& design : response->second) {
        const bool toughness =
            request.toughness && same_toughness_model(design.design, own.toughness, request.parameters.toughness);
        if (!design.failure.empty() || (!modulus && !toughness)) continue;
        game::DesignValues& values = predictions[round][design.design.name()];
        const game::DesignValues recorded =
            as_measured({design.modulus_pa, design.toughness_pa}, design.curve, model.extensions);
        if (modulus) values.modulus_pa = recorded.modulus_pa;
        if (toughness) values.toughness_pa = recorded.toughness_pa;
      }
    }
  }
  return predictions;
}

/// The analyser's own requests: what each round's model predicts for everything measured by then, and for its
/// proposals.
void add_recorded(const run::RunRecord& run, ModelPredictions& predictions) {
  std::map<std::string, const wire::SimulatedDesign*> by_model;
  for (const auto& [number, round] : run.rounds) {
    if (!round.repeats_model) by_model.clear();
    for (const auto& [design, simulation] : round.simulated) by_model[design] = &simulation;
    const material::Extensions extensions = extensions_of(round);
    const auto add = [&, &known = predictions[number]](const std::string& design,
                                                       const optimize::Performance& simulated,
                                                       const tester::Curve& curve) {
      const game::DesignValues recorded = as_measured(simulated, curve, extensions);
      game::DesignValues& values = known[design];
      if (!values.modulus_pa) values.modulus_pa = recorded.modulus_pa;
      if (!values.toughness_pa) values.toughness_pa = recorded.toughness_pa;
    };
    for (const auto& [design, simulation] : by_model)
      if (simulation->failure.empty())
        add(design, {simulation->modulus_pa, simulation->toughness_pa}, simulation->curve);
    for (const wire::ProposedDesign& proposal : round.proposals) add(proposal.design.name(), predicted(proposal), {});
  }
}

std::map<int, material::ParameterSet> adopted_models(const run::RunRecord& run) {
  std::map<int, material::ParameterSet> models;
  for (const auto& [number, round] : run.rounds)
    if (round.model) models[number] = round.model->parameters;
  return models;
}

/// The families: of the stage; of the file that a person may have edited; else proposed from what was measured.
void find_groups(const fs::path& run_dir, PaperSource& source) {
  for (const run::FamilyRecord& family : source.run.families) {
    families::SeedFamily& group = source.groups.emplace_back();
    group.name = family.stated.name;
    for (const game::FamilyDesign& design : family.stated.designs)
      if (design.is_seed) group.seeds.push_back(design.pattern);
  }
  source.groups_from = "the families of the stage after the game";
  if (!source.groups.empty()) return;
  const fs::path file = run_dir / "families" / "families.toml";
  if (fs::exists(file)) {
    source.groups = families::read_families(file);
    source.groups_from = "the families of families/families.toml";
    return;
  }
  std::vector<families::MeasuredPattern> measured;
  for (const MeasuredPattern& each : measured_patterns(source.run, newest_round(source.run).value_or(0)))
    measured.push_back({each.pattern, each.mean});
  source.groups = families::proposed_families(families::near_pareto(measured));
  source.groups_from = "the families that nacre proposes for the measured patterns";
}

pattern::Pattern pattern_in(const NamedTable& table, std::size_t row) {
  const auto known = pattern::pattern_from_key(table.text(row, "pattern"));
  if (!known) table.fail_at(row, "pattern", "expected the key of a pattern");
  return *known;
}

std::optional<double> number_in(const NamedTable& table, std::size_t row, const std::string& column) {
  if (!table.has(column) || trimmed(table.text(row, column)).empty()) return std::nullopt;
  const auto value = number_from_text(table.text(row, column));
  if (!value) table.fail_at(row, column, "expected a number, found '" + table.text(row, column) + "'");
  return *value;
}

SubfamilyMap read_map(const fs::path& file, const std::string& family) {
  SubfamilyMap map{.family = family, .seed = file.stem().string(), .points = {}};
  const NamedTable table(file, {"pattern", "source", "x", "y"});
  for (std::size_t row = 0; row < table.size(); ++row) {
    MapPoint& point = map.points.emplace_back();
    point.pattern = pattern_in(table, row);
    point.source = table.text(row, "source");
    point.x = number_in(table, row, "x").value_or(0.0);
    point.y = number_in(table, row, "y").value_or(0.0);
    point.x_sampled = number_in(table, row, "x_sampled");
    point.y_sampled = number_in(table, row, "y_sampled");
    const auto modulus = number_in(table, row, "modulus_pa"), toughness = number_in(table, row, "toughness_pa");
    if (modulus && toughness) point.performance = {*modulus, *toughness};
  }
  return map;
}

void read_maps(const fs::path& run_dir, PaperSource& source) {
  for (const families::SeedFamily& group : source.groups) {
    for (const pattern::Pattern& seed : group.seeds) {
      const fs::path file = run_dir / "families" / group.name / (seed.key() + ".csv");
      if (fs::exists(file)) source.maps.push_back(read_map(file, group.name));
    }
  }
}

}  // namespace

std::optional<double> error_of(const std::optional<double>& simulated, const std::optional<double>& measured) {
  return simulated && measured ? std::optional(std::abs(*simulated - *measured) / *measured) : std::nullopt;
}

PaperSource read_paper_source(const fs::path& run_dir, const std::string& run_id, const fs::path& thesis_folder) {
  PaperSource source;
  source.run_id = run_id;
  source.run = run::Run(run_dir).record_with_gamuts();
  if (const fs::path file = run_dir / "inputs" / "base_materials.csv"; fs::exists(file))
    source.base_materials = game::read_base_materials(file);
  if (!thesis_folder.empty()) source.thesis = game::read_thesis_tables(thesis_folder);
  source.searches = searches_of(farm_traffic(run_dir, "proposal_agent"));
  source.predictions = predictions_in(farm_traffic(run_dir, "validation_agent"), adopted_models(source.run));
  add_recorded(source.run, source.predictions);
  find_groups(run_dir, source);
  read_maps(run_dir, source);
  return source;
}

}  // namespace nacre::report
