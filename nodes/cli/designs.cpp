// Part of the command line (command.hpp): nacre designs, how far each design of a run has got, and nacre printed,
// a print job has left the printer.

#include <string>
#include <vector>

#include "base/counted.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "design_words.hpp"
#include "laboratory_view.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "wire/field_json.hpp"

namespace nacre::cli {
namespace {

struct DesignsOptions {
  std::string run = "logs/latest";
  bool json = false;
};

/// A line of the table, without blanks at its end.
template <class... Cells>
void print_line(const Cells&... cells) {
  std::string line = fmt::format("{:16}  {:18}  {:>7}  {:>7}  {:>8}  {:>5}  {:10}  {}", cells...);
  line.erase(line.find_last_not_of(' ') + 1);
  fmt::print("{}\n", line);
}

/// A line for each design, its specimens counted; then what waits for a person.
void print_designs(const std::vector<game::DesignState>& states, bool waits_for_approval) {
  if (!states.empty())
    print_line("design", "state", "ordered", "printed", "measured", "valid", "proposed", "decided by");
  int waiting = 0;
  for (const game::DesignState& state : states) {
    if (state.stage == game::DesignStage::pending) ++waiting;
    print_line(state.design.name(), stage_in_words(state.stage, waits_for_approval), state.ordered, state.printed,
               state.arrived, state.valid, state.round < 0 ? "" : fmt::format("in round {}", state.round),
               state.decided_by.empty() ? "" : fmt::format("{}: {}", state.decided_by, state.why));
  }
  if (waits_for_approval && waiting > 0) fmt::print("{}\n", waiting_in_words(waiting));
}

int show_designs(const DesignsOptions& options) {
  const RunAccess run = open_run(options.run);
  const LaboratoryView view = view_laboratory(run);
  const auto states = game::design_states(view.facts);
  if (options.json) {
    print_json(wire::json_of(states));
  } else {
    print_designs(states, waits_for_approval(run, view));
    fmt::print("{}", price_line(run, view));
  }
  if (states.empty()) remark("there is no design yet");
  return states.empty() ? 1 : 0;
}

struct PrintedOptions {
  std::string job;
  std::optional<int> tray;
  bool undo = false;
  std::string run = "logs/latest";
  std::string by = user_name();
};

int mark_printed(const PrintedOptions& options) {
  const RunAccess run = open_run(options.run);
  // A folder, or the name of a job that the run knows.
  const bool is_folder = std::filesystem::is_directory(options.job);
  const std::filesystem::path job = is_folder ? std::filesystem::path(options.job) : jobs_folder(run) / options.job;
  const auto specimens = specimens_of_build_sheet(job / "build_sheet.json", options.tray);
  if (options.undo) {
    const int taken = forget_printed(run, specimens, measured_names(view_laboratory(run).facts));
    fmt::print("{} no longer printed\n", counted(taken, "specimen"));
    return 0;
  }
  const int added = record_printed(run, specimens, options.by);
  fmt::print("{} printed, {} known already\n", counted(added, "specimen"),
             specimens.size() - static_cast<std::size_t>(added));
  return 0;
}

}  // namespace

void add_designs(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DesignsOptions>();
  CLI::App& command = add_command(app, action, "designs",
                                  "Show how far each design of a run has got: proposed, approved, printed, measured",
                                  options, show_designs);
  add_run_option(command, options->run);
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

void add_printed(CLI::App& app, Action& action) {
  const auto options = std::make_shared<PrintedOptions>();
  CLI::App& command = add_command(app, action, "printed", "Tell the run that a job of nacre fabricate has been printed",
                                  options, mark_printed);
  command.add_option("JOB", options->job, "Folder of the print job, or its name in the run")->required();
  command.add_option("--tray", options->tray, "This tray alone")->check(CLI::Range(1, 10'000));
  command.add_flag("--undo", options->undo, "It is not printed after all; what is measured stays");
  add_run_option(command, options->run);
  command.add_option("--by", options->by, "Who printed it")->default_str("your account");
}

}  // namespace nacre::cli
