#include "runtime/fold.hpp"

#include <iterator>
#include <utility>

#include "runtime/content_difference.hpp"
#include "runtime/journal.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

std::string place(const LogRecord& record) {
  return fmt::format("record {} (byte {}, {})", record.number, record.offset, record.channel);
}

Result<std::vector<std::string>> fields_of(const LogRecord& record, std::size_t count) {
  Result<std::vector<std::string>> fields = unpack(record.data);
  if (!fields) return fail("{}: {}", place(record), fields.error().message);
  if (fields->size() != count) return fail("{}: {} fields, expected {}", place(record), fields->size(), count);
  return fields;
}

}  // namespace

Result<void> Fold::feed(const LogRecord& record) {
  if (record.channel.starts_with(kOutPrefix)) return output(record);
  if (record.channel == kComputeChannel) return compute(record);
  if (!record.channel.starts_with('~')) {
    const Result<wire::Blanked> blanked = wire::blank_header(record.channel, record.data);
    if (!blanked) return fail("{}: {}", place(record), blanked.error().message);
    const Message message{record.channel, blanked->payload};
    if (on_message_input) on_message_input(message);
    return input(record, message);
  }
  if (record.channel == kJournalChannel) {  // no input: read when the journal is opened
    const auto fields = unpack(record.data);
    if (!fields) return fail("{}: {}", place(record), fields.error().message);
    return {};
  }
  const std::size_t field_count = record.channel == kTickChannel ? 1 : record.channel == kAckedChannel ? 3 : 2;
  const auto fields = fields_of(record, field_count);
  if (!fields) return tl::unexpected(fields.error());
  if (record.channel == kTickChannel) return input(record, Tick{std::stoll(fields->at(0))});
  if (record.channel == kWorkChannel) return work_done(record, *fields);
  if (record.channel == kAckedChannel) {
    if (on_acknowledged) on_acknowledged(fields->at(0), fields->at(1), std::stoll(fields->at(2)));
    return {};
  }
  return fail("{}: a record of an unknown kind", place(record));
}

Result<void> Fold::input(const LogRecord& record, const Input& input) {
  if (!expected_messages_.empty()) {
    return fail("before {}: the core now also sends {}, which the journal does not hold", place(record),
                expected_messages_.front().channel);
  }
  if (!expected_computes_.empty()) {
    return fail("before {}: the core now also asks for the work {}, which the journal does not hold", place(record),
                expected_computes_.front().id);
  }
  ++inputs;
  Outputs now = core_.step(input);
  expected_messages_.assign(std::make_move_iterator(now.messages.begin()), std::make_move_iterator(now.messages.end()));
  expected_computes_.assign(std::make_move_iterator(now.computes.begin()), std::make_move_iterator(now.computes.end()));
  last_log_ = std::move(now.log);
  const auto* message = std::get_if<Message>(&input);
  if (message && !now.refusal.empty() && on_refused) on_refused(*message, now.refusal);
  return {};
}

Result<void> Fold::output(const LogRecord& record) {
  const std::string channel = record.channel.substr(kOutPrefix.size());
  if (expected_messages_.empty()) return fail("{}: the core no longer sends this", place(record));
  const Message now = std::move(expected_messages_.front());
  expected_messages_.pop_front();
  if (now.channel != channel) return fail("{}: the core now sends {} instead", place(record), now.channel);
  if (now.payload != record.data) {
    return fail("{}: recorded against now: {}", place(record), content_difference(record.data, now.payload));
  }
  ++outputs;
  if (on_output) on_output(now, record.offset);
  return {};
}

Result<void> Fold::compute(const LogRecord& record) {
  const auto fields = fields_of(record, 3);
  if (!fields) return tl::unexpected(fields.error());
  const std::string &id = fields->at(0), &kind = fields->at(1), &spec = fields->at(2);
  if (expected_computes_.empty()) return fail("{}: the core no longer asks for the work {}", place(record), id);
  const Compute now = std::move(expected_computes_.front());
  expected_computes_.pop_front();
  const std::string spec_now = journaled_spec(now);
  const bool is_same_work = now.id == id && now.kind == kind;
  if (!is_same_work || spec_now != spec) {
    return fail("{}: recorded the work {} ({}), now {} ({}){}", place(record), id, kind, now.id, now.kind,
                is_same_work ? ", whose spec differs: " + content_difference(spec, spec_now) : "");
  }
  ++computes;
  asked_index_[now.id] = asked_.size();
  asked_.push_back(now);
  return {};
}

Result<void> Fold::work_done(const LogRecord& record, const std::vector<std::string>& fields) {
  const auto asked = asked_index_.find(fields[0]);
  if (asked == asked_index_.end())
    return fail("{}: the result of work {} that nobody asked for", place(record), fields[0]);
  if (on_work_done) {
    const Result<void> agreed = on_work_done(asked_[asked->second], fields[1]);
    if (!agreed) return fail("{}: {}", place(record), agreed.error().message);
  }
  done_.insert(fields[0]);
  return input(record, WorkDone{fields[0], fields[1]});
}

Outputs Fold::take_unfinished() {
  Outputs unfinished;
  if (expected_messages_.empty() && expected_computes_.empty()) return unfinished;
  unfinished.messages.assign(std::make_move_iterator(expected_messages_.begin()),
                             std::make_move_iterator(expected_messages_.end()));
  unfinished.computes.assign(std::make_move_iterator(expected_computes_.begin()),
                             std::make_move_iterator(expected_computes_.end()));
  unfinished.log = std::move(last_log_);
  expected_messages_.clear();
  expected_computes_.clear();
  return unfinished;
}

std::vector<Compute> Fold::open_work() const {
  std::vector<Compute> open;
  for (const Compute& compute : asked_) {
    if (!done_.count(compute.id)) open.push_back(compute);
  }
  return open;
}

}  // namespace nacre::runtime
