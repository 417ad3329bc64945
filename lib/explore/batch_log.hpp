#pragma once
// The record of a search, batch by batch, so that after an interruption no batch is computed twice.

#include <filesystem>
#include <string>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// A text file: a line that identifies the search, then one line of keys per batch. A line that was cut off by a crash
/// is dropped; a last batch that a smaller budget cut short is filled up, or left as it is by model-based searches
/// (Search::batch_request), which go on after it.
class BatchLog {
 public:
  /// Opens or begins the file of a search on a `model` (any text that identifies it). Throws InputError naming
  /// the file: of another search (anything but the budget differs), not readable, not writable.
  BatchLog(std::filesystem::path path, const SearchSettings& settings, const std::string& model = "");
  /// search.ask(); batches that the file holds are not computed again.
  std::vector<pattern::Pattern> ask(Search& search);
  /// Batches of the file that have not been asked for yet.
  std::size_t left() const { return batches_.size() - next_; }

 private:
  void fill_up(const std::vector<pattern::Pattern>& batch);

  std::filesystem::path path_;
  std::string identity_;  ///< the first line
  std::vector<std::vector<pattern::Pattern>> batches_;
  std::size_t next_ = 0;
};

}  // namespace nacre::explore
