#pragma once
// A reader of MCAP files written from the format's specification (https://mcap.dev/spec), apart from the writer: it
// reads from the beginning to the end, then holds every index, count and checksum against what it has read.

#include <zlib.h>
#include <zstd.h>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace nacre::mcap {

/// Reads fields one after the other; throws std::runtime_error beyond the end.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t number(std::size_t size) {
    const std::string_view bytes = take(size);
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
    return value;
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a field ends behind its record");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  std::string text() { return std::string(take(number(4))); }
  Fields list() { return Fields(take(number(4))); }
  std::string_view rest() { return take(bytes_.size()); }
  bool empty() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

struct Record {
  int opcode = 0;
  std::uint64_t start = 0, length = 0;  ///< in what it was read from, with opcode and length
  std::string_view content = {};
};

struct Channel {
  std::string topic, schema_name, schema = {};
};

struct Message {
  std::string topic;
  std::uint64_t sequence = 0, log_time_ns = 0, publish_time_ns = 0;
  std::string data = {};
};

struct File {
  std::string library;
  std::map<std::string, Channel> channels;  ///< by topic
  std::vector<Message> messages;            ///< in the order of the file
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::size_t chunks = 0;
  std::vector<std::string> faults;  ///< what contradicts the specification or itself; empty for a sound file
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  File read() {
    try {
      read_data();
      read_summary();
    } catch (const std::runtime_error& error) {
      fault(error.what());
    }
    return std::move(file_);
  }

 private:
  static constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
  struct Chunk {
    Record record;
    std::uint64_t first_ns = 0, last_ns = 0, compressed = 0, uncompressed = 0;
    std::map<std::uint64_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> messages =
        {};                                               ///< time, offset by channel
    std::map<std::uint64_t, std::uint64_t> indexes = {};  ///< place by channel
    std::uint64_t index_length = 0;
  };

  void fault(std::string what) { file_.faults.push_back(std::move(what)); }
  void expect(bool holds, const char* what) {
    if (!holds) fault(what);
  }
  static std::uint64_t crc(std::string_view bytes) {
    return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  }

  static Record record_at(std::string_view bytes, std::uint64_t start) {
    if (start > bytes.size()) throw std::runtime_error("a record is said to start behind the end");
    Fields fields(bytes.substr(start));
    Record record{.opcode = static_cast<int>(fields.number(1)), .start = start};
    const std::uint64_t size = fields.number(8);
    record.content = fields.take(size);
    record.length = 9 + size;
    return record;
  }

  void read_data() {
    if (bytes_.size() < 16 || !bytes_.starts_with(kMagic) || !bytes_.ends_with(kMagic))
      throw std::runtime_error("the magic bytes are missing");
    bytes_.remove_suffix(kMagic.size());
    std::uint64_t position = kMagic.size();
    bool is_first = true;
    while (true) {
      const Record record = record_at(bytes_, position);
      expect((record.opcode == 0x01) == is_first, "the header must be the first record, and no other");
      is_first = false;
      position += record.length;
      if (record.opcode == 0x0F) {
        const std::uint64_t kept = Fields(record.content).number(4);
        expect(kept != 0 && kept == crc(bytes_.substr(0, record.start)), "the CRC of the data does not fit");
        break;
      }
      take_data(record);
    }
    summary_start_ = position;
    for (const Chunk& chunk : chunks_)
      expect(chunk.indexes.size() == chunk.messages.size(), "a message index is missing");
  }

  void take_data(const Record& record) {
    Fields fields(record.content);
    if (record.opcode == 0x01) {
      fields.text();
      file_.library = fields.text();
    } else if (record.opcode == 0x06) {
      take_chunk(record);
    } else if (record.opcode == 0x07) {
      take_message_index(record);
    } else if (record.opcode == 0x0C) {
      const std::string name = fields.text();
      for (Fields map = fields.list(); !map.empty();) {
        const std::string key = map.text();
        expect(file_.metadata[name].emplace(key, map.text()).second, "a key stands twice");
      }
      metadata_[record.start] = {record.length, name};
    } else {
      take_definition(record);
    }
  }

  void take_definition(const Record& record) {
    Fields fields(record.content);
    const std::uint64_t id = fields.number(2);
    auto& known = record.opcode == 0x03 ? schemas_ : channels_;
    if (record.opcode != 0x03 && record.opcode != 0x04)
      throw std::runtime_error(fmt::format("opcode {}", record.opcode));
    const auto [place, is_new] = known.emplace(id, record.content);
    expect(place->second == record.content, "two definitions of one id differ");
    if (record.opcode == 0x03) {
      expect(id != 0, "a schema's id is 0");
    } else if (is_new) {
      take_channel(id, fields);
    }
  }

