#include "proposal_agent/predictions.hpp"

#include <algorithm>

#include "proposal_agent/branch.hpp"
#include "tester/specimen_numbers.hpp"
#include "tester/strength_field.hpp"

namespace nacre::proposal_agent {

std::vector<wire::SimulateRequest> Predictions::requests(const wire::SimulateRequest& model, const std::string& id) {
  if (!tester::specimens_differ(model.parameters)) return {};
  wire::SimulateRequest further = model;
  further.modulus = false;
  further.first_specimen = tester::kFirstPredictionSpecimen;
  further.specimens = tester::kPredictionSpecimens;
  std::vector<pattern::Pattern> patterns;
  for (const wire::ProposedDesign& each : proposal_.designs)
    if (const auto pattern = pattern::Pattern::from_layout(*each.design.layout())) patterns.push_back(*pattern);
  std::vector<wire::SimulateRequest> requests = requests_for_patterns(patterns, further, id);
  for (const wire::SimulateRequest& request : requests) open_.insert(request.request_id);
  proposal_.simulations += further.specimens * static_cast<int>(patterns.size());
  return requests;
}

bool Predictions::take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response) {
  open_.erase(request_id);
  for (const wire::SimulatedDesign& simulated : response) {
    const auto design = std::ranges::find(proposal_.designs, simulated.design, &wire::ProposedDesign::design);
    if (!simulated.failure.empty() || design == proposal_.designs.end()) continue;
    design->toughness_pa = simulated.toughness_pa;
    design->toughness_sd_pa = simulated.toughness_sd_pa;
    design->specimens = simulated.specimens;
  }
  return open_.empty();
}

}  // namespace nacre::proposal_agent
