#include "offline/json_parts.hpp"

namespace nacre::offline {

nlohmann::ordered_json row_json(const measurement::RejectedRow& row) {
  return {{"line", row.line}, {"column", row.column}, {"reason", row.reason}};
}

nlohmann::ordered_json rejected_json(const std::vector<measurement::RejectedRow>& rejected) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : rejected) rows.push_back(row_json(row));
  return rows;
}

}  // namespace nacre::offline
