#pragma once
// The proposal agent's other long work: the next batch of a search that thinks (learned, tsemo, dgemo).

#include <string>
#include <vector>

#include "base/result.hpp"
#include "explore/search.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

/// Spec of a Compute of kind "search": the batch request and the model of the round, so that the batch is a function of
/// the spec. `learned` learns as by default in a game; other settings do not travel.
std::string search_spec(const explore::BatchRequest& batch_request, const wire::AdoptedModel& model);

/// Kind "search": explore::batch_for() of the batch request.
std::string search_work(const std::string& spec);

/// The patterns in the result of a "search"; the error says what is damaged.
Result<std::vector<pattern::Pattern>> batch_from_result(const std::string& result);

}  // namespace nacre::proposal_agent
