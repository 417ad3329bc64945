// nacre doctor: what usually keeps a game from running on a machine, each with what to type to mend it.

#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "nacre/node_status_t.hpp"
#include "output.hpp"
#include "runtime/bus.hpp"
#include "runtime/process.hpp"
#include "runtime/run_folder.hpp"
#include "store/simulation_cache.hpp"
#include "wire/codec.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::string logs = "logs";
  int port = 0;
  bool json = false;
};

enum class Verdict { good, remark, fault };

/// What one check found.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::good;
  std::string found;
  std::string remedy;  ///< what to type; empty when all is well
};

Finding check_route(int port) {
  const auto source = runtime::multicast_source(port);
  if (!source) {
    return {"multicast route", Verdict::fault, source.error().message,
            "ip link set lo up; ip route add 224.0.0.0/4 dev lo"};
  }
  if (source->starts_with("127.")) {
    return {"multicast route", Verdict::good,
            "multicast has a way; it stays on this machine (enough for hosts = local)", ""};
  }
  return {"multicast route", Verdict::good, "multicast leaves from " + *source, ""};
}

/// A message that this process sends to itself: route, firewall and port together.
Finding check_loopback(int port) {
  Finding finding{"messages come back", Verdict::fault, "", "allow UDP to 239.255.76.67 in the firewall"};
  runtime::BusOptions options;
  options.url = runtime::bus_url(port);
  options.node = "doctor";
  options.run_id = fmt::format("doctor_{}", ::getpid());
  auto bus = runtime::Bus::open(std::move(options));
  if (!bus) return finding.found = bus.error().message, finding;
  if (const auto subscribed = (*bus)->subscribe({"STATUS"}); !subscribed) {
    return finding.found = subscribed.error().message, finding;
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  bool has_come_back = false;
  while (!has_come_back && std::chrono::steady_clock::now() < end) {
    (*bus)->publish({"STATUS", wire::encode(node_status_t{})});
    (*bus)->receive(100, [&](const runtime::Received&) { has_come_back = true; });
  }
  if (!has_come_back) return finding.found = "a message sent to the bus did not come back within 3 s", finding;
  return {"messages come back", Verdict::good, fmt::format("on UDP port {}", port), ""};
}

Finding check_receive_buffer() {
  constexpr long kWanted = 2'097'152;  // recv_buf_size of the bus
  const char* file = "/proc/sys/net/core/rmem_max";
  const long allowed = std::atol(read_file(file).c_str());
  if (allowed >= kWanted) return {"receive buffer", Verdict::good, fmt::format("{} bytes allowed", allowed), ""};
  return {"receive buffer", Verdict::remark,
          fmt::format("{} bytes allowed, {} wanted: bursts lose messages, which are then sent again", allowed, kWanted),
          "sysctl -w net.core.rmem_max=8388608"};
}

Finding check_disk(const std::filesystem::path& logs) {
  constexpr double kWantedGb = 1.0;
  struct statvfs disk {};
  if (::statvfs(logs.c_str(), &disk) != 0) {
    return {"disk space", Verdict::fault, fmt::format("{}: no such folder", logs.string()),
            fmt::format("mkdir -p {}", logs.string())};
  }
  const double free_gb = 1e-9 * static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  const std::string found = fmt::format("{:.1f} GB free in {}", free_gb, logs.string());
  if (free_gb >= kWantedGb) return {"disk space", Verdict::good, found, ""};
  return {"disk space", Verdict::fault, found,
          fmt::format("du -sh {}/*   # and delete runs that nobody needs", logs.string())};
}

Finding check_database(const std::filesystem::path& logs) {
  const std::filesystem::path file = logs / "simulations.db";
  try {
    const store::SimulationCache cache(file);
    return {"cache of simulations", Verdict::good, fmt::format("{} holds {} answers", file.string(), cache.size()), ""};
  } catch (const InputError& error) {
    return {"cache of simulations", Verdict::fault, error.what(),
            fmt::format("mv {0} {0}.broken   # the farm begins a new one", file.string())};
  }
}

Finding check_programs() {
  const std::filesystem::path folder = runtime::this_program().parent_path();
  std::string missing;
  for (const char* node : {"virtual_lab", "simulator_farm", "analyser", "proposal_agent", "validation_agent"}) {
    const auto program = folder / (std::string("nacre_") + node);
    if (::access(program.c_str(), X_OK) != 0) missing += " " + program.filename().string();
  }
  if (missing.empty()) return {"programs of the nodes", Verdict::good, "all in " + folder.string(), ""};
  return {"programs of the nodes", Verdict::fault, fmt::format("{} lacks{}", folder.string(), missing),
          "cmake --build build"};
}

/// The port that the checks of the bus use: the one asked for, or any free one.
int port_to_check(int wanted, std::vector<Finding>& findings) {
  try {
    const runtime::PortReservation reservation(wanted);
    findings.push_back({"UDP port", Verdict::good, fmt::format("{} is free", reservation.port()), ""});
    return reservation.port();
  } catch (const InputError& error) {
    findings.push_back({"UDP port", Verdict::fault, error.what(),
                        wanted == 0 ? "ss -ulpn" : fmt::format("ss -ulpn 'sport = :{}'", wanted)});
    return 7667;
  }
}

std::string_view to_string(Verdict verdict) {
  return verdict == Verdict::good ? "good" : verdict == Verdict::remark ? "remark" : "fault";
}

int examine(const Options& options) {
  std::vector<Finding> findings = {check_programs()};
  const int port = port_to_check(options.port, findings);
  findings.push_back(check_route(port));
  if (findings.back().verdict == Verdict::good) findings.push_back(check_loopback(port));
  findings.push_back(check_receive_buffer());
  findings.push_back(check_disk(options.logs));
  if (findings.back().found.find("no such folder") == std::string::npos)
    findings.push_back(check_database(options.logs));
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    document.push_back({{"check", finding.check},
                        {"verdict", to_string(finding.verdict)},
                        {"found", finding.found},
                        {"remedy", finding.remedy}});
    if (options.json) continue;
    fmt::print("{:<7} {}: {}\n", to_string(finding.verdict), finding.check, finding.found);
    if (!finding.remedy.empty()) fmt::print("        type: {}\n", finding.remedy);
  }
  if (options.json) print_json(document);
  const auto is_fault = [](const Finding& finding) { return finding.verdict == Verdict::fault; };
  return std::any_of(findings.begin(), findings.end(), is_fault) ? 1 : 0;
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      add_command(app, action, "doctor", "Check what usually keeps a game from running", options, examine);
  command.add_option("--logs", options->logs, "Where runs are kept")->capture_default_str();
  command.add_option("--port", options->port, "UDP port to check; 0: any")->check(CLI::Range(0, 65535));
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
