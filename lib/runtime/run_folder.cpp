#include "runtime/run_folder.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/file_aside.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/names.hpp"
#include "base/result.hpp"
#include "base/shipped_files.hpp"
#include "tester/simulation_key.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

namespace fs = std::filesystem;

std::string formatted_time(const char* format, bool utc) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  utc ? ::gmtime_r(&now, &parts) : ::localtime_r(&now, &parts);
  char text[64];
  return std::string(text, std::strftime(text, sizeof text, format, &parts));
}

std::string utc_now() { return formatted_time("%Y-%m-%dT%H:%M:%SZ", true); }

/// Replaces `link` in one step, so that a reader never finds it missing.
void point_link_at(const fs::path& link, const fs::path& target) {
  const fs::path aside = name_aside(link);
  std::error_code error;
  fs::create_symlink(target, aside, error);
  if (!error) fs::rename(aside, link, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(aside, ignored);
  throw InputError::format("{}: cannot be pointed at {}: {}", link.string(), target.string(), error.message());
}

/// Copies a file that the scenario names into the run's folder and names the copy, relative to the scenario, instead.
void take_along(std::string& file, const fs::path& folder, const std::string& name) {
  if (file.empty()) return;
  make_folder(folder / "inputs");
  write_file_atomically(folder / "inputs" / name, read_file(file));
  file = "inputs/" + name;
}

/// `shared`: listeners of LCM may be there, as an own laboratory or a logger that waits for the run.
bool port_is_free(int port, bool shared) {
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const int yes = shared ? 1 : 0;
  ::setsockopt(probe, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  // Without SO_REUSEADDR this fails when anyone listens there, also another bus.
  const bool is_free = ::bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(probe);
  return is_free;
}

/// Claims the port among launchers by a name in the kernel that vanishes with this process; -1 when another has it.
int claim_port(int port) {
  const int claim = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("nacre/bus-port/{}", port);
  std::memcpy(address.sun_path + 1, name.data(), name.size());  // a leading zero byte: no file
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (::bind(claim, reinterpret_cast<const sockaddr*>(&address), length) == 0) return claim;
  ::close(claim);
  return -1;
}

}  // namespace

PortReservation::PortReservation(int wanted) {
  constexpr int kFirst = 7700;
  constexpr int kCount = 2000;
  const auto take = [this, wanted](int port) {
    claim_ = claim_port(port);
    if (claim_ >= 0 && port_is_free(port, wanted != 0)) {
      port_ = port;
      return true;
    }
    if (claim_ >= 0) ::close(std::exchange(claim_, -1));
    return false;
  };
  if (wanted != 0) {
    if (take(wanted)) return;
    throw InputError::format(
        "UDP port {} is in use on this machine: expected a free one (--port N), or --port 0 to let "
        "the launcher choose",
        wanted);
  }
  for (int i = 0; i < kCount; ++i) {
    if (take(kFirst + (static_cast<int>(::getpid()) + i) % kCount)) return;
  }
  throw InputError::format("no UDP port from {} to {} is free on this machine", kFirst, kFirst + kCount - 1);
}

PortReservation::~PortReservation() {
  if (claim_ >= 0) ::close(claim_);
}

namespace {

constexpr std::string_view kLatest = "latest";  // in the folder of runs

/// A run's name is a folder's name and stands in every message; empty: the launcher makes one.
void check_name(const std::string& name) {
  if (name.empty()) return;
  if (!is_plain_name(name, wire::kMaximumName, ".") || name.starts_with('.'))
    throw InputError::format("run name \"{}\", expected at most {} letters, digits, '-', '_' and '.', not '.' first",
                             name, wire::kMaximumName);
  if (name == kLatest)
    throw InputError::format("run name \"{0}\", expected another: {0} is the link to the newest run", name);
}

/// Makes LOGS/NAME, or LOGS/date-time-SCENARIO, and returns its name.
std::string make_run_folder(const fs::path& logs, const std::string& name, const std::string& scenario) {
  const std::string base = name.empty() ? formatted_time("%Y%m%d-%H%M%S-", false) + scenario : name;
  std::string chosen = base;
  std::error_code error;
  for (int i = 2; !fs::create_directory(logs / chosen, error); ++i) {
    if (error) throw InputError::format("{}: cannot be made: {}", (logs / chosen).string(), error.message());
    if (!name.empty()) {
      throw InputError::format(
          "{}: exists already: expected a new name, or `nacre launch --resume {}` to go on with it",
          (logs / name).string(), shell_word(logs / name));
    }
    chosen = fmt::format("{}-{}", base, i);
  }
  return chosen;
}

}  // namespace

RunFolder RunFolder::create(const fs::path& logs, const std::string& name, const game::Scenario& scenario) {
  check_name(name);
  make_folder(logs);
  const std::string chosen = make_run_folder(logs, name, scenario.name);
  RunFolder run;
  run.path_ = fs::absolute(logs / chosen).lexically_normal();
  try {
    run.hold();
    run.fill(chosen, scenario);
    point_link_at(logs / kLatest, chosen);
  } catch (...) {
    std::error_code left_behind;
    fs::remove_all(run.path_, left_behind);  // half a run would only block its name
    throw;
  }
  return run;
}

/// Writes what a new run begins with.
void RunFolder::fill(const std::string& run_id, const game::Scenario& scenario) {
  game::Scenario resolved = scenario;
  take_along(resolved.benchmark_file, path_, "benchmark.csv");
  take_along(resolved.base_materials_file, path_, "base_materials.csv");
  take_along(resolved.model_file, path_, "model.toml");
  take_along(resolved.ranges_file, path_, "ranges.csv");
  take_along(resolved.discretisation_floor_file, path_, "discretisation_floor.toml");
  take_along(resolved.laboratory.file, path_, "laboratory.toml");
  const std::string text = game::to_toml(resolved);
  write_file_atomically(scenario_file(), text);
  scenario_ = game::read_scenario(scenario_file());
  manifest_ = {.run_id = run_id,
               .scenario_hash = content_hash(text),
               .port = 0,
               .lan = scenario.hosts == "lan",
               .started = utc_now(),
               .resumed = {},
               .nacre_version = NACRE_VERSION,
               .kernel_version = tester::kKernelVersion,
               .schema_version = kSchemaVersion,
               .commit = build_commit()};
  write_manifest();
}

RunFolder RunFolder::opened(const fs::path& folder) {
  RunFolder run;
  std::error_code error;
  run.path_ = fs::canonical(folder, error);
  if (error) throw InputError::format("{}: no such run: {}", folder.string(), error.message());
  run.manifest_ = read_manifest(run.path_);
  const std::string text = read_file(run.scenario_file());
  if (content_hash(text) != run.manifest_.scenario_hash) {
    throw InputError::format(
        "{}: was changed after the run began: expected the content with hash {}; a changed scenario "
        "is a new run",
        run.scenario_file().string(), run.manifest_.scenario_hash);
  }
  run.scenario_ = game::read_scenario(run.scenario_file());
  return run;
}

RunFolder RunFolder::resume(const fs::path& folder) {
  RunFolder run = opened(folder);
  run.hold();
  run.manifest_.resumed.push_back(utc_now());
  return run;
}

RunFolder RunFolder::visit(const fs::path& folder) { return opened(folder); }

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)),
      scenario_(std::move(other.scenario_)),
      manifest_(std::move(other.manifest_)),
      lock_(std::exchange(other.lock_, -1)) {}

