#include "dashboard/design_view.hpp"

#include "game/standings.hpp"
#include "measurement/conditions.hpp"
#include "pattern/constraints.hpp"

namespace nacre::dashboard {
namespace {

Json specimen_json(const run::MeasuredSpecimen& specimen) {
  const measurement::SpecimenRecord& r = specimen.record;
  return {{"specimen", r.specimen},
          {"round", specimen.round},
          {"test", tester::to_string(r.test)},
          {"orientation_deg", r.conditions.orientation_deg},
          {"standard", measurement::is_standard(r.conditions)},
          {"batch", r.batch},
          {"modulus_pa", json_or_null(r.modulus_pa ? r.modulus_pa : measurement::modulus_of(r))},
          {"toughness_pa", json_or_null(r.toughness_pa ? r.toughness_pa : measurement::toughness_of(r))},
          {"valid", r.valid},
          {"note", r.note},
          {"curve", curve_json(r.curve)}};
}

Json crack_json(const wire::Fracture& recorded) {
  const crack::CrackRecord& c = recorded.crack;
  Json json = {{"film", !recorded.film.empty()},
               {"broken", recorded.broken},
               {"branches", c.branches},
               {"separate_cracks", c.separate_cracks}};
  if (!c.path) return json;
  json["path_ratio"] = c.path->ratio();
  json["bridged_share"] = c.path->bridged_share;
  json["soft_share"] = c.path->material[0];
  json["rigid_share"] = c.path->material[1];
  json["interface_share"] = c.path->material[2];
  json["crosses"] = c.path->crosses;
  return json;
}

Json simulated_json(int round, const wire::SimulatedDesign& s) {
  Json json = {{"round", round}};
  if (!s.failure.empty()) return json["failure"] = s.failure, json;
  // 0: that test was not asked for.
  json["modulus_pa"] = s.modulus_pa > 0.0 ? Json(s.modulus_pa) : Json(nullptr);
  json["toughness_pa"] = s.toughness_pa;
  json["curve"] = curve_json(s.curve);
  return json;
}

}  // namespace

Json design_json(const run::RunRecord& run, const pattern::Design& design) {
  const std::string name = design.name();
  Json proposals = Json::array(), simulated = Json::array(), cracks = Json::array(), specimens = Json::array();
  for (const auto& [number, round] : run.rounds) {
    for (const auto& p : round.proposals) {
      if (p.design == design)
        proposals.push_back(
            {{"round", number}, {"modulus_pa", p.modulus_pa}, {"toughness_pa", p.toughness_pa}, {"reason", p.reason}});
    }
    if (const auto found = round.simulated.find(name); found != round.simulated.end())
      simulated.push_back(simulated_json(number, found->second));
    if (const auto found = round.cracks.find(name); found != round.cracks.end()) {
      cracks.push_back(crack_json(found->second));
      cracks.back()["round"] = number;
    }
  }
  for (const auto& specimen : run.specimens) {
    if (specimen.record.design == design) specimens.push_back(specimen_json(specimen));
  }
  Json json = {{"design", name},         {"rigid_fraction", design.rigid_fraction()},
               {"proposals", proposals}, {"simulated", simulated},
               {"cracks", cracks},       {"specimens", specimens}};
  if (const auto symmetric = game::eightfold_pattern(design))
    json["violation"] = json_or_null(pattern::violation(*symmetric));
  return json;
}

}  // namespace nacre::dashboard
