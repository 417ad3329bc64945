#pragma once
// Experiments and responses as text: what travels between the node's core and its worker threads.

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "laboratory/laboratory.hpp"

namespace nacre::virtual_lab {

using laboratory::Experiment;
using laboratory::TrueResponse;

/// One line of JSON; equal experiments are equal texts.
std::string to_spec(const Experiment& experiment);
/// Reads to_spec() back.
Result<Experiment> experiment_from_spec(std::string_view spec);

/// JSON that gives every number back to the last bit; a failed simulation is its sentence.
std::string to_text(const Result<TrueResponse>& response);
/// Reads to_text() back; an unreadable text is a failed simulation.
Result<TrueResponse> response_from_text(std::string_view text);

}  // namespace nacre::virtual_lab
