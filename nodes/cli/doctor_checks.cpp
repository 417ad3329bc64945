#include "doctor_checks.hpp"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/chrono.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "game/scenario.hpp"
#include "run/run_schema.hpp"
#include "runtime/bus.hpp"
#include "runtime/process.hpp"
#include "runtime/version.hpp"
#include "store/database_care.hpp"
#include "store/simulation_cache.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {

namespace fs = std::filesystem;

namespace {

fs::path program_of(std::string_view node) {
  return runtime::this_program().parent_path() / fmt::format("nacre_{}", node);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Tries to write, sync and remove a small file; how long the sync took, or why it could not be.
Result<double> seconds_to_keep(const fs::path& folder) {
  const fs::path file = folder / fmt::format(".doctor-{}", ::getpid());
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (fd < 0) return fail("{}: cannot be written: {}", folder.string(), std::strerror(errno));
  const std::string bytes(4096, 'x');
  const auto began = std::chrono::steady_clock::now();
  const bool is_kept =
      ::write(fd, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()) && ::fsync(fd) == 0;
  const int reason = errno;
  ::close(fd);
  ::unlink(file.c_str());
  if (!is_kept) return fail("{}: cannot be written: {}", folder.string(), std::strerror(reason));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace

Finding check_programs() {
  std::string missing;
  for (const std::string_view node : game::kNodes) {
    if (::access(program_of(node).c_str(), X_OK) != 0) missing += fmt::format(" nacre_{}", node);
  }
  const std::string folder = runtime::this_program().parent_path().string();
  if (missing.empty()) return {"programs of the nodes", CheckStatus::good, "all in " + folder};
  return {"programs of the nodes", CheckStatus::fault, fmt::format("not in {}:{}", folder, missing),
          "cmake --build build"};
}

Finding check_versions() {
  const std::string own = runtime::version_in_words();
  std::vector<std::string> others;
  for (const std::string_view node : game::kNodes) {
    const auto answer = runtime::ask_program({program_of(node).string(), "--version"});
    if (first_line(answer.output) != own)
      others.push_back(fmt::format("nacre_{}: {}", node, first_line(answer.output)));
  }
  if (!others.empty()) {
    return {"versions", CheckStatus::fault, fmt::format("nacre: {}; {}", own, fmt::join(others, "; ")),
            "cmake --build build"};
  }
  const std::string libraries = fmt::format("{}; SQLite {}", own, sqlite3_libversion());
  if (sqlite3_libversion_number() >= 3037000 && sqlite3_threadsafe() != 0)
    return {"versions", CheckStatus::good, libraries};
  return {"versions", CheckStatus::fault, libraries + ": 3.37 or later with threads is needed",
          "apt-get install libsqlite3-0"};
}

Finding check_route(int port, bool lan) {
  const auto source = runtime::multicast_source(port);
  if (!source) {
    return {"multicast route", CheckStatus::fault, source.error().message,
            "ip link set lo up; ip route add 224.0.0.0/4 dev lo"};
  }
  if (!source->starts_with("127.")) return {"multicast route", CheckStatus::good, "multicast leaves from " + *source};
  if (!lan) {
    return {"multicast route", CheckStatus::good, "multicast stays on this machine, which is enough for hosts = local"};
  }
  return {"multicast route", CheckStatus::fault, "multicast stays on this machine, and the run spans several",
          "ip route replace 224.0.0.0/4 dev INTERFACE   # the one to the other machines"};
}

Finding check_loopback(int port, bool lan) {
  Finding finding{"messages come back", CheckStatus::fault, "", "nft list ruleset   # and allow UDP to 239.255.76.67"};
  runtime::BusOptions options;
  options.url = runtime::bus_url(port, lan);
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
    (*bus)->publish({"STATUS", wire::write(wire::NodeStatus{})});
    (*bus)->receive(100, [&](const runtime::Received&) { has_come_back = true; });
  }
  if (!has_come_back) return finding.found = "a message sent to the bus did not come back within 3 s", finding;
  return {"messages come back", CheckStatus::good, fmt::format("on UDP port {}", port)};
}

Finding check_receive_buffer() {
  constexpr long kWanted = 2'097'152;  // recv_buf_size of the bus
  const char* file = "/proc/sys/net/core/rmem_max";
  if (!fs::exists(file)) return {"receive buffer", CheckStatus::good, "set by the network's owner (a namespace)"};
  const long allowed = std::atol(read_file(file).c_str());
  if (allowed >= kWanted) return {"receive buffer", CheckStatus::good, fmt::format("{} bytes allowed", allowed)};
  return {"receive buffer", CheckStatus::remark,
          fmt::format("{} bytes allowed, {} wanted: in bursts messages are lost and sent again", allowed, kWanted),
          "sysctl -w net.core.rmem_max=8388608"};
}

Finding check_disk(const fs::path& logs) {
  constexpr double kWantedGb = 1.0;
  struct statvfs disk {};
  if (::statvfs(logs.c_str(), &disk) != 0) {
    return {"disk space", CheckStatus::fault, fmt::format("{}: no such folder", logs.string()),
            "mkdir -p " + shell_word(logs)};
  }
  const double free_gb = 1e-9 * static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  const std::string found = fmt::format("{:.1f} GB free in {}", free_gb, logs.string());
  if (free_gb >= kWantedGb) return {"disk space", CheckStatus::good, found};
  return {"disk space", CheckStatus::fault, found,
          fmt::format("du -sh {}/*   # and delete runs that nobody needs", shell_word(logs))};
}

Finding check_sync(const fs::path& logs) {
  constexpr double kSlowS = 0.1;
  const auto seconds = seconds_to_keep(logs);
  if (!seconds) {
    return {"disk writes", CheckStatus::fault, seconds.error().message,
            fmt::format("ls -ld {0}; df -h {0}; df -i {0}", shell_word(logs))};
  }
  const std::string found = fmt::format("a file is safely on disk after {:.1f} ms", 1e3 * *seconds);
  if (*seconds < kSlowS) return {"disk writes", CheckStatus::good, found};
  return {"disk writes", CheckStatus::remark, found + ": every measurement waits for that; a local disk is faster",
          "nacre launch SCENARIO.toml --logs FOLDER_ON_ANOTHER_DISK"};
}

Finding judge_clock(std::time_t now, int status) {
  constexpr std::time_t kThisProgramIsYounger = 1'767'225'600;  // 2026-01-01
  const std::string says = fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(now));
  if (now < kThisProgramIsYounger) {
    return {"clock", CheckStatus::fault, says + ": earlier than this program",
            "timedatectl set-time 'YYYY-MM-DD hh:mm:ss'"};
  }
  if ((status & STA_UNSYNC) == 0) return {"clock", CheckStatus::good, says + ", synchronised by the network"};
  return {"clock", CheckStatus::remark,
          says + ", not synchronised: results do not depend on it, but the times in logs of several machines differ",
          "timedatectl set-ntp true"};
}

Finding check_clock() {
  timex clock{};
  ::adjtimex(&clock);
  return judge_clock(std::time(nullptr), clock.status);
}

namespace {

/// What a database that is not whole is reported as; nothing where it is. `remedy`: against damage.
std::optional<Finding> fault_of(const std::string& check, const fs::path& file, const std::string& remedy) {
  try {
    if (const auto whole = store::check_database(file); !whole)
      return Finding{check, CheckStatus::fault, whole.error().message, remedy};
    return std::nullopt;
  } catch (const store::DatabaseUnavailable& error) {
    return Finding{check, CheckStatus::fault, error.what(),
                   fmt::format("fuser -v {}   # who writes it: wait for it, or end it", shell_word(file))};
  }
}

}  // namespace

Finding check_cache(const fs::path& file) {
  const std::string check = "cache of simulations";
  if (!fs::exists(file)) return {check, CheckStatus::good, "there is none yet"};
  const std::string remedy = fmt::format("nacre rebuild --cache {}   # saves what can be read", shell_word(file));
  if (const auto fault = fault_of(check, file, remedy)) return *fault;
  const int version = store::schema_version(file);
  if (version >= 0 && version <= store::kCacheSchemaVersion)
    return {check, CheckStatus::good, file.string() + " is whole"};
  return {check, CheckStatus::fault,
          fmt::format("{} has schema version {}, this program writes {}", file.string(), version,
                      store::kCacheSchemaVersion),
          fmt::format("mv {0} {0}.broken   # the farm begins a new one", shell_word(file))};
}

Finding check_run(const fs::path& run) {
  const std::string check = "database of the run";
  const fs::path file = run / "run.db";
  if (!fs::exists(file)) return {check, CheckStatus::good, "there is none yet"};
  const std::string remedy = "nacre rebuild --run " + shell_word(run);
  if (const auto fault = fault_of(check, file, remedy)) return *fault;
  const int version = store::schema_version(file);
  if (version == run::kRunSchemaVersion) return {check, CheckStatus::good, file.string() + " is whole"};
  return {
      check, CheckStatus::remark,
      fmt::format("{} has schema version {}, this program writes {}", file.string(), version, run::kRunSchemaVersion),
      remedy};
}

Finding check_slurm(bool wanted) {
  const CheckStatus otherwise = wanted ? CheckStatus::fault : CheckStatus::remark;
  const auto version = runtime::ask_program({"sbatch", "--version"});
  if (version.end.exit_status == runtime::kProgramNotFound) {
    if (!wanted) return {"Slurm", CheckStatus::good, "not installed; only farm.executor = \"slurm\" needs it"};
    return {"Slurm", CheckStatus::fault, "sbatch is not installed",
            "apt-get install slurm-client   # and the cluster's slurm.conf"};
  }
  if (!version.end.orderly()) {
    return {"Slurm", otherwise, "installed, but it finds no cluster: " + first_line(version.output),
            "export SLURM_CONF=/path/to/slurm.conf   # the cluster's; Slurm looks for it when it starts"};
  }
  const auto nodes = runtime::ask_program({"sinfo", "--noheader", "--format=%t %D"});
  if (!nodes.end.orderly()) {
    return {"Slurm", otherwise, first_line(version.output) + "; no answer: " + first_line(nodes.output),
            "echo $SLURM_CONF; scontrol ping   # is this the cluster's configuration, does its controller run?"};
  }
  int usable = 0, all = 0, count = 0;
  std::istringstream lines(nodes.output);
  for (std::string state; lines >> state >> count; all += count) {
    static const std::set<std::string> kUsable = {"idle", "mix", "alloc", "comp"};
    if (kUsable.contains(state)) usable += count;
  }
  const std::string found = fmt::format("{}, {} of {} nodes take tasks", first_line(version.output), usable, all);
  if (usable > 0) return {"Slurm", CheckStatus::good, found};
  return {"Slurm", otherwise, found, "sinfo -R; scontrol update nodename=NODE state=resume"};
}

}  // namespace nacre::cli
