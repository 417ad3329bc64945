#pragma once
// Message types <-> bytes. Encoding cannot read out of bounds, decoding is total.

#include <cassert>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "wire/counts.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {

/// The LCM encoding of `message` with a blank header, which is what cores exchange and what content hashes are taken
/// of. The counts of variable arrays are set from the arrays; arrays that share a count and differ in length throw
/// std::logic_error.
template <class T>
std::string encode(T message) {
  message.header = {};
  set_counts(message);
  std::string payload(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  const int size = message.encode(payload.data(), 0, static_cast<int>(payload.size()));
  assert(size >= 0);
  payload.resize(size);  // shorter when a text holds a zero byte: it ends there
  return payload;
}

/// Decodes a message with or without header. Total on hostile bytes: the structure is walked first (see
/// check_structure), so that nothing throws and no more memory is taken than a small multiple of the payload's size.
template <class T>
Result<T> decode_safe(std::string_view payload) {
  if (const Result<void> sound = check_structure(T::getTypeName(), payload); !sound)
    return tl::unexpected(sound.error());
  T message{};
  if (message.decode(payload.data(), 0, static_cast<int>(payload.size())) != static_cast<int>(payload.size())) {
    return fail("{}: the bytes do not have this type's fingerprint", T::getTypeName());
  }
  return message;
}

}  // namespace nacre::wire
