#pragma once
// The messages of a log, decoded, and what of it is no message that can be read.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "forgiving_reader.hpp"
#include "runtime/sequence.hpp"
#include "wire/channels.hpp"

namespace nacre::cli {

struct LogMessage {
  std::string topic;  ///< its channel; `sent/CHANNEL` for what the node of a journal said
  const wire::Channel* channel = nullptr;
  std::int64_t logged_us = 0;      ///< since 1970, when it was recorded
  std::int64_t said_us = 0;        ///< when it was said; as recorded where it has no header
  std::int64_t sequence = 0;       ///< of its header; else counted in the log
  nlohmann::ordered_json content;  ///< as channel->schema() says
};

/// What a log, or what is made of it, lacks.
struct Losses {
  std::int64_t records = 0;                    ///< whole ones in the log
  std::int64_t messages = 0;                   ///< decoded
  std::int64_t own_records = 0;                ///< of a journal: what the node kept for itself, no messages
  std::map<std::string, std::int64_t> unread;  ///< messages that cannot be decoded, by channel
  std::map<std::string, std::string> why;      ///< the first of each: its record and the reason
  std::optional<std::int64_t> never_recorded;  ///< gaps in the publishers' counting; nothing for a journal
  int damaged_places = 0;
  std::int64_t torn_bytes = 0;
  std::map<std::string, std::int64_t> by_node;  ///< `NODE/lost`, `NODE/rejected`, `NODE/dropped` of its last STATUS
  bool incomplete() const { return !unread.empty() || damaged_places > 0; }
};

/// The losses as texts by name, for metadata and tables.
std::map<std::string, std::string> to_texts(const Losses& losses);

class LogMessages {
 public:
  /// A bus log or a node's journal. Throws InputError.
  explicit LogMessages(const std::filesystem::path& log) : reader_(log) {}
  /// The next message that can be decoded; nothing at the end.
  std::optional<LogMessage> next();
  /// Whole at the end.
  const Losses& losses() const { return losses_; }

 private:
  Result<LogMessage> decoded(const runtime::LogRecord& record);
  void note_unread(const std::string& channel, const runtime::LogRecord& record, const std::string& why);
  void note_status(const LogMessage& message);
  void note_end();

  ForgivingReader reader_;
  runtime::SequenceCounter sequences_;
  bool is_journal_ = false;
  Losses losses_;
};

}  // namespace nacre::cli
