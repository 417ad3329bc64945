#include "runtime/farm_requests.hpp"

#include <fmt/format.h>

#include <tuple>

#include "game/model.hpp"

namespace nacre::runtime {
namespace {

using ConditionsKey = std::tuple<double, double, double>;

ConditionsKey key_of(const tester::TestConditions& conditions) {
  return {conditions.orientation_deg, conditions.strain_rate_per_s, conditions.thickness_mm};
}

sysid::Prediction prediction_of(const wire::SimulatedDesign& result, bool modulus, bool toughness) {
  sysid::Prediction prediction;
  if (!result.failure.empty()) return prediction;
  if (modulus) prediction.modulus_pa = result.modulus_pa;
  if (toughness) {
    prediction.toughness_pa = result.toughness_pa;
    prediction.toughness_sd_pa = result.toughness_sd_pa;
    prediction.specimens = result.specimens;
    prediction.curve = result.curve;
  }
  return prediction;
}

}  // namespace

std::vector<wire::SimulateRequest> FarmRequests::ask(const FarmBatch& batch) {
  const std::vector<measurement::Replicates>& measured = batch.measured;
  open_.clear();
  predictions_.clear();
  std::vector<wire::SimulateRequest> requests;
  for (std::size_t evaluation = 0; evaluation < batch.wanted.size(); ++evaluation) {
    const sysid::WantedEvaluation& each = batch.wanted[evaluation];
    predictions_.emplace_back(each.items.size());
    std::map<ConditionsKey, std::vector<std::size_t>> by_conditions;
    for (std::size_t item = 0; item < each.items.size(); ++item) {
      by_conditions[key_of(measured[each.items[item]].conditions)].push_back(item);
    }
    int part = 0;
    for (const auto& [conditions, items] : by_conditions) {
      for (std::size_t first = 0; first < items.size(); first += wire::kMaximumDesigns) {
        wire::SimulateRequest request;
        request.request_id = fmt::format("{}/{}/{}/{}", batch.requester, batch.label, each.id, part++);
        request.modulus = each.modulus;
        request.toughness = each.toughness;
        request.fidelity = batch.fidelity;
        request.conditions = measured[each.items[items[first]]].conditions;
        request.parameters = game::material_side(each.parameters);
        request.first_specimen = each.first_specimen;
        request.specimens = each.specimens;
        request.curve_points = each.toughness ? batch.curve_points : 0;
        Place place{evaluation, {}, each.modulus, each.toughness};
        for (std::size_t index = first; index < std::min(first + wire::kMaximumDesigns, items.size()); ++index) {
          place.items.push_back(items[index]);
          request.designs.push_back(measured[each.items[items[index]]].design);
        }
        request = wire::with_content_id(std::move(request));
        open_.emplace(request.request_id, std::move(place));
        requests.push_back(std::move(request));
      }
    }
  }
  return requests;
}

bool FarmRequests::take(wire::SimulateResult part) {
  const auto open = open_.find(part.request_id);
  if (open == open_.end()) return false;  // answered before, or not of this batch
  const auto response = collector_.add(std::move(part));
  if (!response) return false;
  const Place& place = open->second;
  for (std::size_t index = 0; index < place.items.size() && index < response->size(); ++index) {
    predictions_[place.evaluation][place.items[index]] =
        prediction_of((*response)[index], place.modulus, place.toughness);
  }
  open_.erase(open);
  return open_.empty();
}

}  // namespace nacre::runtime
