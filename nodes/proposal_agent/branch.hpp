#pragma once
// One of the searches that are merged into a gamut.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

/// `model`'s SIMULATE request for every pattern, under the id ID#HASH; where there are more patterns than a message
/// holds, further ones under ID/from64#HASH and so on (wire::with_content_id).
std::vector<wire::SimulateRequest> requests_for_patterns(std::span<const pattern::Pattern> patterns,
                                                         const wire::SimulateRequest& model, const std::string& id);

/// One of the searches that are merged into a gamut. Searches do not wait for each other: what one requests depends on
/// the responses to its own requests alone, so the farm stays busy while the merged result is the same.
class Branch {
 public:
  Branch(int number, const explore::SearchSettings& settings, std::string request_prefix);

  /// What must be worked out before next() (a learned search trains); nothing for a search that needs no time.
  std::optional<explore::BatchRequest> batch_request() const { return search_->batch_request(); }
  /// SIMULATE requests for the next generation; empty when the search has ended.
  std::vector<wire::SimulateRequest> next(const wire::SimulateRequest& model);
  /// The same, with the batch that batch_request() asked for.
  std::vector<wire::SimulateRequest> next(const wire::SimulateRequest& model, std::span<const pattern::Pattern> batch);
  /// Takes the response to one of the requests. Returns whether the generation is complete (then ask for next()).
  bool take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response);
  bool waits_for(const std::string& request_id) const { return first_.contains(request_id); }
  bool finished() const { return finished_; }
  /// Identity of the batch that the branch waits for or would ask for.
  std::string batch_id() const;
  int simulated() const { return simulated_; }
  const std::vector<explore::Evaluated>& evaluated() const { return search_->evaluated(); }

 private:
  std::vector<wire::SimulateRequest> requests_for(const wire::SimulateRequest& model,
                                                  const std::vector<pattern::Pattern>& patterns);

  std::unique_ptr<explore::Search> search_;
  std::string prefix_;
  int generation_ = 0;
  std::map<std::string, std::size_t> first_;  // open request -> index of its first pattern
  std::vector<std::optional<optimize::Performance>> performances_;
  int simulated_ = 0;
  bool finished_ = false;
};

}  // namespace nacre::proposal_agent
