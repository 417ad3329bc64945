#pragma once
// Which run is played.

#include <string>

#include "dashboard/page_fields.hpp"

namespace nacre::dashboard {

struct RunRow {
  static constexpr std::string_view kPageName = "RunInfo";
  std::string run, scenario;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int rounds = 0;  ///< number of the last one
  bool approval = false;
  bool virtual_lab = false;
  bool diagnosis = false;  ///< the analyser looks for hidden effects
  int replicates = 0;
  std::string started, nacre_version, commit;
  bool report = false;  ///< there is one
  std::string user;

  static void fields(auto& field, auto& m) {
    field("run", m.run);
    field("scenario", m.scenario);
    field("fidelity", m.fidelity);
    field("rounds", m.rounds);
    field("approval", m.approval);
    field("virtual_lab", m.virtual_lab);
    field("diagnosis", m.diagnosis);
    field("replicates", m.replicates);
    field("started", m.started);
    field("nacre_version", m.nacre_version);
    field("commit", m.commit);
    field("report", m.report);
    field("user", m.user);
  }
};

}  // namespace nacre::dashboard
