#pragma once
// The header of a message, on raw bytes: every top-level type starts with its fingerprint and a header_t.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace nacre::wire {

inline constexpr std::size_t kMaximumName = 200;  ///< of a node and of a run, in bytes

/// header_t without its checksum, which belongs to the bytes.
struct Header {
  std::int64_t utime = 0;  ///< microseconds since 1970
  std::string node;
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  std::string run_id;
  bool operator==(const Header&) const = default;
};

/// A message taken apart.
struct Blanked {
  Header header;
  std::string payload;  ///< the same message with a default header
};

/// Bytes to send on `channel`: `payload` (blank header) with `header` and the checksum written in.
std::string stamp_header(std::string_view channel, std::string_view payload, const Header& header);

/// Takes the header off. The error says what is wrong: too short, names too long, checksum that does not fit (corrupt).
Result<Blanked> blank_header(std::string_view channel, std::string_view bytes);

/// Appends the default header.
void append_blank_header(std::string& bytes);

/// Where a message goes on behind its header; 0 when the header is damaged.
std::size_t end_of_header(std::string_view bytes);

/// The fingerprint of the type in the first eight bytes; 0 when there are fewer.
std::int64_t fingerprint_of(std::string_view bytes);

/// Identity of a message: content hash of channel and payload without header (design: messages are keyed by it).
std::string message_hash(std::string_view channel, std::string_view payload);

}  // namespace nacre::wire
