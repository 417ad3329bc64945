#pragma once
// What a search asked for, batch by batch, so that after an interruption nothing is thought about twice.

#include <filesystem>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// A text file: a line that says which search it is of, then one line of keys per batch. Only ever appended to; a line
/// that was cut off by a crash is dropped.
class BatchLog {
 public:
  /// Opens or begins the file. Throws InputError naming the file: of another search (anything but the budget differs),
  /// not readable, not writable.
  BatchLog(std::filesystem::path path, const SearchSettings& settings);
  /// search.ask(); batches that the file holds are not thought about again.
  std::vector<pattern::Pattern> ask(Search& search);
  /// Batches of the file that have not been asked for yet.
  std::size_t left() const { return batches_.size() - next_; }

 private:
  std::filesystem::path path_;
  std::vector<std::vector<pattern::Pattern>> batches_;
  std::size_t next_ = 0;
};

}  // namespace nacre::explore
