// Part of the command line (command.hpp): nacre doctor, what usually keeps a game from running on a machine, each with
// what to type to mend it.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/counted.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "doctor_checks.hpp"
#include "game/scenario.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "runtime/run_folder.hpp"
#include "shipped_files.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::cli {
namespace {

struct DoctorOptions {
  std::string logs = "logs";
  std::string run;
  std::string scenario;
  int port = 0;
  bool json = false;
};

/// The port that the checks of the bus use: the one asked for, or any free one.
int port_to_check(int wanted, std::vector<Finding>& findings) {
  try {
    const runtime::PortReservation reservation(wanted);
    findings.push_back({"UDP port", CheckStatus::good, fmt::format("{} is free", reservation.port())});
    return reservation.port();
  } catch (const InputError& error) {
    findings.push_back({"UDP port", CheckStatus::fault, error.what(),
                        wanted == 0 ? "ss -ulpn" : fmt::format("ss -ulpn 'sport = :{}'", wanted)});
    return 7667;
  }
}

std::string_view to_string(CheckStatus verdict) {
  return verdict == CheckStatus::good ? "good" : verdict == CheckStatus::remark ? "remark" : "fault";
}

std::vector<Finding> look_at_everything(const DoctorOptions& options) {
  const game::Scenario scenario =
      options.scenario.empty() ? game::Scenario{} : game::read_scenario(scenario_file(options.scenario));
  const bool lan = scenario.hosts == "lan";
  std::vector<Finding> findings = {check_programs()};
  if (findings.back().verdict == CheckStatus::good) findings.push_back(check_versions());
  const int port = port_to_check(options.port != 0 ? options.port : scenario.port, findings);
  findings.push_back(check_route(port, lan));
  if (findings.back().verdict == CheckStatus::good) findings.push_back(check_loopback(port, lan));
  findings.push_back(check_receive_buffer());
  findings.push_back(check_disk(options.logs));
  if (std::filesystem::is_directory(options.logs)) {
    findings.push_back(check_sync(options.logs));
    findings.push_back(check_cache(std::filesystem::path(options.logs) / store::kCacheName));
    const std::filesystem::path of_device = std::filesystem::path(options.logs) / store::kDeviceCacheName;
    if (std::filesystem::exists(of_device)) findings.push_back(check_cache(of_device));
  }
  // Without --run there may be no run yet.
  const std::filesystem::path latest = std::filesystem::path(options.logs) / "latest";
  if (!options.run.empty() || std::filesystem::exists(latest))
    findings.push_back(check_run(options.run.empty() ? latest : open_run(options.run).folder));
  findings.push_back(check_clock());
  findings.push_back(check_slurm(scenario.farm.executor == "slurm"));
  return findings;
}

int examine(const DoctorOptions& options) {
  const std::vector<Finding> findings = look_at_everything(options);
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    document.push_back({{"check", finding.check},
                        {"verdict", to_string(finding.verdict)},
                        {"found", finding.found},
                        {"remedy", finding.remedy}});
    if (options.json) continue;
    fmt::print("{:<7} {}: {}\n", to_string(finding.verdict), finding.check, finding.found);
    if (!finding.remedy.empty()) fmt::print("        to mend it, type: {}\n", finding.remedy);
  }
  const auto faults = std::ranges::count(findings, CheckStatus::fault, &Finding::verdict);
  const auto remarks = std::ranges::count(findings, CheckStatus::remark, &Finding::verdict);
  if (options.json) {
    print_json(document);
  } else if (faults == 0) {
    fmt::print("Games can be played here{}\n",
               remarks == 0 ? "" : fmt::format("; {} on time or comfort", counted(remarks, "remark")));
  } else {
    fmt::print("{} a game from running\n", counted(faults, "fault keeps", "faults keep"));
  }
  return faults == 0 ? 0 : 1;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DoctorOptions>();
  CLI::App& command =
      add_command(app, action, "doctor", "Check what usually keeps a game from running", options, examine);
  command.add_option("--logs", options->logs, "Folder where runs are kept")->capture_default_str();
  command.add_option("--run", options->run, "Folder of a run to check as well; default: LOGS/latest");
  command.add_option("--scenario", options->scenario,
                     "Scenario to be played: also checks its port, several machines, Slurm");
  command.add_option("--port", options->port, "UDP port to check; 0: any free one")->check(CLI::Range(0, 65535));
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
