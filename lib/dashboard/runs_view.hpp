#pragma once
// The list of the runs that are shown beside each other.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/page_fields.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// A run in the list, as of its last complete round.
struct ListedRunRow {
  static constexpr std::string_view kPageName = "ListedRun";
  static constexpr std::string_view kStates[] = {"playing", "finished", "stopped", "unreadable"};
  std::string run = {};
  std::string_view state = "unreadable";
  std::string problem = {};  ///< why it cannot be read; else empty
  std::string scenario = {};
  tester::Fidelity fidelity = tester::Fidelity::full;
  int rounds = 0;                 ///< number of the last one that is planned
  std::optional<int> round = {};  ///< last complete one
  std::string data = {};          ///< changes with every write of the analyser
  /// GPa MPa; nothing before designs are measured.
  std::optional<double> measured_hypervolume = {}, hypervolume_error = {}, gap = {};

  static void fields(auto& field, auto& m) {
    field("run", m.run);
    field("state", m.state, OneOf{kStates});
    field("problem", m.problem);
    field("scenario", m.scenario);
    field("fidelity", m.fidelity);
    field("rounds", m.rounds);
    field("round", m.round);
    field("data", m.data);
    field("measured_hypervolume", m.measured_hypervolume);
    field("hypervolume_error", m.hypervolume_error);
    field("gap", m.gap);
  }
};

struct RunsRow {
  static constexpr std::string_view kPageName = "Runs";
  std::vector<ListedRunRow> runs;

  static void fields(auto& field, auto& m) { field("runs", m.runs); }
};

/// Enters how far the run is.
void enter_standing(ListedRunRow& row, const run::RunRecord& run, bool is_playing);

}  // namespace nacre::dashboard
