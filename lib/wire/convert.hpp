#pragma once
// Messages <-> bytes: write(value) -> payload with a blank header, which is what cores exchange and what content hashes
// are taken of; read<Message>(payload) -> Result. Everything that comes in is checked by the message's table:
// enumerations, ranges, lengths, design names.

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "wire/diagnosis_messages.hpp"
#include "wire/farm_messages.hpp"
#include "wire/field_bytes.hpp"
#include "wire/game_messages.hpp"
#include "wire/run_messages.hpp"

namespace nacre::wire {

/// Fingerprint and blank header: the beginning of every payload.
std::string begin_payload(std::int64_t fingerprint);

/// Where a payload of `type` goes on behind its header. The structure has been walked (check_structure), so that
/// nothing throws and no more memory is taken than a small multiple of the payload's size.
Result<std::string_view> behind_header(std::string_view type, std::int64_t fingerprint, std::string_view payload);

/// The error of a fault that FieldReader::get_struct() returned.
tl::unexpected<Error> refused(std::string_view type, std::string_view fault);

template <class Message>
std::string write(const Message& message) {
  std::string payload = begin_payload(Message::Wire::getHash());
  FieldWriter writer(payload);
  walk_fields(writer, message);
  return payload;
}

/// With or without header; never throws. The error names the type, the field, its value and what is allowed.
template <class Message>
Result<Message> read(std::string_view payload) {
  const char* type = Message::Wire::getTypeName();
  const Result<std::string_view> fields = behind_header(type, Message::Wire::getHash(), payload);
  if (!fields) return tl::unexpected(fields.error());
  FieldReader reader(*fields);
  Message message;
  const std::string fault = reader.get_struct(message);
  if (!fault.empty()) return refused(type, fault);
  return message;
}

}  // namespace nacre::wire
