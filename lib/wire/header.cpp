#include "wire/header.hpp"

#include <algorithm>

#include "base/big_endian.hpp"
#include "base/hash.hpp"

namespace nacre::wire {
namespace {

constexpr std::size_t kFingerprintSize = 8;
// Default header: utime, text "", epoch, seq, checksum, text "".
constexpr std::size_t kBlankHeaderSize = 8 + (4 + 1) + 8 + 8 + 8 + (4 + 1);

void append_text(std::string& bytes, std::string_view text) {
  append_big_endian(bytes, text.size() + 1, 4);
  bytes.append(text);
  bytes.push_back('\0');
}

/// Reads the members of a header one after the other; `sound` turns false at the first that does not fit.
struct HeaderReader {
  std::string_view bytes;
  std::size_t position = kFingerprintSize;
  bool sound = true;

  std::uint64_t integer(std::size_t size) {
    if (!sound || bytes.size() - position < size) {
      sound = false;
      return 0;
    }
    position += size;
    return read_big_endian(bytes.substr(position - size, size));
  }

  std::string text() {
    const std::uint64_t length = integer(4);
    sound = sound && length >= 1 && length <= kMaximumName + 1 && length <= bytes.size() - position;
    if (!sound) return {};
    const std::string_view whole = bytes.substr(position, length);
    sound = whole.find('\0') == length - 1;
    position += length;
    return std::string(whole.substr(0, length - 1));
  }
};

std::uint64_t checksum_of(std::string_view channel, std::string_view bytes_with_zero_checksum) {
  std::string all(channel);
  all.push_back('\0');
  all.append(bytes_with_zero_checksum);
  return content_hash64(all);
}

/// Reads over a header; the reader then stands behind it. `checksum_position`: where its checksum begins.
Header read_header(HeaderReader& reader, std::size_t& checksum_position) {
  Header header;
  header.utime = reader.integer(8);
  header.node = reader.text();
  header.epoch = reader.integer(8);
  header.seq = reader.integer(8);
  checksum_position = reader.position;
  reader.integer(8);
  header.run_id = reader.text();
  return header;
}

void write_checksum(std::string& bytes, std::size_t position, std::uint64_t checksum) {
  std::string field;
  append_big_endian(field, checksum, 8);
  bytes.replace(position, 8, field);
}

}  // namespace

std::string stamp_header(std::string_view channel, std::string_view payload, const Header& header) {
  std::string bytes;
  bytes.reserve(payload.size() + header.node.size() + header.run_id.size());
  bytes.append(payload.substr(0, kFingerprintSize));
  append_big_endian(bytes, static_cast<std::uint64_t>(header.utime), 8);
  append_text(bytes, header.node);
  append_big_endian(bytes, static_cast<std::uint64_t>(header.epoch), 8);
  append_big_endian(bytes, static_cast<std::uint64_t>(header.seq), 8);
  const std::size_t checksum_position = bytes.size();
  append_big_endian(bytes, 0, 8);
  append_text(bytes, header.run_id);
  bytes.append(payload.substr(std::min(payload.size(), kFingerprintSize + kBlankHeaderSize)));
  write_checksum(bytes, checksum_position, checksum_of(channel, bytes));
  return bytes;
}

Result<Blanked> blank_header(std::string_view channel, std::string_view bytes) {
  if (bytes.size() < kFingerprintSize) return fail("{} bytes are too short for a message", bytes.size());
  HeaderReader reader{bytes};
  Blanked blanked;
  std::size_t checksum_position = 0;
  blanked.header = read_header(reader, checksum_position);
  if (!reader.sound) return fail("the header is damaged");
  std::string zeroed(bytes);
  write_checksum(zeroed, checksum_position, 0);
  if (checksum_of(channel, zeroed) != read_big_endian(bytes.substr(checksum_position, 8)))
    return fail("the checksum does not fit the bytes");
  blanked.payload.assign(bytes.substr(0, kFingerprintSize));
  append_blank_header(blanked.payload);
  blanked.payload.append(bytes.substr(reader.position));
  return blanked;
}

void append_blank_header(std::string& bytes) {
  append_big_endian(bytes, 0, 8);
  append_text(bytes, "");
  for (int i = 0; i < 3; ++i) append_big_endian(bytes, 0, 8);
  append_text(bytes, "");
}

std::size_t end_of_header(std::string_view bytes) {
  HeaderReader reader{bytes};
  std::size_t checksum_position = 0;
  read_header(reader, checksum_position);
  return reader.sound ? reader.position : 0;
}

std::int64_t fingerprint_of(std::string_view bytes) {
  if (bytes.size() < kFingerprintSize) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kFingerprintSize; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

std::string message_hash(std::string_view channel, std::string_view payload) {
  std::string all(channel);
  all.push_back('\0');
  all.append(payload);
  return content_hash(all);
}

}  // namespace nacre::wire
