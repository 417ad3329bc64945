#include "wire/status_json.hpp"

namespace nacre::wire {

void append_counters(nlohmann::ordered_json& node, const node_status_t& status) {
  node["received"] = status.received;
  node["published"] = status.published;
  node["retries"] = status.retries;
  node["duplicates"] = status.duplicates;
  node["rejected"] = status.rejected;
  node["lost"] = status.lost;
  node["dropped"] = status.dropped;
  node["unacknowledged"] = status.unacknowledged;
  node["queued"] = status.queued;
  node["owed"] = status.owed;
  node["computing"] = status.computing;
  node["journal_bytes"] = status.journal_bytes;
  node["work"] = status.work;
  node["last_problem"] = status.last_problem;
}

}  // namespace nacre::wire
