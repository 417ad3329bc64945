#include "runtime/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace nacre::runtime {
namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::string_view kCompression = "zstd";
constexpr int kCompressionLevel = 3;

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Bytes as the format has them: whole numbers with the lowest byte first, texts and maps behind their length.
class Bytes {
 public:
  Bytes& number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<char>(value >> 8 * i & 0xff));
    return *this;
  }
  Bytes& u16(std::uint64_t value) { return number(value, 2); }
  Bytes& u32(std::uint64_t value) { return number(value, 4); }
  Bytes& u64(std::uint64_t value) { return number(value, 8); }
  Bytes& text(std::string_view text) { return u32(text.size()).raw(text); }
  Bytes& raw(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  const std::string& get() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, const Bytes& content) {
  return Bytes().number(static_cast<std::uint64_t>(opcode), 1).u64(content.get().size()).raw(content.get()).get();
}

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string compressed(const std::string& bytes) {
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size)) throw std::logic_error(fmt::format("zstd cannot compress: {}", ZSTD_getErrorName(size)));
  result.resize(size);
  return result;
}

/// Where the records of one kind stand in a summary that begins at `start`; nothing where there are none.
std::string summary_offset(Opcode group, std::uint64_t start, std::uint64_t length) {
  if (length == 0) return {};
  return record(Opcode::summary_offset, Bytes().number(static_cast<std::uint64_t>(group), 1).u64(start).u64(length));
}

}  // namespace

void McapWriter::Span::include(std::uint64_t time_ns, bool is_first) {
  first_ns = is_first ? time_ns : std::min(first_ns, time_ns);
  last_ns = is_first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(const std::filesystem::path& file, std::string_view library) : file_(file) {
  write(kMcapMagic);
  write(record(Opcode::header, Bytes().text("").text(library)));
}

void McapWriter::write(std::string_view bytes) {
  file_.append(bytes);
  position_ += bytes.size();
  checksum_ = crc_of(bytes, checksum_);
}

int McapWriter::add_channel(std::string_view topic, const std::string& schema_name, std::string_view json_schema) {
  const auto [schema, is_new] = schema_ids_.try_emplace(schema_name, static_cast<int>(schema_ids_.size()) + 1);
  const auto schema_id = static_cast<std::uint64_t>(schema->second);
  if (is_new) {
    const std::string bytes =
        record(Opcode::schema, Bytes().u16(schema_id).text(schema_name).text("jsonschema").text(json_schema));
    chunk_ += bytes;
    schemas_ += bytes;
  }
  const int id = message_counts_.size();
  message_counts_[id] = 0;
  const std::string bytes = record(
      Opcode::channel, Bytes().u16(static_cast<std::uint64_t>(id)).u16(schema_id).text(topic).text("json").u32(0));
  chunk_ += bytes;
  channels_ += bytes;
  return id;
}

void McapWriter::add_message(const McapMessage& message) {
  chunk_span_.include(message.log_time_ns, places_.empty());
  span_.include(message.log_time_ns, message_count_++ == 0);
  places_[message.channel].emplace_back(message.log_time_ns, chunk_.size());
  ++message_counts_.at(message.channel);
  chunk_ += record(Opcode::message, Bytes()
                                        .u16(static_cast<std::uint64_t>(message.channel))
                                        .u32(message.sequence)
                                        .u64(message.log_time_ns)
                                        .u64(message.publish_time_ns)
                                        .raw(message.json));
  if (chunk_.size() >= kChunkBytes) write_chunk();
}

/// The chunk, and behind it an index per channel.
void McapWriter::write_chunk() {
  if (chunk_.empty()) return;
  const std::string records = compressed(chunk_);
  const std::uint64_t chunk_start = position_;
  write(record(Opcode::chunk, Bytes()
                                  .u64(chunk_span_.first_ns)
                                  .u64(chunk_span_.last_ns)
                                  .u64(chunk_.size())
                                  .u32(crc_of(chunk_))
                                  .text(kCompression)
                                  .u64(records.size())
                                  .raw(records)));
  const std::uint64_t index_start = position_;
  Bytes index_places;
  for (const auto& [channel, places] : places_) {
    index_places.u16(static_cast<std::uint64_t>(channel)).u64(position_);
    Bytes entries;
    for (const auto& [time_ns, offset] : places) entries.u64(time_ns).u64(offset);
    write(record(Opcode::message_index, Bytes().u16(static_cast<std::uint64_t>(channel)).text(entries.get())));
  }
  chunk_indexes_ += record(Opcode::chunk_index, Bytes()
                                                    .u64(chunk_span_.first_ns)
                                                    .u64(chunk_span_.last_ns)
                                                    .u64(chunk_start)
                                                    .u64(index_start - chunk_start)
                                                    .text(index_places.get())
                                                    .u64(position_ - index_start)
                                                    .text(kCompression)
                                                    .u64(records.size())
                                                    .u64(chunk_.size()));
  ++chunk_count_;
  chunk_.clear();
  chunk_span_ = {};
  places_.clear();
}

void McapWriter::add_metadata(std::string_view name, const std::map<std::string, std::string>& texts) {
  write_chunk();
  Bytes entries;
  for (const auto& [key, text] : texts) entries.text(key).text(text);
  const std::string bytes = record(Opcode::metadata, Bytes().text(name).text(entries.get()));
  metadata_indexes_ += record(Opcode::metadata_index, Bytes().u64(position_).u64(bytes.size()).text(name));
  write(bytes);
  ++metadata_count_;
}

std::string McapWriter::statistics() const {
  Bytes counts;
  for (const auto& [channel, count] : message_counts_) counts.u16(static_cast<std::uint64_t>(channel)).u64(count);
  return record(Opcode::statistics, Bytes()
                                        .u64(message_count_)
                                        .u16(schema_ids_.size())
                                        .u32(message_counts_.size())
                                        .u32(0)  // attachments
                                        .u32(metadata_count_)
                                        .u32(chunk_count_)
                                        .u64(span_.first_ns)
                                        .u64(span_.last_ns)
                                        .text(counts.get()));
}

void McapWriter::finish() {
  write_chunk();
  write(record(Opcode::data_end, Bytes().u32(checksum_)));
  const std::uint64_t summary_start = position_;
  const std::string statistics_record = statistics();
  checksum_ = 0;  // from now on that of the summary
  std::string offsets;
  const auto write_group = [&](Opcode opcode, const std::string& records) {
    offsets += summary_offset(opcode, position_, records.size());
    write(records);
  };
  write_group(Opcode::schema, schemas_);
  write_group(Opcode::channel, channels_);
  write_group(Opcode::statistics, statistics_record);
  write_group(Opcode::chunk_index, chunk_indexes_);
  write_group(Opcode::metadata_index, metadata_indexes_);
  const std::uint64_t offsets_start = position_;
  write(offsets);
  // The footer's checksum covers its own opcode, length and offsets.
  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  write(Bytes()
            .number(static_cast<std::uint64_t>(Opcode::footer), 1)
            .u64(kFooterSize)
            .u64(summary_start)
            .u64(offsets_start)
            .get());
  write(Bytes().u32(checksum_).get());
  write(kMcapMagic);
  file_.keep();
}

}  // namespace nacre::runtime
