// One JSON document per line. Contents that occur more than once are written down once and meant by number:
//   {"numbers":N,"are":[...]}                            a series of numbers; inside other lines {"numbers":N};
//   {"numbers":N,"single":[...]}                         ... all of which are single precision, in its shorter digits
//   {"message":N,"on":CHANNEL,"is":{...}}                a message without header; elsewhere {"message":N}
//   {"node":NODE,"hears":CHANNEL,"content":BYTES}        an input
//   {"node":NODE,"tick":UTIME}                           an input
//   {"node":NODE,"done":ID,"content":BYTES}              an input: the result of long work
//   {"node":NODE,"says":CHANNEL,"content":BYTES}         an output
//   {"node":NODE,"asks":ID,"kind":KIND,"content":BYTES}  an output: a request for long work
// BYTES is {"message":N}, {"packed":[BYTES,...]} (fields of runtime::pack), {"json":...}, {"text":...} or {"hex":...}.

#include "golden_game.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/expected.hpp"
#include "base/files.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "wire/channels.hpp"
#include "wire/from_json.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::golden {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLongSeries = 8;  // numbers; shorter ones are written out where they stand

const std::vector<std::string> kNodes = {"validation_agent", "proposal_agent", "analyser", "simulator_farm",
                                         "virtual_lab"};

std::string to_hex(const std::string& bytes) {
  std::string digits;
  for (const char byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return digits;
}

std::string from_hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

bool is_plain_text(const std::string& bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c == '\n' || (c >= 32 && c < 127); });
}

class Writer {
 public:
  explicit Writer(const fs::path& file) : out_(file, std::ios::binary) {
    if (!out_) throw InputError::format("{}: cannot be written", file.string());
  }

  void journal(const std::string& node, const fs::path& file, int most_records) {
    int records = 0;
    for (runtime::LogReader reader(file); const auto entry = reader.next();) {
      const bool is_input = entry->channel == runtime::kTickChannel || entry->channel == runtime::kWorkChannel ||
                            !entry->channel.starts_with('~');
      if (++records > most_records && is_input) return;  // all that the input before it caused has been written
      record(node, *entry);
    }
  }

 private:
  void record(const std::string& node, const runtime::LogRecord& record) {
    if (record.channel == runtime::kJournalChannel || record.channel == runtime::kAckedChannel) return;
    if (record.channel == runtime::kTickChannel) {
      line({{"node", node}, {"tick", std::stoll(expected(runtime::unpack(record.data)).at(0))}});
    } else if (record.channel == runtime::kWorkChannel) {
      const auto fields = expected(runtime::unpack(record.data));
      const Json content = content_of(fields.at(1));
      line({{"node", node}, {"done", fields.at(0)}, {"content", content}});
    } else if (record.channel == runtime::kComputeChannel) {
      const auto fields = expected(runtime::unpack(record.data));
      const Json content = content_of(fields.at(2));
      line({{"node", node}, {"asks", fields.at(0)}, {"kind", fields.at(1)}, {"content", content}});
    } else if (record.channel.starts_with(runtime::kOutPrefix)) {
      const Json content = content_of(record.data);
      line({{"node", node}, {"says", record.channel.substr(runtime::kOutPrefix.size())}, {"content", content}});
    } else {
      const Json content = content_of(expected(wire::blank_header(record.channel, record.data)).payload);
      line({{"node", node}, {"hears", record.channel}, {"content", content}});
    }
  }

  Json content_of(const std::string& bytes) {
    if (const auto number = message(bytes)) return {{"message", *number}};
    if (const auto fields = runtime::unpack(bytes)) {
      Json packed = Json::array();
      for (const std::string& field : *fields) packed.push_back(content_of(field));
      return {{"packed", packed}};
    }
    const Json value = Json::parse(bytes, nullptr, false);
    if (value.is_structured() && value.dump() == bytes) return {{"json", without_series(value)}};
    if (is_plain_text(bytes)) return {{"text", bytes}};
    return {{"hex", to_hex(bytes)}};
  }

  /// The number of a message, written down at its first use; nothing when the bytes are none.
  std::optional<int> message(const std::string& bytes) {
    if (const auto known = messages_.find(bytes); known != messages_.end()) return known->second;
    for (const wire::Channel& channel : wire::channels()) {
      if (wire::fingerprint_of(bytes) != channel.fingerprint) continue;
      Json value = expected(wire::to_json(channel.type, bytes));
      if (expected(wire::from_json(channel.type, value)) != bytes) return std::nullopt;
      value.erase("header");
      value = without_series(value);
      const int number = static_cast<int>(messages_.size()) + 1;
      messages_.emplace(bytes, number);
      line({{"message", number}, {"on", channel.name}, {"is", value}});
      return number;
    }
    return std::nullopt;
  }

  Json without_series(const Json& value) {
    const bool is_series = value.is_array() && value.size() >= kLongSeries &&
                           std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number_float(); });
    if (is_series) {
      const auto [known, is_new] = series_.emplace(value.dump(), static_cast<int>(series_.size()) + 1);
      if (is_new) series(known->second, value);
      return {{"numbers", known->second}};
    }
    if (!value.is_structured()) return value;
    Json shorter = value;
    for (auto& element : shorter) element = without_series(element);
    return shorter;
  }

  void series(int number, const Json& values) {
    std::vector<std::string> digits;
    for (const double value : values.get<std::vector<double>>()) {
      const float single = static_cast<float>(value);
      if (static_cast<double>(single) != value) return line({{"numbers", number}, {"are", values}});
      digits.push_back(fmt::format("{}", single));
    }
    text_line(fmt::format(R"({{"numbers":{},"single":[{}]}})", number, fmt::join(digits, ",")));
  }

  void line(const Json& document) { text_line(document.dump()); }

  void text_line(const std::string& text) {
    out_ << text << "\n";
    if (!out_.flush()) throw InputError("the golden game cannot be written: disk full?");
  }

  std::ofstream out_;
  std::map<std::string, int> messages_, series_;
};

