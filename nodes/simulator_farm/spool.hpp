#pragma once
// RUN/slurm: batches on their way to the cluster and back. All that has to survive the farm's process stands here, so a
// farm that is started again goes on with the tasks that the one before gave out.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"

namespace nacre::simulator_farm {

/// A task of a wave: job name and number.
using Task = std::pair<std::string, int>;

class Spool {
 public:
  /// Makes the folder. Throws InputError naming it.
  explicit Spool(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path batch_file(const std::string& batch) const { return folder_ / (batch + ".in"); }
  std::filesystem::path result(const std::string& batch) const { return folder_ / (batch + ".out"); }
  std::filesystem::path sign(const std::string& batch) const { return folder_ / (batch + ".sign"); }
  std::filesystem::path wave(const std::string& name) const { return folder_ / (name + ".wave"); }

  /// Writes a batch to disk; a batch that is there already stays as it is.
  void put(const std::string& batch, const std::string& bytes) const;
  /// Writes down which task simulates which batch.
  void put_wave(const std::string& name, const std::vector<std::string>& batches) const;
  /// The batch of a task. The error: no such wave or task.
  Result<std::string> batch_of(const std::string& wave, int task) const;

  /// Batches without end: names in order.
  std::vector<std::string> batches() const;
  /// Batches whose result has come.
  std::vector<std::string> results() const;
  /// Tasks that batches were given to, in waves that are not over.
  std::map<std::string, std::vector<Task>> tasks() const;

  /// The sign of life of a batch's task; empty when there is none.
  std::string read_sign(const std::string& batch) const;
  /// The last line that the task of a batch printed.
  std::string last_words(const std::vector<Task>& tasks) const;
  /// The batch is over: its files go, and those of waves that hold nothing else.
  void remove(const std::string& batch) const;

  /// Removes waves and signs of batches that are over.
  void tidy() const;

 private:
  std::vector<std::string> names_with(const std::string& ending) const;
  std::filesystem::path folder_;
};

}  // namespace nacre::simulator_farm
