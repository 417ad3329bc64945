#pragma once
// The proposal agent's long work: choosing the designs of a round from its gamut.

#include <map>
#include <string>
#include <vector>

#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

struct Selection {
  wire::AdoptedModel model;               ///< with the benchmark line and the patterns already measured
  std::vector<explore::Evaluated> gamut;  ///< of it at least the front, and the first ranks of what is not measured
  int count = 0;                          ///< designs to select
  int simulations = 0;                    ///< spent on the gamut
};

/// Spec of a Compute of kind "select".
std::string selection_spec(const Selection& selection);

/// The agent's long work: kind "search" (search_work.hpp) and kind "select": the selection of 2.3.4 among the samples
/// that are not yet measured, and the gamut's hypervolumes. The result is the payload of the round's PROPOSAL. Where
/// too few samples lie above the homogeneous line, the rest is chosen without it, and the reason says so: a model that
/// sees nothing better must be measured, too.
std::map<std::string, runtime::WorkFunction> work_functions();

}  // namespace nacre::proposal_agent
