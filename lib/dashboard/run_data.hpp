#pragma once
// A run's database, read again only when it has changed.

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "store/run_record.hpp"

namespace nacre::dashboard {

class RunData {
 public:
  explicit RunData(std::filesystem::path run_folder) : database_(std::move(run_folder) / "run.db") {}

  /// Changes with every write of the analyser.
  std::string version() const;
  /// The record without its gamuts; empty before the analyser's first write. Throws InputError.
  std::shared_ptr<const store::RunRecord> record();
  std::shared_ptr<const store::RecordedGamut> gamut(int round);
  /// Patterns in the gamut of each round that has any.
  std::map<int, int> gamut_sizes();

 private:
  /// Reads the file again if it has changed. Gamuts of unchanged size are kept: a gamut only grows.
  void refresh();
  std::filesystem::path database_;
  std::mutex mutex_;
  std::string read_version_;
  std::shared_ptr<const store::RunRecord> record_ = std::make_shared<const store::RunRecord>();
  std::map<int, int> gamut_sizes_;
  std::map<int, std::shared_ptr<const store::RecordedGamut>> gamuts_;
};

}  // namespace nacre::dashboard
