#include "proposal_agent/branch.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace nacre::proposal_agent {

std::vector<wire::SimulateRequest> requests_for_patterns(std::span<const pattern::Pattern> patterns,
                                                         const wire::SimulateRequest& model, const std::string& id) {
  std::vector<wire::SimulateRequest> requests;
  for (std::size_t first = 0; first < patterns.size(); first += wire::kMaximumDesigns) {
    wire::SimulateRequest request = model;
    request.request_id = first == 0 ? id : fmt::format("{}/from{}", id, first);
    const std::size_t count = std::min(wire::kMaximumDesigns, patterns.size() - first);
    for (const pattern::Pattern& pattern : patterns.subspan(first, count)) request.designs.emplace_back(pattern);
    requests.push_back(wire::with_content_id(std::move(request)));
  }
  return requests;
}

Branch::Branch(int number, const explore::SearchSettings& settings, std::string request_prefix)
    : search_(explore::make_search(settings)), prefix_(fmt::format("{}/s{}", request_prefix, number)) {}

std::string Branch::batch_id() const { return fmt::format("search/{}/g{}", prefix_, generation_ + 1); }

std::vector<wire::SimulateRequest> Branch::next(const wire::SimulateRequest& model) {
  return requests_for(model, search_->ask());
}

std::vector<wire::SimulateRequest> Branch::next(const wire::SimulateRequest& model,
                                                std::span<const pattern::Pattern> batch) {
  return requests_for(model, search_->ask_with(batch));
}

std::vector<wire::SimulateRequest> Branch::requests_for(const wire::SimulateRequest& model,
                                                        const std::vector<pattern::Pattern>& patterns) {
  std::vector<wire::SimulateRequest> requests;
  if (patterns.empty()) {
    finished_ = true;
    return requests;
  }
  ++generation_;
  performances_.assign(patterns.size(), std::nullopt);
  simulated_ += patterns.size();
  requests = requests_for_patterns(patterns, model, fmt::format("{}/g{}", prefix_, generation_));
  for (std::size_t part = 0; part < requests.size(); ++part) {
    first_.emplace(requests[part].request_id, part * wire::kMaximumDesigns);
  }
  return requests;
}

bool Branch::take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response) {
  const auto open = first_.find(request_id);
  for (std::size_t index = 0; index < response.size() && open->second + index < performances_.size(); ++index) {
    if (response[index].failure.empty()) {
      performances_[open->second + index] =
          optimize::Performance{response[index].modulus_pa, response[index].toughness_pa};
    }
  }
  first_.erase(open);
  if (!first_.empty()) return false;
  search_->tell(performances_);
  return true;
}

}  // namespace nacre::proposal_agent
