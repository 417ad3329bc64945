#include "dashboard/diagnosis_view.hpp"

#include "material/extensions.hpp"
#include "run/misfit.hpp"

namespace nacre::dashboard {
namespace {

/// Adds family and explanation of an effect.
void explain(Json& effect, const std::string& name) {
  const material::Effect* known = material::find_effect(name);
  if (known == nullptr) return;
  effect["family"] = known->family;
  effect["explanation"] = known->explanation;
}

Json of_message(const diagnosis_t& d) {
  Json effects = Json::array(), candidates = Json::array();
  for (const effect_t& e : run::named_effects(d)) {
    effects.push_back({{"name", e.name},
                       {"parameter", e.parameter},
                       {"interval90", {e.interval_low, e.interval_high}},
                       {"unit", e.unit}});
    explain(effects.back(), e.name);
  }
  for (const candidate_t& c : d.candidates) {
    candidates.push_back({{"name", c.name},
                          {"status", c.status},
                          {"statistic", c.statistic},
                          {"p_family_wise", c.p_family_wise},
                          {"absorption", c.absorption}});
    explain(candidates.back(), c.name);
  }
  Json gain = nullptr;
  if (d.has_gain)
    gain = {{"held_out_error_before", d.held_out_error_before},
            {"held_out_error_after", d.held_out_error_after},
            {"relative_reduction", d.relative_reduction},
            {"interval90", {d.reduction_low, d.reduction_high}}};
  return {
      {"verdict", d.verdict}, {"summary", d.summary}, {"effects", effects}, {"candidates", candidates}, {"gain", gain}};
}

Json next_experiments(const diagnosis_t& message) {
  Json experiments = Json::array();
  for (const next_experiment_t& e : message.next_experiments) {
    const auto test = wire::test_kind_from_wire(e.test);
    experiments.push_back({{"design", e.design},
                           {"test", test ? tester::to_string(*test) : "?"},
                           {"orientation_deg", e.conditions.orientation_deg},
                           {"strain_rate_per_s", e.conditions.strain_rate_per_s},
                           {"thickness_mm", e.conditions.thickness_mm},
                           {"replicates", e.replicates},
                           {"loading", e.loading},
                           {"reason", e.reason}});
  }
  return experiments;
}

}  // namespace

Json diagnosis_json(const run::RunRecord& run, int round) {
  const auto found = run.rounds.find(round);
  if (found == run.rounds.end() || !found->second.diagnosis) return nullptr;
  const diagnosis_t& diagnosis = *found->second.diagnosis;
  Json json = of_message(diagnosis);
  json["round"] = round;
  json["against"] = run::misfit_beside_verdict(found->second);
  json["next_experiments"] = next_experiments(diagnosis);
  return json;
}

}  // namespace nacre::dashboard
