#include "wire/convert.hpp"

#include "base/big_endian.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {

std::string begin_payload(std::int64_t fingerprint) {
  std::string payload;
  append_big_endian(payload, static_cast<std::uint64_t>(fingerprint), 8);
  append_blank_header(payload);
  return payload;
}

Result<std::string_view> behind_header(std::string_view type, std::int64_t fingerprint, std::string_view payload) {
  if (const Result<void> sound = check_structure(type, payload); !sound) return tl::unexpected(sound.error());
  if (fingerprint_of(payload) != fingerprint) return fail("{}: the bytes do not have this type's fingerprint", type);
  const std::size_t end = end_of_header(payload);
  if (end == 0) return fail("{}: the header is damaged", type);
  return payload.substr(end);
}

tl::unexpected<Error> refused(std::string_view type, std::string_view fault) {
  return fail("{}: {}", type, fault.substr(fault.starts_with('.') ? 1 : 2));  // behind "." or ": "
}

}  // namespace nacre::wire
