#include "dashboard/nodes_view.hpp"

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

std::vector<NodeRow> node_rows(const std::vector<NodeReport>& nodes, bool is_over) {
  std::vector<NodeRow> rows;
  for (const NodeReport& report : nodes) rows.push_back({state_of(report, is_over), &report});
  return rows;
}

}  // namespace nacre::dashboard
