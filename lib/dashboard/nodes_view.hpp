#pragma once
// The nodes of a run as they last reported.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"
#include "dashboard/page_fields.hpp"

namespace nacre::dashboard {

struct NodeRow {
  static constexpr std::string_view kPageName = "NodeState";
  static constexpr std::string_view kStates[] = {"starting", "running", "finished", "ended", "silent"};
  std::string_view state = "starting";
  const NodeReport* report = &nothing<NodeReport>();

  static void fields(auto& field, auto& m) {
    const auto known = [](double value) { return value < 0.0 ? std::nullopt : std::optional<double>(value); };
    const wire::NodeStatus& status = m.report->status;
    field("node", m.report->node);
    field("state", m.state, OneOf{kStates});
    field("age_s", m.report->age_s);
    field("phase", status.phase);
    field("round", status.round);
    field("progress", known(status.progress));
    field("eta_s", known(status.eta_s));
    wire::NodeStatus::counters(field, status);
  }
};

/// Nodes with state, progress, time left and counters. `is_over`: the run's last round is closed, so that a silent node
/// is no fault.
std::vector<NodeRow> node_rows(const std::vector<NodeReport>& nodes, bool is_over);

/// What changes while one looks: `data` with every write of the analyser.
struct LiveRow {
  static constexpr std::string_view kPageName = "Live";
  bool playing = false;
  std::string data;
  std::vector<NodeRow> nodes;

  static void fields(auto& field, auto& m) {
    field("playing", m.playing);
    field("data", m.data);
    field("nodes", m.nodes);
  }
};

}  // namespace nacre::dashboard