class Reader {
 public:
  explicit Reader(fs::path run) : run_(std::move(run)) {}

  void line(const Json& line) {
    if (line.contains("are")) {
      series_[line.at("numbers").get<int>()] = line.at("are");
    } else if (line.contains("single")) {
      std::vector<double> values;
      for (const Json& value : line.at("single")) values.push_back(static_cast<double>(value.get<float>()));
      series_[line.at("numbers").get<int>()] = values;
    } else if (line.contains("is")) {
      messages_[line.at("message").get<int>()] = message(line.at("on").get<std::string>(), line.at("is"));
    } else if (line.contains("tick")) {
      append(line, runtime::kTickChannel, runtime::pack({std::to_string(line.at("tick").get<std::int64_t>())}));
    } else if (line.contains("done")) {
      append(line, runtime::kWorkChannel, runtime::pack({text_of(line, "done"), bytes_of(line.at("content"))}));
    } else if (line.contains("asks")) {
      append(line, runtime::kComputeChannel,
             runtime::pack({text_of(line, "asks"), text_of(line, "kind"), bytes_of(line.at("content"))}));
    } else if (line.contains("says")) {
      append(line, std::string(runtime::kOutPrefix) + text_of(line, "says"), bytes_of(line.at("content")));
    } else {
      const std::string channel = text_of(line, "hears");
      append(line, channel, wire::stamp_header(channel, bytes_of(line.at("content")), {0, "golden", 0, 0, "golden"}));
    }
  }

 private:
  static std::string text_of(const Json& line, const char* key) { return line.at(key).get<std::string>(); }

  std::string message(const std::string& channel, const Json& written) {
    static const Json kBlankHeader = {{"utime", 0}, {"node", ""},   {"epoch", 0},
                                      {"seq", 0},   {"run_id", ""}, {"checksum", 0}};
    const wire::Channel* known = wire::find_channel(channel);
    if (known == nullptr) throw InputError::format("no channel {}", channel);
    Json whole = with_series(written);
    whole["header"] = kBlankHeader;
    return expected(wire::from_json(known->type, whole));
  }

  std::string bytes_of(const Json& content) const {
    if (content.contains("message")) return messages_.at(content.at("message").get<int>());
    if (content.contains("json")) return with_series(content.at("json")).dump();
    if (content.contains("text")) return content.at("text").get<std::string>();
    if (content.contains("hex")) return from_hex(content.at("hex").get<std::string>());
    std::vector<std::string> fields;
    for (const Json& field : content.at("packed")) fields.push_back(bytes_of(field));
    return runtime::pack(fields);
  }

  Json with_series(const Json& value) const {
    if (value.is_object() && value.size() == 1 && value.contains("numbers")) {
      return series_.at(value.at("numbers").get<int>());
    }
    if (!value.is_structured()) return value;
    Json longer = value;
    for (auto& element : longer) element = with_series(element);
    return longer;
  }

  void append(const Json& line, std::string_view channel, const std::string& data) {
    const std::string node = text_of(line, "node");
    auto& journal = journals_[node];
    if (!journal) {
      fs::create_directories(run_ / "nodes" / node);
      journal = std::make_unique<runtime::LogWriter>(run_ / "nodes" / node / "journal.lcm");
    }
    if (const Result<void> added = journal->append(0, channel, data); !added) throw InputError(added.error().message);
  }

  fs::path run_;
  std::map<int, std::string> messages_;
  std::map<int, Json> series_;
  std::map<std::string, std::unique_ptr<runtime::LogWriter>> journals_;
};

void copy_scenario(const fs::path& from, const fs::path& to) {
  fs::create_directories(to / "inputs");
  fs::copy(from / "inputs", to / "inputs", fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  fs::copy_file(from / "scenario.toml", to / "scenario.toml", fs::copy_options::overwrite_existing);
}

}  // namespace

std::vector<std::string> nodes_of(const fs::path& run) {
  std::vector<std::string> nodes;
  std::copy_if(kNodes.begin(), kNodes.end(), std::back_inserter(nodes),
               [&](const std::string& node) { return fs::exists(run / "nodes" / node / "journal.lcm"); });
  return nodes;
}

void write_golden_game(const fs::path& run, const fs::path& folder, const std::map<std::string, int>& most_records) {
  copy_scenario(run, folder);
  Writer writer(folder / "game.jsonl");
  for (const std::string& node : nodes_of(run)) {
    const auto most = most_records.find(node);
    writer.journal(node, run / "nodes" / node / "journal.lcm",
                   most == most_records.end() ? std::numeric_limits<int>::max() : most->second);
  }
}

void unpack_golden_game(const fs::path& folder, const fs::path& run) {
  copy_scenario(folder, run);
  const fs::path file = folder / "game.jsonl";
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError::format("{}: cannot be read", file.string());
  Reader reader(run);
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    try {
      reader.line(Json::parse(text));
    } catch (const std::exception& problem) {
      throw InputError::format("{}:{}: {}", file.string(), number, problem.what());
    }
  }
}

}  // namespace nacre::golden
