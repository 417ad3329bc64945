#pragma once
// A log as people read it, with its later pieces: damage is said, and what stands behind it is read all the same.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "runtime/log_pieces.hpp"

namespace nacre::cli {

class ForgivingReader {
 public:
  /// Throws InputError when `log` cannot be read, or is no log.
  explicit ForgivingReader(const std::filesystem::path& log);
  /// The next record; nothing at the end. Warns of damage and of a torn tail.
  std::optional<runtime::LogRecord> next();
  /// Places in the middle where something is missing.
  int damaged_places() const { return damaged_places_; }
  /// Behind the last whole record; known at the end.
  std::int64_t torn_bytes() const { return torn_bytes_; }

 private:
  void note_end();
  std::filesystem::path log_;
  runtime::PiecesReader reader_;
  int damaged_places_ = 0;
  std::int64_t torn_bytes_ = 0;
};

}  // namespace nacre::cli
