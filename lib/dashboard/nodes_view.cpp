#include "dashboard/nodes_view.hpp"

#include "wire/field_json.hpp"

namespace nacre::dashboard {
namespace {

/// A node that has been silent for so long does not run.
constexpr double kSilent_s = 4.0;

/// A node that has finished, or whose run is over, may be silent.
std::string_view state_of(const NodeReport& report, bool is_over) {
  if (report.status.finished) return "finished";
  if (report.age_s > kSilent_s) return is_over ? "ended" : "silent";
  return report.status.ready ? "running" : "starting";
}

}  // namespace

Json nodes_json(const std::vector<NodeReport>& nodes, bool is_over) {
  Json array = Json::array();
  for (const NodeReport& report : nodes) {
    const wire::NodeStatus& s = report.status;
    Json node = {{"node", report.node},
                 {"state", state_of(report, is_over)},
                 {"age_s", report.age_s},
                 {"phase", s.phase},
                 {"round", s.round},
                 {"progress", s.progress < 0.0 ? Json(nullptr) : Json(s.progress)},
                 {"eta_s", s.eta_s < 0.0 ? Json(nullptr) : Json(s.eta_s)}};
    wire::FieldJson counters(node);
    wire::NodeStatus::counters(counters, s);
    array.push_back(std::move(node));
  }
  return array;
}

}  // namespace nacre::dashboard
