// Part of the command line (command.hpp): nacre status, what the nodes of a run say of themselves.

#include <unistd.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "base/files.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "dashboard/next_view.hpp"
#include "design_words.hpp"
#include "laboratory_view.hpp"
#include "output.hpp"
#include "run/run.hpp"
#include "run_access.hpp"
#include "runtime/live_display.hpp"
#include "runtime/terminal.hpp"
#include "wire/convert.hpp"
#include "wire/field_json.hpp"

namespace nacre::cli {
namespace {

struct StatusOptions {
  std::string run = "logs/latest";
  double seconds = 1.5;
  bool json = false;
};

using Statuses = std::map<std::string, wire::NodeStatus>;

/// The newest STATUS of every node that speaks within `seconds`.
Statuses collect(const RunAccess& run, double seconds) {
  const auto bus = listen(run, {"STATUS"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  Statuses statuses;
  while (std::chrono::steady_clock::now() < end) {
    bus->receive(50, [&](const runtime::Received& received) {
      auto status = wire::read<wire::NodeStatus>(received.message.payload);
      if (status) statuses[received.header.node] = *status;
    });
  }
  return statuses;
}

nlohmann::ordered_json to_json(const std::string& node, const wire::NodeStatus& s) {
  nlohmann::ordered_json document = {{"node", node},     {"ready", s.ready}, {"finished", s.finished},
                                     {"phase", s.phase}, {"round", s.round}, {"progress", s.progress},
                                     {"eta_s", s.eta_s}};
  wire::FieldJson counters(document);
  wire::NodeStatus::counters(counters, s);
  return document;
}

void print_table(const RunAccess& run, const Statuses& statuses) {
  const int columns = runtime::terminal_columns(STDOUT_FILENO);
  fmt::print("run {} on UDP port {}\n", run.manifest.run_id, run.manifest.port);
  for (const auto& [node, s] : statuses) {
    const runtime::NodeView view{.node = node,
                                 .state = s.finished ? "finished"
                                          : s.ready  ? "running"
                                                     : "starting",
                                 .phase = s.phase,
                                 .round = s.round,
                                 .progress = s.progress,
                                 .eta_s = s.eta_s,
                                 .restarts = 0,
                                 .problem = s.last_problem};
    fmt::print("{}\n", runtime::node_line(view, columns > 0 ? columns : 200));
    fmt::print(
        "{:18}messages: {} received, {} published, {} sent again, {} repeated, {} rejected, {} lost, {} dropped by the "
        "system\n",
        "", s.received, s.published, s.retries, s.duplicates, s.rejected, s.lost, s.dropped);
    fmt::print(
        "{:18}queues: {} to read, {} to acknowledge, {} not yet acknowledged, {} to compute; journal {:.1f} MB\n", "",
        s.queued, s.owed, s.unacknowledged, s.computing, 1e-6 * static_cast<double>(s.journal_bytes));
    if (!s.work.empty()) fmt::print("{:18}{}\n", "", s.work);
  }
}

/// What rounds bring and cost.
struct Outlook {
  dashboard::NextRoundRow next;
  std::string price_line;
};

/// As the run's database and journals tell; nothing where they cannot be read, which is said.
std::optional<Outlook> outlook_of(const RunAccess& run) {
  try {
    const LaboratoryView view = view_laboratory(run);
    return Outlook{dashboard::next_round_row(run.scenario, *run::Run(run.folder).record(), view.facts),
                   price_line(run, view)};
  } catch (const InputError& error) {
    warn(error.what());
    return std::nullopt;
  }
}

int show_status(const StatusOptions& options) {
  const RunAccess run = open_run(options.run);
  const Statuses statuses = collect(run, options.seconds);
  const std::optional<Outlook> outlook = outlook_of(run);
  if (options.json) {
    nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
    for (const auto& [node, status] : statuses) nodes.push_back(to_json(node, status));
    print_json({{"run", run.manifest.run_id},
                {"port", run.manifest.port},
                {"nodes", nodes},
                {"next", outlook ? wire::json_of(outlook->next) : nullptr}});
  } else {
    print_table(run, statuses);
    if (outlook) fmt::print("{}\n{}", next_in_words(outlook->next), outlook->price_line);
  }
  if (statuses.empty())
    remark(
        fmt::format("the run does not play: none of its nodes spoke within {} s; `nacre launch --resume {}` goes on "
                    "with it",
                    options.seconds, shell_word(options.run)));
  return statuses.empty() ? 1 : 0;
}

}  // namespace

void add_status(CLI::App& app, Action& action) {
  const auto options = std::make_shared<StatusOptions>();
  CLI::App& command =
      add_command(app, action, "status", "Show what the nodes of a run are doing", options, show_status);
  add_run_option(command, options->run);
  command.add_option("--seconds", options->seconds, "How many seconds to listen")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
