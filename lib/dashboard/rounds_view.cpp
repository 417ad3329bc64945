#include "dashboard/rounds_view.hpp"

#include "run/adopted_model.hpp"
#include "run/measured_patterns.hpp"

namespace nacre::dashboard {
namespace {

Json point_json(const optimize::Performance& point) { return {point.modulus_pa, point.toughness_pa}; }

Json points_json(const std::vector<optimize::Performance>& points) {
  Json array = Json::array();
  for (const auto& point : points) array.push_back(point_json(point));
  return array;
}

Json summary_json(const wire::RoundSummary& s) {
  return {{"fidelity", tester::to_string(s.fidelity)},
          {"calibration_count", s.calibration_count},
          {"measured_hypervolume", s.measured_hypervolume_staircase},
          {"measured_hypervolume_polygon", s.measured_hypervolume_polygon},
          {"gamut_hypervolume", s.gamut_hypervolume_staircase},
          {"gamut_hypervolume_polygon", s.gamut_hypervolume_polygon},
          {"hypervolume_error", s.hypervolume_error},
          {"gap", s.gap},
          {"signed_gap", s.signed_gap},
          {"before", errors_json(s.before)},
          {"after", errors_json(s.after)},
          {"held_out", errors_json(s.held_out)},
          {"equilibrium", s.equilibrium},
          {"last", s.last},
          {"decided_by", s.decided_by}};
}

Json proposal_json(const wire::ProposedDesign& proposal) {
  return {{"design", proposal.design.name()},
          {"modulus_pa", proposal.modulus_pa},
          {"toughness_pa", proposal.toughness_pa},
          {"reason", proposal.reason}};
}

std::vector<optimize::Performance> means(const std::vector<run::MeasuredPattern>& patterns) {
  std::vector<optimize::Performance> points;
  for (const auto& each : patterns) points.push_back(each.mean);
  return points;
}

Json measured_json(const run::MeasuredPattern& m) {
  return {{"design", m.pattern.key()},
          {"round", m.round},
          {"rigid_fraction", m.pattern.rigid_fraction()},
          {"modulus_pa", m.mean.modulus_pa},
          {"modulus_sd_pa", m.modulus_sd_pa},
          {"modulus_count", m.modulus_count},
          {"toughness_pa", m.mean.toughness_pa},
          {"toughness_sd_pa", m.toughness_sd_pa},
          {"toughness_count", m.toughness_count}};
}

}  // namespace

Json rounds_json(const run::RunRecord& run) {
  Json rounds = Json::array();
  for (const auto& [number, round] : run.rounds) {
    Json proposals = Json::array(), parameters = Json::object();
    for (const auto& proposal : round.proposals) proposals.push_back(proposal_json(proposal));
    if (round.model)
      for (const auto& [name, value] : run::named_parameters(round.model->parameters)) parameters[name] = value;
    rounds.push_back(
        {{"round", number},
         {"summary", round.summary ? summary_json(*round.summary) : Json(nullptr)},
         {"gamut_count", round.gamut_count},
         {"measured_front", points_json(optimize::pareto_front(means(run::measured_patterns(run, number))))},
         {"benchmark", points_json(run::line_as_measured(round))},
         {"proposals", proposals},
         {"parameters", parameters},
         {"verdict", round.diagnosis ? Json(round.diagnosis->verdict) : Json(nullptr)}});
  }
  Json measured = Json::array();
  for (const auto& pattern : run::measured_patterns(run, run::newest_round(run).value_or(0)))
    measured.push_back(measured_json(pattern));
  return {{"rounds", rounds}, {"measured", measured}};
}

}  // namespace nacre::dashboard
