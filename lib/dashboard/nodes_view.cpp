// The nodes of a run as they last spoke.

#include "dashboard/views.hpp"

namespace nacre::dashboard {
namespace {

/// A node that has been silent for so long is not running.
constexpr double kSilent_s = 4.0;

std::string_view state_of(const NodeReport& report) {
  if (report.age_s > kSilent_s) return "silent";
  return report.status.finished ? "finished" : report.status.ready ? "running" : "starting";
}

}  // namespace

Json nodes_json(const std::vector<NodeReport>& nodes) {
  Json array = Json::array();
  for (const NodeReport& report : nodes) {
    const node_status_t& s = report.status;
    array.push_back({{"node", report.node},
                     {"state", state_of(report)},
                     {"age_s", report.age_s},
                     {"phase", s.phase},
                     {"round", s.round},
                     {"progress", s.progress < 0.0 ? Json(nullptr) : Json(s.progress)},
                     {"eta_s", s.eta_s < 0.0 ? Json(nullptr) : Json(s.eta_s)},
                     {"received", s.received},
                     {"published", s.published},
                     {"retries", s.retries},
                     {"duplicates", s.duplicates},
                     {"rejected", s.rejected},
                     {"lost", s.lost},
                     {"dropped", s.dropped},
                     {"unacknowledged", s.unacknowledged},
                     {"queued", s.queued},
                     {"owed", s.owed},
                     {"computing", s.computing},
                     {"journal_bytes", s.journal_bytes},
                     {"work", s.work},
                     {"last_problem", s.last_problem}});
  }
  return array;
}

}  // namespace nacre::dashboard
