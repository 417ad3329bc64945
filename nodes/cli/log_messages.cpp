#include "log_messages.hpp"

#include <fmt/format.h>

#include "runtime/journal.hpp"
#include "wire/header.hpp"
#include "wire/message_json.hpp"

namespace nacre::cli {
namespace {

/// A hostile log may name any number of channels.
constexpr std::size_t kMostUnreadChannels = 64;

/// A channel's name for people: what is no ASCII letter, digit or sign becomes `?`.
std::string printable(std::string name) {
  for (char& letter : name)
    if (letter < 33 || letter > 126) letter = '?';
  return name;
}

}  // namespace

std::map<std::string, std::string> to_texts(const Losses& losses) {
  std::map<std::string, std::string> texts = {{"records", std::to_string(losses.records)},
                                              {"messages", std::to_string(losses.messages)},
                                              {"own_records", std::to_string(losses.own_records)},
                                              {"damaged_places", std::to_string(losses.damaged_places)},
                                              {"torn_bytes", std::to_string(losses.torn_bytes)}};
  if (losses.never_recorded) texts["never_recorded"] = std::to_string(*losses.never_recorded);
  std::int64_t unread = 0;
  for (const auto& [channel, count] : losses.unread) {
    unread += count;
    texts["unread/" + channel] = std::to_string(count);
    texts["unread/" + channel + "/first"] = losses.why.at(channel);
  }
  texts["unread"] = std::to_string(unread);
  for (const auto& [counter, count] : losses.by_node) texts["node/" + counter] = std::to_string(count);
  return texts;
}

std::optional<LogMessage> LogMessages::next() {
  while (const auto record = reader_.next()) {
    ++losses_.records;
    const bool is_sent = record->channel.starts_with(runtime::kOutPrefix);
    is_journal_ = is_journal_ || (record->channel.starts_with('~') && record->channel != runtime::kPieceChannel);
    if (!is_sent && record->channel.starts_with('~')) {
      ++losses_.own_records;
      continue;
    }
    Result<LogMessage> message = decoded(*record);
    if (!message) {
      const std::string channel = is_sent ? record->channel.substr(runtime::kOutPrefix.size()) : record->channel;
      note_unread(printable(channel), *record, message.error().message);
      continue;
    }
    ++losses_.messages;
    note_status(*message);
    return std::move(*message);
  }
  note_end();
  return std::nullopt;
}

Result<LogMessage> LogMessages::decoded(const runtime::LogRecord& record) {
  const bool is_sent = record.channel.starts_with(runtime::kOutPrefix);
  const std::string name = is_sent ? record.channel.substr(runtime::kOutPrefix.size()) : record.channel;
  LogMessage message;
  message.topic = is_sent ? "sent/" + name : name;
  message.channel = wire::find_channel(name);
  if (message.channel == nullptr) return fail("nacre has no such channel");
  message.logged_us = message.said_us = record.utime;
  message.sequence = record.number;
  message.content = nlohmann::ordered_json::object();
  if (!is_sent) {
    const auto blanked = wire::blank_header(record.channel, record.data);
    if (!blanked) return tl::unexpected(blanked.error());
    message.said_us = blanked->header.utime;
    message.sequence = blanked->header.seq;
    message.content["header"] = wire::json_of(blanked->header);
    sequences_.count(record.channel, blanked->header);
  }
  const auto fields = message.channel->to_json(record.data);
  if (!fields) return tl::unexpected(fields.error());
  message.content.update(*fields);
  return message;
}

void LogMessages::note_unread(const std::string& channel, const runtime::LogRecord& record, const std::string& why) {
  const bool is_one_of_many = losses_.unread.size() >= kMostUnreadChannels && !losses_.unread.contains(channel);
  const std::string name = is_one_of_many ? "others" : channel;
  ++losses_.unread[name];
  losses_.why.try_emplace(name, fmt::format("record at byte {}: {}", record.offset, why));
}

void LogMessages::note_status(const LogMessage& message) {
  if (message.topic != "STATUS") return;
  const auto node = message.content["header"]["node"].get<std::string>();
  for (const char* counter : {"lost", "rejected", "dropped"})
    losses_.by_node[fmt::format("{}/{}", node, counter)] = message.content[counter].get<std::int64_t>();
}

void LogMessages::note_end() {
  losses_.damaged_places = reader_.damaged_places();
  losses_.torn_bytes = reader_.torn_bytes();
  // A journal keeps each content once and no acknowledgement: gaps there are no losses.
  if (!is_journal_) losses_.never_recorded = sequences_.lost();
}

}  // namespace nacre::cli
