#include "runtime/log_pieces.hpp"

#include <charconv>
#include <set>
#include <string>

#include "runtime/journal.hpp"

namespace nacre::runtime {
namespace {

namespace fs = std::filesystem;

/// The number of a later piece of `log` by the name of its file; 0 where it is none.
int number_of(const fs::path& file, const fs::path& log) {
  const std::string name = file.stem().string(), prefix = log.stem().string() + "-";
  if (file.extension() != log.extension() || !name.starts_with(prefix)) return 0;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [read, error] = std::from_chars(name.data() + prefix.size(), end, number);
  return error == std::errc() && read == end && number > 1 && file.filename() == piece_of(log, number).filename()
             ? number
             : 0;
}

}  // namespace

std::int64_t repeated_behind(const LogRecord& mark) {
  const auto fields = unpack(mark.data);
  std::int64_t count = 0;
  if (fields && fields->size() == 2)
    std::from_chars(fields->back().data(), fields->back().data() + fields->back().size(), count);
  return count;
}

fs::path piece_of(const fs::path& log, int number) {
  if (number == 1) return log;
  return log.parent_path() / fmt::format("{}-{}{}", log.stem().string(), number, log.extension().string());
}

std::vector<fs::path> pieces_of(const fs::path& log) {
  std::set<int> numbers;
  std::error_code unreadable;  // LogReader says what is wrong with the log itself
  const fs::path folder = log.has_parent_path() ? log.parent_path() : ".";
  for (const auto& entry : fs::directory_iterator(folder, unreadable))
    if (const int number = number_of(entry.path(), log)) numbers.insert(number);
  std::vector<fs::path> pieces = {log};
  for (const int number : numbers) {
    const fs::path expected = piece_of(log, static_cast<int>(pieces.size()) + 1);
    if (piece_of(log, number) != expected)
      throw InputError::format("{}: is missing, a piece of a log that goes on in {}", expected.string(),
                               piece_of(log, number).string());
    pieces.push_back(expected);
  }
  return pieces;
}

PiecesReader::PiecesReader(const fs::path& log)
    : pieces_(pieces_of(log)), reader_(std::make_unique<LogReader>(pieces_.front())) {}

std::optional<LogRecord> PiecesReader::next() {
  while (true) {
    auto record = reader_->next();
    if (!record) {
      if (piece_ + 1 == pieces_.size()) return std::nullopt;
      torn_bytes_ += reader_->end().torn_bytes;
      reader_ = std::make_unique<LogReader>(pieces_[++piece_]);
      repeated_until_ = -1;
    } else if (piece_ > 0 && record->channel == kPieceChannel) {
      repeated_until_ = record->number + repeated_behind(*record);
    } else if (record->number > repeated_until_) {
      return record;
    }
  }
}

LogEnd PiecesReader::end() const {
  const LogEnd end = reader_->end();
  return {end.sound_bytes, end.torn_bytes + torn_bytes_};
}

}  // namespace nacre::runtime
