#include "run/journal_messages.hpp"

#include <sys/stat.h>

#include <string_view>

#include "runtime/journal.hpp"
#include "wire/header.hpp"

namespace nacre::run {

JournalMessages::JournalMessages(const std::filesystem::path& run_folder, const std::string& node)
    : journal_(run_folder / "nodes" / node / "journal.lcm") {}

bool JournalMessages::begins_anew() const {
  struct stat status {};
  return ::stat(journal_.c_str(), &status) != 0 || status.st_ino != file_ || status.st_size < read_;
}

void JournalMessages::read(const Takers& received, const Takers& sent) {
  struct stat status {};
  if (::stat(journal_.c_str(), &status) != 0) return;
  if (begins_anew()) read_ = 0;
  file_ = status.st_ino;
  if (status.st_size == read_) return;
  runtime::LogReader reader(journal_, read_);
  while (const auto record = reader.next()) {
    std::string_view channel = record->channel;
    if (channel.starts_with(runtime::kOutPrefix)) {
      channel.remove_prefix(runtime::kOutPrefix.size());
      if (const auto taker = sent.find(channel); taker != sent.end()) taker->second(record->data);
    } else if (const auto taker = received.find(channel); taker != received.end()) {
      if (const auto blanked = wire::blank_header(channel, record->data)) taker->second(blanked->payload);
    }
  }
  read_ = reader.end().sound_bytes;
}

std::vector<std::string> received_by(const std::filesystem::path& run_folder, const std::string& node,
                                     const std::string& channel) {
  std::vector<std::string> payloads;
  JournalMessages(run_folder, node)
      .read({{channel, [&](const std::string& payload) { payloads.push_back(payload); }}}, {});
  return payloads;
}

std::vector<std::string> sent_by(const std::filesystem::path& run_folder, const std::string& node,
                                 const std::string& channel) {
  std::vector<std::string> payloads;
  JournalMessages(run_folder, node).read({}, {{channel, [&](const std::string& payload) {
                                                 payloads.push_back(payload);
                                               }}});
  return payloads;
}

}  // namespace nacre::run
