#pragma once
// The folder of a run: scenario as resolved with the files it names, manifest, logs. And the UDP port that belongs to
// it.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/scenario.hpp"

namespace nacre::runtime {

/// What a run is, apart from its scenario; manifest.json.
struct Manifest {
  std::string run_id;                ///< name of the run's folder
  std::string scenario_hash;         ///< content hash of the resolved scenario.toml
  int port = 0;                      ///< UDP port of the run's bus at its last start
  bool lan = false;                  ///< the run spans hosts
  std::string started;               ///< UTC, 2026-01-31T14:05:02Z
  std::vector<std::string> resumed;  ///< UTC times of later starts
  std::string nacre_version;
  int kernel_version = 0;  ///< tester::kKernelVersion
  int schema_version = 0;  ///< of the message types
  std::string commit;      ///< git commit of the sources, "+changes" appended when they differ from it; or "unknown"
};

/// The version of the message types that a run is recorded with.
inline constexpr int kSchemaVersion = 1;

/// A UDP port of this host that belongs to this process until the object dies: no other launcher takes it meanwhile.
class PortReservation {
 public:
  /// The port wanted, or any free one for 0. Throws InputError when it is in use.
  explicit PortReservation(int wanted);
  ~PortReservation();
  PortReservation(const PortReservation&) = delete;
  PortReservation& operator=(const PortReservation&) = delete;
  int port() const { return port_; }

 private:
  int port_ = 0;
  int claim_ = -1;
};

/// A run's folder, held by one launcher at a time.
class RunFolder {
 public:
  /// Makes LOGS/NAME with scenario.toml, the files it names under inputs/, and points LOGS/latest at it. An empty name
  /// becomes date-time-scenario. Throws InputError: the folder exists or cannot be written.
  static RunFolder create(const std::filesystem::path& logs, const std::string& name, const game::Scenario& scenario);
  /// Opens a run's folder to go on with it. Throws InputError: not a run's folder, or another launcher holds it.
  static RunFolder resume(const std::filesystem::path& folder);
  /// Opens a run's folder, or a copy of it, beside the launcher that holds it. Throws InputError: not a run's folder.
  static RunFolder visit(const std::filesystem::path& folder);
  ~RunFolder();
  RunFolder(RunFolder&& other) noexcept;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path scenario_file() const { return path_ / "scenario.toml"; }
  std::filesystem::path bus_log() const { return path_ / "run.lcm"; }
  std::filesystem::path node_folder(const std::string& node) const { return path_ / "nodes" / node; }
  const game::Scenario& scenario() const { return scenario_; }
  const Manifest& manifest() const { return manifest_; }
  /// Writes the port of this start into the manifest.
  void set_port(int port);

 private:
  RunFolder() = default;
  static RunFolder opened(const std::filesystem::path& folder);
  void hold();
  void fill(const std::string& run_id, const game::Scenario& scenario);
  void write_manifest() const;
  std::filesystem::path path_;
  game::Scenario scenario_;
  Manifest manifest_;
  int lock_ = -1;
};

/// Reads RUN/manifest.json. Throws InputError when `folder` is not a run's folder.
Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace nacre::runtime