RunFolder::~RunFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void RunFolder::hold() {
  const fs::path file = path_ / "launcher.lock";
  lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) throw InputError::format("{}: cannot be made: {}", file.string(), std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  throw InputError::format("{}: another launcher plays this run; expected it to be stopped first (Ctrl-C)",
                           path_.string());
}

void RunFolder::set_port(int port) {
  manifest_.port = port;
  write_manifest();
}

void RunFolder::write_manifest() const {
  const Manifest& m = manifest_;
  const nlohmann::ordered_json document = {{"run_id", m.run_id},
                                           {"scenario", scenario_.name},
                                           {"scenario_hash", m.scenario_hash},
                                           {"seed", scenario_.seed},
                                           {"port", m.port},
                                           {"lan", m.lan},
                                           {"started", m.started},
                                           {"resumed", m.resumed},
                                           {"nacre_version", m.nacre_version},
                                           {"commit", m.commit},
                                           {"kernel_version", m.kernel_version},
                                           {"schema_version", m.schema_version}};
  write_file_atomically(path_ / "manifest.json", document.dump(2) + "\n");
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file)) {
    throw InputError::format(
        "{}: not the folder of a run: expected manifest.json in it (logs/RUN, made by `nacre "
        "launch`)",
        folder.string());
  }
  try {
    const auto document = nlohmann::json::parse(read_file(file));
    Manifest m;
    document.at("run_id").get_to(m.run_id);
    document.at("scenario_hash").get_to(m.scenario_hash);
    document.at("port").get_to(m.port);
    document.at("lan").get_to(m.lan);
    document.at("started").get_to(m.started);
    document.at("resumed").get_to(m.resumed);
    document.at("nacre_version").get_to(m.nacre_version);
    document.at("commit").get_to(m.commit);
    document.at("kernel_version").get_to(m.kernel_version);
    document.at("schema_version").get_to(m.schema_version);
    return m;
  } catch (const nlohmann::json::exception& error) {
    throw InputError::format("{}: not a manifest of nacre: {}", file.string(), error.what());
  }
}

}  // namespace nacre::runtime
