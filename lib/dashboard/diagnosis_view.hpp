#pragma once
// The diagnosis of a round, as JSON.

#include <optional>

#include "dashboard/json_parts.hpp"
#include "store/run_record.hpp"
#include "wire/convert.hpp"

namespace nacre::dashboard {

/// The verdict of a round: from the message where there is one, else from the database; null when there is neither.
Json diagnosis_json(const store::RunRecord& run, const std::optional<wire::Diagnosis>& message, int round);

}  // namespace nacre::dashboard
