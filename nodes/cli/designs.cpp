// nacre designs: how far each design of a run has got. nacre printed: a print job has left the printer.

#include <string>
#include <vector>

#include "base/result.hpp"
#include "command.hpp"
#include "laboratory_view.hpp"
#include "output.hpp"
#include "run_access.hpp"

namespace nacre::cli {
namespace {

struct DesignsOptions {
  std::string run = "logs/latest";
  bool json = false;
};

int show_designs(const DesignsOptions& options) {
  const auto states = game::design_states(view_laboratory(open_run(options.run)).facts);
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const game::DesignState& state : states) {
    document.push_back(game::to_json(state));
    if (options.json) continue;
    fmt::print("{:16} {:9} {:>3} ordered {:>3} printed {:>3} measured {:>3} valid{}{}\n", state.design.name(),
               game::to_string(state.stage), state.ordered, state.printed, state.arrived, state.valid,
               state.round < 0 ? "" : fmt::format("  proposal {}", state.round),
               state.decided_by.empty() ? "" : fmt::format("  {}: {}", state.decided_by, state.why));
  }
  if (options.json) print_json(document);
  if (states.empty()) remark("there is no design yet");
  return states.empty() ? 1 : 0;
}

struct PrintedOptions {
  std::string job;
  std::string run = "logs/latest";
  std::string by = user_name();
};

int mark_printed(const PrintedOptions& options) {
  const RunAccess run = open_run(options.run);
  const auto specimens = specimens_of_build_sheet(std::filesystem::path(options.job) / "build_sheet.json");
  const int added = record_printed(run, specimens, options.by);
  fmt::print("{} specimens printed, {} known already\n", added, specimens.size() - static_cast<std::size_t>(added));
  return 0;
}

}  // namespace

void add_designs(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DesignsOptions>();
  CLI::App& command =
      add_command(app, action, "designs", "Show which designs of a run are pending, approved, printed, measured",
                  options, show_designs);
  add_run_option(command, options->run);
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

void add_printed(CLI::App& app, Action& action) {
  const auto options = std::make_shared<PrintedOptions>();
  CLI::App& command =
      add_command(app, action, "printed", "Say that a job of nacre fabricate has been printed", options, mark_printed);
  command.add_option("JOB", options->job, "Folder of the job")->required();
  add_run_option(command, options->run);
  command.add_option("--by", options->by, "Who printed it")->capture_default_str();
}

}  // namespace nacre::cli
