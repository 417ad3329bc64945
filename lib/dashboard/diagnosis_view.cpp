#include "dashboard/diagnosis_view.hpp"

#include "material/extensions.hpp"
#include "store/misfit.hpp"

namespace nacre::dashboard {
namespace {

/// Adds family and explanation of an effect.
void explain(Json& effect, const std::string& name) {
  const material::Effect* known = material::find_effect(name);
  if (known == nullptr) return;
  effect["family"] = known->family;
  effect["explanation"] = known->explanation;
}

Json of_database(const store::RecordedDiagnosis& d) {
  Json effects = Json::array(), candidates = Json::array();
  for (const auto& e : d.effects) {
    effects.push_back({{"name", e.name},
                       {"parameter", e.parameter},
                       {"interval90", {e.interval_low, e.interval_high}},
                       {"unit", e.unit}});
    explain(effects.back(), e.name);
  }
  for (const auto& c : d.candidates) {
    candidates.push_back({{"name", c.name},
                          {"status", c.status},
                          {"statistic", c.statistic},
                          {"p_family_wise", c.p_family_wise},
                          {"absorption", c.absorption}});
    explain(candidates.back(), c.name);
  }
  Json gain = nullptr;
  if (d.held_out_error_before && d.held_out_error_after)
    gain = {{"held_out_error_before", *d.held_out_error_before}, {"held_out_error_after", *d.held_out_error_after}};
  return {
      {"verdict", d.verdict}, {"summary", d.summary}, {"effects", effects}, {"candidates", candidates}, {"gain", gain}};
}

Json next_experiments(const wire::Diagnosis& message) {
  Json experiments = Json::array();
  for (const wire::NextExperiment& e : message.next_experiments) {
    experiments.push_back({{"design", e.design.name()},
                           {"test", tester::to_string(e.test)},
                           {"orientation_deg", e.conditions.orientation_deg},
                           {"strain_rate_per_s", e.conditions.strain_rate_per_s},
                           {"thickness_mm", e.conditions.thickness_mm},
                           {"replicates", e.replicates},
                           {"loading", tester::to_string(e.loading)},
                           {"reason", e.reason}});
  }
  return experiments;
}

}  // namespace

Json diagnosis_json(const store::RunRecord& run, const std::optional<wire::Diagnosis>& message, int round) {
  const auto found = run.rounds.find(round);
  if (found == run.rounds.end() || !found->second.diagnosis) return nullptr;
  Json json = of_database(*found->second.diagnosis);
  json["round"] = round;
  json["against"] = store::misfit_beside_verdict(found->second);
  json["next_experiments"] = message ? next_experiments(*message) : Json::array();
  if (message && message->gain && json["gain"].is_object()) {
    json["gain"]["relative_reduction"] = message->gain->relative_reduction;
    json["gain"]["interval90"] = {message->gain->reduction_low, message->gain->reduction_high};
  }
  return json;
}

}  // namespace nacre::dashboard
