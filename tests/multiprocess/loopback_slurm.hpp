#pragma once
// A Slurm cluster of one node on this machine, for one test: no root, no munge, nothing outside its folder.

#include <filesystem>
#include <memory>
#include <string>

#include "processes.hpp"

namespace nacre::test {

/// Starts slurmctld and slurmd in a folder and sets SLURM_CONF for this process and its children. Both end with it.
class LoopbackSlurm {
 public:
  explicit LoopbackSlurm(const std::filesystem::path& folder);
  ~LoopbackSlurm();

  /// Whether the node takes tasks; if not, why.
  bool works() const { return reason_.empty(); }
  const std::string& reason() const { return reason_; }

  /// The controller crashes; it comes back with the state that it saved.
  void kill_controller();
  void start_controller(bool clean = false);
  /// The node's daemon crashes; it comes back.
  void kill_node();
  void start_node();
  /// What operators type when the controller has drained the node after a crash ("Duplicate jobid") or calls it down;
  /// at most once a second.
  void mend_node();
  /// Whether the node is ready for tasks within timeout_s: daemons that were killed are started, the node is mended
  /// where that is needed.
  bool becomes_ready(double timeout_s);
  /// What Slurm says of its node and tasks, for people.
  std::string standing() const;

 private:
  std::filesystem::path folder_;
  std::string reason_;
  std::unique_ptr<Process> controller_, node_;
  std::chrono::steady_clock::time_point mended_ = {};
};

}  // namespace nacre::test
