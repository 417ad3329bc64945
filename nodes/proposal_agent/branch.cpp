#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "proposal_agent/proposal_core.hpp"

namespace nacre::proposal_agent {

Branch::Branch(int number, const explore::SearchSettings& settings, std::string request_prefix)
    : search_(explore::make_search(settings)), prefix_(fmt::format("{}/s{}", request_prefix, number)) {}

std::string Branch::question_id() const { return fmt::format("search/{}/g{}", prefix_, generation_ + 1); }

std::vector<wire::SimulateRequest> Branch::next(const wire::SimulateRequest& model) {
  return requests_for(model, search_->ask());
}

std::vector<wire::SimulateRequest> Branch::next(const wire::SimulateRequest& model,
                                                std::span<const pattern::Pattern> answer) {
  return requests_for(model, search_->ask_with(answer));
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
  simulated_ += static_cast<int>(patterns.size());
  for (std::size_t first = 0; first < patterns.size(); first += wire::kMaximumDesigns) {
    wire::SimulateRequest request = model;
    request.request_id = fmt::format("{}/g{}{}", prefix_, generation_, first == 0 ? "" : fmt::format("/from{}", first));
    const std::size_t end = std::min(first + wire::kMaximumDesigns, patterns.size());
    for (std::size_t index = first; index < end; ++index) request.designs.emplace_back(patterns[index]);
    first_.emplace(request.request_id, first);
    requests.push_back(std::move(request));
  }
  return requests;
}

bool Branch::take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& answer) {
  const auto open = first_.find(request_id);
  for (std::size_t index = 0; index < answer.size() && open->second + index < performances_.size(); ++index) {
    if (answer[index].failure.empty()) {
      performances_[open->second + index] = optimize::Performance{answer[index].modulus_pa, answer[index].toughness_pa};
    }
  }
  first_.erase(open);
  if (!first_.empty()) return false;
  search_->tell(performances_);
  return true;
}

}  // namespace nacre::proposal_agent
