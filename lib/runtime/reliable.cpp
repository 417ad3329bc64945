#include "runtime/reliable.hpp"

#include <algorithm>

#include "wire/channels.hpp"

namespace nacre::runtime {

void Outbox::offer(const std::string& hash, Message message, const std::vector<std::string>& receivers) {
  const auto [position, is_new] = entries_.try_emplace(hash);
  if (!is_new) return;
  OfferedMessage& entry = position->second;
  if (wire::is_response(message.channel)) entry.request_id = wire::request_id_of(message.channel, message.payload);
  entry.message = std::move(message);
  entry.order = next_order_++;
  entry.receivers = receivers;
  entry.waiting = {receivers.begin(), receivers.end()};
  if (receivers.empty()) entry.send_once = true;
  restart(entry);
}

/// Makes an entry due at once, at the first interval again.
void Outbox::restart(OfferedMessage& entry) {
  entry.next_us = 0;
  entry.interval_us = 0;
  active_[entry.order] = &entry;
}

bool Outbox::acknowledge(const std::string& hash, const std::string& node, std::int64_t epoch, std::int64_t journal) {
  const auto found = entries_.find(hash);
  if (found == entries_.end()) return false;
  OfferedMessage& entry = found->second;
  if (entry.waiting.erase(node) == 0) return false;
  entry.acknowledged[node] = {epoch, journal};
  Peer& peer = peers_[node];
  if (peer.journal != journal) peer.unchecked = true;
  if (entry.waiting.empty()) active_.erase(entry.order);
  return true;
}

void Outbox::saw(const std::string& node, std::int64_t epoch, std::int64_t journal) {
  Peer& peer = peers_[node];
  const bool restarted = peer.epoch != epoch;
  const bool check = peer.journal != journal || peer.unchecked;
  peer = {epoch, journal, false};
  if (!restarted && !check) return;
  for (auto& [hash, entry] : entries_) {
    const auto acknowledged = entry.acknowledged.find(node);
    const bool lost = acknowledged != entry.acknowledged.end() && acknowledged->second.journal != journal;
    if (lost) {
      entry.acknowledged.erase(acknowledged);
      entry.waiting.insert(node);
    }
    if (lost || (restarted && entry.waiting.count(node))) restart(entry);
  }
}

void Outbox::respond_again(const std::string& request_id, const std::string& node, std::int64_t epoch) {
  for (auto& [hash, entry] : entries_) {
    if (entry.request_id != request_id || entry.waiting.count(node)) continue;
    const auto acknowledged = entry.acknowledged.find(node);
    if (acknowledged == entry.acknowledged.end() || acknowledged->second.epoch == epoch) continue;
    entry.waiting.insert(node);
    restart(entry);
  }
}

/// The entries that may be under way now: each receiver has a window of its own, so that one that is down does not hold
/// up the others. Those that do not fit wait in order.
std::vector<Outbox::OfferedMessage*> Outbox::admitted() const {
  std::vector<OfferedMessage*> entries;
  std::map<std::string_view, std::size_t> in_flight;
  for (const auto& [order, entry] : active_) {
    const std::size_t size = entry->message.payload.size();
    const auto has_room = [&](const std::string& node) {
      const std::size_t bytes = in_flight[node];
      return bytes == 0 || bytes + size <= settings_.window_bytes;
    };
    if (!entry->send_once && std::ranges::none_of(entry->waiting, has_room)) continue;
    for (const std::string& node : entry->waiting) in_flight[node] += size;
    entries.push_back(entry);
  }
  return entries;
}

std::vector<const Message*> Outbox::due(std::int64_t now_us) {
  std::vector<const Message*> messages;
  for (OfferedMessage* entry : admitted()) {
    if (entry->next_us > now_us) continue;
    if (entry->sent) ++retries_;
    entry->sent = true;
    messages.push_back(&entry->message);
    entry->interval_us =
        entry->interval_us == 0 ? settings_.first_retry_us : std::min(2 * entry->interval_us, settings_.last_retry_us);
    entry->next_us = now_us + entry->interval_us;
    if (entry->send_once) active_.erase(entry->order);
  }
  return messages;
}

std::optional<std::int64_t> Outbox::next_due() const {
  std::optional<std::int64_t> earliest;
  for (const OfferedMessage* entry : admitted()) {
    if (!earliest || entry->next_us < *earliest) earliest = entry->next_us;
  }
  return earliest;
}

std::set<std::string> Outbox::waiting_for(const std::string& hash) const {
  const auto found = entries_.find(hash);
  return found == entries_.end() ? std::set<std::string>{} : found->second.waiting;
}

void Inbox::owe(const std::string& hash, std::int64_t now_us) {
  if (!owed_set_.insert(hash).second) return;
  if (owed_.empty()) owed_since_us_ = now_us;
  owed_.push_back(hash);
}

std::vector<std::string> Inbox::due(std::int64_t now_us) {
  if (owed_.empty() || now_us < owed_since_us_ + settings_.ack_delay_us) return {};
  constexpr std::size_t kHashBytes = 37, kMostBytes = 1000 * kHashBytes;  // below a datagram
  std::vector<std::string> hashes;
  for (std::size_t bytes = 0; !owed_.empty(); owed_.pop_front()) {
    const std::string* refusal = refusal_of(owed_.front());
    bytes += kHashBytes + (refusal ? kHashBytes + refusal->size() + 5 : 0);
    if (bytes > kMostBytes) break;
    owed_set_.erase(owed_.front());
    hashes.push_back(std::move(owed_.front()));
  }
  return hashes;
}

const std::string* Inbox::refusal_of(const std::string& hash) const {
  const auto found = refusals_.find(hash);
  return found == refusals_.end() ? nullptr : &found->second;
}

std::optional<std::int64_t> Inbox::next_due() const {
  if (owed_.empty()) return std::nullopt;
  return owed_since_us_ + settings_.ack_delay_us;
}

}  // namespace nacre::runtime
