#pragma once
// The inverse of schema.hpp's to_json: messages from people or files.

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/result.hpp"

namespace nacre::wire {

/// The LCM encoding of `message`, which must have exactly the members of `type` (that of a channel): to_json's inverse,
/// to the last bit. The error names the member and what was expected.
Result<std::string> from_json(std::string_view type, const nlohmann::ordered_json& message);

}  // namespace nacre::wire
