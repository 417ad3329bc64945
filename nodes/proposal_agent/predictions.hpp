#pragma once
// What is predicted of chosen designs: where specimens differ, T is the mean over specimens that did not choose them.

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "wire/convert.hpp"

namespace nacre::proposal_agent {

class Predictions {
 public:
  explicit Predictions(wire::Proposal chosen) : proposal_(std::move(chosen)) {}

  /// Requests for tester::kPredictionSpecimens of every chosen pattern; empty where specimens do not differ.
  std::vector<wire::SimulateRequest> requests(const wire::SimulateRequest& model, const std::string& id);
  bool waits_for(const std::string& request_id) const { return open_.contains(request_id); }
  /// Takes the response to one of the requests; designs that cannot be tested keep the T that they were chosen by.
  /// Returns whether all have come.
  bool take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response);

  const wire::Proposal& proposal() const { return proposal_; }

 private:
  wire::Proposal proposal_;
  std::set<std::string> open_;
};

}  // namespace nacre::proposal_agent
