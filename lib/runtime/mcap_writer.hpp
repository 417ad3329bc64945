#pragma once
// Files in the MCAP format (https://mcap.dev/spec), which viewers such as Foxglove open without knowing nacre: messages
// as JSON with a JSON Schema each, in compressed chunks that an index lists by time.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_aside.hpp"

namespace nacre::runtime {

/// One message for McapWriter.
struct McapMessage {
  int channel = 0;  ///< of McapWriter::add_channel()
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;      ///< since 1970, when it was recorded
  std::uint64_t publish_time_ns = 0;  ///< when it was said
  std::string_view json;
};

/// Writes one MCAP file from its beginning to its end. Takes the memory of one chunk (kChunkBytes and a message), and
/// of about 150 bytes for each chunk written. Everything throws InputError, NoSpace on a full disk.
class McapWriter {
 public:
  static constexpr std::size_t kChunkBytes = 1 << 20;  ///< a chunk that has as many, uncompressed, is written

  /// `library`: which program writes. Until finish() the file stands aside.
  McapWriter(const std::filesystem::path& file, std::string_view library);
  /// A channel of JSON messages; its number. Topics are unique; channels of one `schema_name` share the schema.
  int add_channel(std::string_view topic, const std::string& schema_name, std::string_view json_schema);
  void add_message(const McapMessage& message);
  /// Texts by name, for people and programs that look for `name`.
  void add_metadata(std::string_view name, const std::map<std::string, std::string>& texts);
  /// Writes index and end; the file is there now.
  void finish();

 private:
  /// Times and places of a channel's messages in the chunk that is being filled.
  using MessagePlaces = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    void include(std::uint64_t time_ns, bool is_first);
  };

  void write(std::string_view bytes);
  void write_chunk();
  std::string statistics() const;

  FileAside file_;
  std::uint64_t position_ = 0;
  std::uint32_t checksum_ = 0;  ///< CRC32 of all written so far
  std::string chunk_;           ///< records that wait
  Span chunk_span_;
  std::map<int, MessagePlaces> places_;
  Span span_;
  std::map<std::string, int> schema_ids_;
  std::map<int, std::uint64_t> message_counts_;  ///< by channel
  std::uint64_t message_count_ = 0;
  std::uint32_t chunk_count_ = 0, metadata_count_ = 0;
  // Records of the summary.
  std::string schemas_, channels_, chunk_indexes_, metadata_indexes_;
};

}  // namespace nacre::runtime
