#include "runtime/reliable.hpp"

#include <algorithm>

#include "wire/channels.hpp"

namespace nacre::runtime {

Parcel parcel_of(const Message& message, std::int64_t place, const std::vector<std::string>& participants,
                 std::string_view self) {
  Parcel parcel;
  parcel.hash = wire::message_hash(message.channel, message.payload);
  parcel.place = place;
  parcel.size_bytes = message.payload.size();
  if (wire::is_response(message.channel)) parcel.request_id = wire::request_id_of(message.channel, message.payload);
  parcel.receivers =
      wire::receivers_of(*wire::find_channel(message.channel), message.payload, participants, std::string(self));
  return parcel;
}

Outbox::Delivery* Outbox::OfferedMessage::to(std::string_view node) {
  const auto found = std::ranges::find_if(deliveries, [&](const Delivery& each) { return each.to->node == node; });
  return found == deliveries.end() ? nullptr : &*found;
}

bool Outbox::OfferedMessage::is_waiting() const { return !std::ranges::all_of(deliveries, &Delivery::acknowledged); }

Outbox::Peer& Outbox::peer(const std::string& node) {
  Peer& peer = peers_[node];
  peer.node = node;
  return peer;
}

void Outbox::offer(const Parcel& parcel) {
  const auto [position, is_new] = entries_.try_emplace(parcel.hash);
  if (!is_new) return;
  OfferedMessage& entry = position->second;
  entry.place = parcel.place;
  entry.size_bytes = parcel.size_bytes;
  entry.request_id = parcel.request_id;
  entry.order = next_order_++;
  entry.deliveries.reserve(parcel.receivers.size());
  for (const std::string& node : parcel.receivers) entry.deliveries.push_back({&peer(node)});
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
  Delivery* delivery = entry.to(node);
  if (!delivery || delivery->acknowledged) return false;
  delivery->acknowledged = true;
  delivery->epoch = epoch;
  delivery->journal = journal;
  if (delivery->to->journal != journal) delivery->to->unchecked = true;
  if (!entry.is_waiting()) active_.erase(entry.order);
  return true;
}

void Outbox::saw(const std::string& node, std::int64_t epoch, std::int64_t journal) {
  Peer& seen = peer(node);
  const bool restarted = seen.epoch != epoch;
  const bool check = seen.journal != journal || seen.unchecked;
  seen = {node, epoch, journal, false};
  if (!restarted && !check) return;
  for (auto& [hash, entry] : entries_) {
    Delivery* delivery = entry.to(node);
    if (!delivery) continue;
    const bool lost = delivery->acknowledged && delivery->journal != journal;
    if (lost) delivery->acknowledged = false;
    if (lost || (restarted && !delivery->acknowledged)) restart(entry);
  }
}

void Outbox::respond_again(const std::string& request_id, const std::string& node, std::int64_t epoch) {
  for (auto& [hash, entry] : entries_) {
    if (entry.request_id != request_id) continue;
    Delivery* delivery = entry.to(node);
    if (!delivery || !delivery->acknowledged || delivery->epoch == epoch) continue;
    delivery->acknowledged = false;
    restart(entry);
  }
}

/// The entries that may be under way now: each receiver has a window of its own, so that one that is down does not hold
/// up the others. Those that do not fit wait in order.
std::vector<Outbox::OfferedMessage*> Outbox::admitted() const {
  std::vector<OfferedMessage*> entries;
  std::map<const Peer*, std::size_t> in_flight;
  for (const auto& [order, entry] : active_) {
    const auto has_room = [&](const Delivery& delivery) {
      if (delivery.acknowledged) return false;
      const std::size_t bytes = in_flight[delivery.to];
      return bytes == 0 || bytes + entry->size_bytes <= settings_.window_bytes;
    };
    if (!entry->deliveries.empty() && std::ranges::none_of(entry->deliveries, has_room)) continue;
    for (const Delivery& each : entry->deliveries)
      if (!each.acknowledged) in_flight[each.to] += entry->size_bytes;
    entries.push_back(entry);
  }
  return entries;
}

std::vector<std::int64_t> Outbox::due(std::int64_t now_us) {
  std::vector<std::int64_t> places;
  for (OfferedMessage* entry : admitted()) {
    if (entry->next_us > now_us) continue;
    if (entry->sent) ++retries_;
    entry->sent = true;
    places.push_back(entry->place);
    entry->interval_us =
        entry->interval_us == 0 ? settings_.first_retry_us : std::min(2 * entry->interval_us, settings_.last_retry_us);
    entry->next_us = now_us + entry->interval_us;
    if (entry->deliveries.empty()) active_.erase(entry->order);
  }
  return places;
}

std::optional<std::int64_t> Outbox::next_due() const {
  std::optional<std::int64_t> earliest;
  for (const OfferedMessage* entry : admitted()) {
    if (!earliest || entry->next_us < *earliest) earliest = entry->next_us;
  }
  return earliest;
}

std::set<std::string> Outbox::waiting_for(const std::string& hash) const {
  std::set<std::string> nodes;
  const auto found = entries_.find(hash);
  if (found == entries_.end()) return nodes;
  for (const Delivery& each : found->second.deliveries)
    if (!each.acknowledged) nodes.insert(each.to->node);
  return nodes;
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
