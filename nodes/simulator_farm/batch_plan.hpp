#pragma once
// Decisions about batches, apart from files and Slurm: how test requests are cut into batches, when one is given out
// again. Time is passed in as seconds of a steady clock.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tester/names.hpp"

namespace nacre::simulator_farm {

/// How long simulations take on one core of the cluster, by test and fidelity: a guess until tasks have reported.
class CostEstimate {
 public:
  double seconds(tester::TestKind test, tester::Fidelity fidelity) const;
  void learn(tester::TestKind test, tester::Fidelity fidelity, double seconds);

 private:
  std::map<std::pair<tester::TestKind, tester::Fidelity>, double> seconds_;
};

/// Cuts tests with these costs into batches of about `batch_s` seconds and at most `most` tests, in their order.
/// Returns the number of tests in each batch: at least 1, in sum all.
std::vector<std::size_t> cut_into_batches(const std::vector<double>& costs_s, double batch_s, std::size_t most);

/// The state of a task as Slurm lists it. `held`: it waits until somebody releases it.
enum class TaskState { absent, waiting, running, held };

/// When a batch that was given out is taken for lost.
struct Patience {
  double listing_s = 15.0;  ///< without a result after Slurm stopped listing it: files may come later than news
  double sign_s = 120.0;    ///< running, and no sign of life: its node is gone or stands still
};

/// Watches one batch that was given out.
class BatchWatch {
 public:
  explicit BatchWatch(double now_s) : since_s_(now_s), sign_s_(now_s) {}
  /// What Slurm lists; not called when Slurm did not respond.
  void listed(TaskState state, double now_s);
  /// The task's sign of life, some text that changes while it works.
  void sign(const std::string& text, double now_s);
  bool is_lost(double now_s, const Patience& patience) const;
  TaskState state() const { return state_; }

 private:
  TaskState state_ = TaskState::waiting;
  double since_s_;  ///< begin of the state
  double sign_s_;   ///< of the newest sign of life
  std::string sign_;
};

/// Seconds to wait before the next try after `failures` in a row: 1, 2, 4 ... 60.
double back_off_s(int failures);

}  // namespace nacre::simulator_farm
