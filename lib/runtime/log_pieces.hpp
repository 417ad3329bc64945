#pragma once
// A log in pieces: run.lcm, run-2.lcm, run-3.lcm. A later piece begins with the latest state, so that it can be played
// alone; read together they are one log that repeats nothing.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "runtime/log_file.hpp"

namespace nacre::runtime {

/// The first record of a later piece: its number, and how many records behind it repeat the state.
inline constexpr std::string_view kPieceChannel = "~piece";

/// How many records behind such a mark repeat the state; 0 where it is garbled.
std::int64_t repeated_behind(const LogRecord& mark);

/// File of the piece `number` (1: the log itself).
std::filesystem::path piece_of(const std::filesystem::path& log, int number);

/// The log and its later pieces. Throws InputError where one between them is missing.
std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& log);

/// Reads a log with its later pieces as LogReader reads a file; of a later piece given by name that alone.
class PiecesReader {
 public:
  /// Throws InputError: no log, or a piece is missing.
  explicit PiecesReader(const std::filesystem::path& log);
  /// The next record, without marks and repetitions; nothing at the end. Throws InputError as LogReader.
  std::optional<LogRecord> next();
  void resync() { reader_->resync(); }
  /// Of the last piece; torn bytes of all.
  LogEnd end() const;
  /// The piece that is being read.
  const std::filesystem::path& path() const { return pieces_[piece_]; }

 private:
  std::vector<std::filesystem::path> pieces_;
  std::size_t piece_ = 0;
  std::unique_ptr<LogReader> reader_;
  std::int64_t repeated_until_ = -1;  ///< number of the last record of this piece that repeats
  std::int64_t torn_bytes_ = 0;       ///< of the pieces before
};

}  // namespace nacre::runtime