  void take_channel(std::uint64_t id, Fields fields) {
    const std::uint64_t schema_id = fields.number(2);
    if (!schemas_.contains(schema_id)) throw std::runtime_error("a channel comes before its schema");
    Fields schema(schemas_[schema_id]);
    schema.number(2);
    Channel channel{.topic = fields.text(), .schema_name = schema.text()};
    expect(fields.text() == "json", "messages are not json");
    expect(schema.text() == "jsonschema", "the schema is no jsonschema");
    channel.schema = schema.text();
    topics_[id] = channel.topic;
    expect(file_.channels.emplace(channel.topic, channel).second, "a topic stands twice");
  }

  void take_chunk(const Record& record) {
    Fields fields(record.content);
    Chunk chunk{.record = record, .first_ns = fields.number(8), .last_ns = fields.number(8)};
    chunk.uncompressed = fields.number(8);
    const std::uint64_t kept = fields.number(4);
    expect(fields.text() == "zstd", "a chunk is not compressed by zstd");
    chunk.compressed = fields.number(8);
    const std::string_view packed = fields.take(chunk.compressed);
    expect(fields.empty(), "a chunk goes on behind its records");
    constexpr std::uint64_t kLargest = 1 << 26;
    if (chunk.uncompressed > kLargest) throw std::runtime_error("a chunk is too large");
    std::string records(chunk.uncompressed, '\0');
    const std::size_t size = ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) || size != records.size()) throw std::runtime_error("a chunk cannot be decompressed");
    expect(kept != 0 && kept == crc(records), "the CRC of a chunk does not fit");
    for (std::uint64_t position = 0; position < records.size();) {
      const Record inner = record_at(records, position);
      position += inner.length;
      inner.opcode == 0x05 ? take_message(inner, chunk) : take_definition(inner);
    }
    expect_span(chunk);
    chunks_.push_back(chunk);
    ++file_.chunks;
  }

  void take_message(const Record& record, Chunk& chunk) {
    Fields fields(record.content);
    const std::uint64_t channel = fields.number(2);
    if (!topics_.contains(channel)) throw std::runtime_error("a message comes before its channel");
    Message message{.topic = topics_[channel], .sequence = fields.number(4)};
    message.log_time_ns = fields.number(8);
    message.publish_time_ns = fields.number(8);
    message.data = std::string(fields.rest());
    chunk.messages[channel].emplace_back(message.log_time_ns, record.start);
    ++counts_[channel];
    file_.messages.push_back(std::move(message));
  }

  void expect_span(const Chunk& chunk) {
    std::uint64_t first = 0, last = 0;
    bool is_first = true;
    for (const auto& [channel, messages] : chunk.messages)
      for (const auto& [time, offset] : messages) {
        first = is_first ? time : std::min(first, time);
        last = is_first ? time : std::max(last, time);
        is_first = false;
      }
    expect(chunk.first_ns == first && chunk.last_ns == last, "the times of a chunk are not those of its messages");
  }

  void take_message_index(const Record& record) {
    if (chunks_.empty()) throw std::runtime_error("a message index comes before a chunk");
    Chunk& chunk = chunks_.back();
    expect(record.start == chunk.record.start + chunk.record.length + chunk.index_length,
           "a message index does not follow its chunk");
    Fields fields(record.content);
    const std::uint64_t channel = fields.number(2);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;
    for (Fields list = fields.list(); !list.empty();) {
      const std::uint64_t time = list.number(8);
      entries.emplace_back(time, list.number(8));
    }
    expect(entries == chunk.messages[channel], "a message index does not point at the messages");
    expect(chunk.indexes.emplace(channel, record.start).second, "a channel has two message indexes");
    chunk.index_length += record.length;
  }

  void read_summary() {
    const Record footer = record_at(bytes_, bytes_.size() - 29);
    if (footer.opcode != 0x02) throw std::runtime_error("the footer is missing");
    Fields fields(footer.content);
    expect(fields.number(8) == summary_start_, "the footer does not point at the summary");
    const std::uint64_t offsets_start = fields.number(8), kept = fields.number(4);
    expect(kept != 0 && kept == crc(bytes_.substr(summary_start_, footer.start + 25 - summary_start_)),
           "the CRC of the summary does not fit");
    std::map<int, std::pair<std::uint64_t, std::uint64_t>> groups;  // start, length
    std::map<std::uint64_t, std::string> schemas, channels;
    std::size_t chunk = 0, metadata = 0;
    for (std::uint64_t position = summary_start_; position < offsets_start;) {
      const Record record = record_at(bytes_, position);
      const auto [group, is_new] = groups.try_emplace(record.opcode, position, 0);
      expect(is_new || group->second.first + group->second.second == position, "the summary is not grouped");
      group->second.second += record.length;
      position += record.length;
      if (record.opcode == 0x03)
        schemas[Fields(record.content).number(2)] = record.content;
      else if (record.opcode == 0x04)
        channels[Fields(record.content).number(2)] = record.content;
      else if (record.opcode == 0x08)
        expect_chunk(record, chunk++);
      else if (record.opcode == 0x0B)
        expect_statistics(record);
      else if (record.opcode == 0x0D)
        expect_metadata(record), ++metadata;
      else
        fault(fmt::format("opcode {} in the summary", record.opcode));
    }
    expect(schemas == schemas_ && channels == channels_, "the summary repeats other schemas or channels");
    expect(chunk == chunks_.size() && metadata == metadata_.size(), "the summary does not list all");
    expect(groups.contains(0x0B), "there are no statistics");
    for (std::uint64_t position = offsets_start; position < footer.start;) {
      const Record record = record_at(bytes_, position);
      position += record.length;
      Fields offset(record.content);
      const auto group = groups.extract(static_cast<int>(offset.number(1)));
      if (group.empty()) throw std::runtime_error("a summary offset of no group");
      const std::uint64_t start = offset.number(8), length = offset.number(8);
      expect(record.opcode == 0x0E && group.mapped() == std::pair(start, length), "a summary offset points elsewhere");
    }
    expect(groups.empty(), "a group has no summary offset");
  }

  void expect_chunk(const Record& record, std::size_t index) {
    if (index >= chunks_.size()) throw std::runtime_error("the index lists more chunks than there are");
    const Chunk& chunk = chunks_[index];
    Fields fields(record.content);
    expect(fields.number(8) == chunk.first_ns && fields.number(8) == chunk.last_ns, "times of an indexed chunk");
    expect(fields.number(8) == chunk.record.start && fields.number(8) == chunk.record.length, "place of a chunk");
    std::map<std::uint64_t, std::uint64_t> indexes = {};
    for (Fields map = fields.list(); !map.empty();) {
      const std::uint64_t channel = map.number(2);
      indexes[channel] = map.number(8);
    }
    expect(indexes == chunk.indexes, "places of message indexes");
    expect(fields.number(8) == chunk.index_length && fields.text() == "zstd", "length of message indexes");
    expect(fields.number(8) == chunk.compressed && fields.number(8) == chunk.uncompressed, "sizes of a chunk");
  }

  void expect_statistics(const Record& record) {
    Fields fields(record.content);
    expect(fields.number(8) == file_.messages.size(), "number of messages");
    expect(fields.number(2) == schemas_.size() && fields.number(4) == channels_.size(), "number of schemas, channels");
    expect(fields.number(4) == 0 && fields.number(4) == metadata_.size(), "number of attachments, metadata");
    expect(fields.number(4) == chunks_.size(), "number of chunks");
    std::uint64_t first = file_.messages.empty() ? 0 : file_.messages.front().log_time_ns, last = first;
    for (const Message& message : file_.messages) {
      first = std::min(first, message.log_time_ns);
      last = std::max(last, message.log_time_ns);
    }
    expect(fields.number(8) == first && fields.number(8) == last, "times of the file");
    std::map<std::uint64_t, std::uint64_t> counts;
    for (Fields map = fields.list(); !map.empty();) {
      const std::uint64_t channel = map.number(2);
      if (const std::uint64_t count = map.number(8); count > 0) counts[channel] = count;
    }
    expect(counts == counts_, "numbers of messages by channel");
  }

  void expect_metadata(const Record& record) {
    Fields fields(record.content);
    const std::uint64_t start = fields.number(8), length = fields.number(8);
    const auto place = metadata_.find(start);
    expect(place != metadata_.end() && place->second == std::pair(length, fields.text()), "place of metadata");
  }

  std::string_view bytes_;
  File file_;
  std::uint64_t summary_start_ = 0;
  std::map<std::uint64_t, std::string> schemas_, channels_, topics_;  // by id; the first two as they stand
  std::map<std::uint64_t, std::uint64_t> counts_;
  std::vector<Chunk> chunks_;
  std::map<std::uint64_t, std::pair<std::uint64_t, std::string>> metadata_;  // length, name by place
};

inline File read(std::string_view bytes) { return Reader(bytes).read(); }

}  // namespace nacre::mcap
