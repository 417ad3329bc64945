#include "transcript.hpp"

#include <algorithm>
#include <functional>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/expected.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "golden_game.hpp"
#include "golden_nodes.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "wire/channels.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::golden {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kFew = 4;        // numbers, or structs that are named
constexpr std::size_t kLongText = 72;  // of a sentence, what is shown

/// With "#" for hashes of contents, which change with the last bit of a number; keys of patterns have 14 digits.
std::string without_hashes(const std::string& text) {
  static const std::regex kHash("#?[0-9a-f]{16,}");
  return std::regex_replace(text, kHash, "#");
}

std::string text_of_scalar(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  if (!value.is_string()) return value.dump();
  const std::string text = without_hashes(value.get<std::string>());
  return text.size() <= kLongText ? text : text.substr(0, kLongText) + "...";
}

/// Everything in it, to be hashed or, where it is short, shown.
std::string text_of(const Json& value) {
  if (!value.is_structured()) return text_of_scalar(value);
  std::string text;
  for (const Json& element : value) text += (text.empty() ? "" : " ") + text_of(element);
  return (value.is_array() ? "[" : "{") + text + (value.is_array() ? "]" : "}");
}

bool holds_scalars_alone(const Json& value) {
  return std::ranges::none_of(value, [](const Json& element) { return element.is_structured(); });
}

bool is_nothing(const Json& value) {
  if (value.is_structured()) return std::ranges::all_of(value, is_nothing);
  return value == 0 || value == false || value == "";
}

/// The first text of each of a few structs: of designs, effects and results their names.
std::string names_in(const Json& list) {
  if (list.size() > kFew) return "";
  std::string names;
  for (const Json& element : list) {
    const auto name = std::ranges::find_if(element, [](const Json& member) { return member.is_string(); });
    if (!element.is_object() || name == element.end()) return "";
    names += (names.empty() ? "" : " ") + text_of_scalar(*name);
  }
  return "{" + names + "}";
}

std::string text_of_field(const std::string& name, const Json& value) {
  if (!value.is_structured()) return name + "=" + text_of_scalar(value);
  const bool is_short = value.is_object() || value.size() <= kFew;
  if (is_short && holds_scalars_alone(value)) return name + "=" + text_of(value);
  const std::string hash = "#" + content_hash(text_of(value)).substr(0, 8);
  return value.is_object() ? name + hash : fmt::format("{}[{}]{}{}", name, value.size(), names_in(value), hash);
}

/// What a node hears, says, asks and gets, from its journal.
class Lines {
 public:
  explicit Lines(std::string node) : node_(std::move(node)) {}

  void message(std::string_view verb, std::string_view channel, const std::string& payload) {
    add(verb, line_of(channel, payload));
  }
  void add(std::string_view verb, const std::string& what) {
    lines_.push_back(fmt::format("{} {} {}", node_, verb, what));
  }
  void asks(const std::string& id, const std::string& kind) {
    add("asks", without_hashes(fmt::format("{} {}", kind, id)));
  }
  void says(const runtime::Outputs& outputs) {
    for (const runtime::Message& each : outputs.messages) message("says", each.channel, each.payload);
    for (const runtime::Compute& each : outputs.computes) asks(each.id, each.kind);
  }

  /// An input of the journal, added; nothing where the record is none.
  std::optional<runtime::Input> hear(const runtime::LogRecord& record) {
    if (record.channel == runtime::kTickChannel) {
      const std::string utime = expected(runtime::unpack(record.data)).at(0);
      add("tick", utime);
      return runtime::Tick{std::stoll(utime)};
    }
    if (record.channel == runtime::kWorkChannel) {
      const auto fields = expected(runtime::unpack(record.data));
      add("gets", without_hashes(fields.at(0)));
      return runtime::WorkDone{fields.at(0), fields.at(1)};
    }
    if (record.channel.starts_with('~')) return std::nullopt;
    const std::string payload = expected(wire::blank_header(record.channel, record.data)).payload;
    message("hears", record.channel, payload);
    return runtime::Message{record.channel, payload};
  }

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::string node_;
  std::vector<std::string> lines_;
};

void add_recorded_output(Lines& lines, const runtime::LogRecord& record) {
  if (record.channel.starts_with(runtime::kOutPrefix))
    lines.message("says", record.channel.substr(runtime::kOutPrefix.size()), record.data);
  if (record.channel != runtime::kComputeChannel) return;
  const auto fields = expected(runtime::unpack(record.data));
  lines.asks(fields.at(0), fields.at(1));
}

/// Lines of all nodes, each written by `write` from its journal.
std::vector<std::string> lines_of_nodes(
    const fs::path& run, const std::function<void(const std::string& node, runtime::LogReader&, Lines&)>& write) {
  std::vector<std::string> all;
  for (const std::string& node : nodes_of(run)) {
    Lines lines(node);
    runtime::LogReader reader(run / "nodes" / node / "journal.lcm");
    write(node, reader, lines);
    all.insert(all.end(), lines.lines().begin(), lines.lines().end());
  }
  return all;
}

/// lengths[i][k]: of the longest common part of a's lines from i on and b's from k on.
std::vector<std::vector<int>> common_lengths(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::vector<int>> lengths(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t k = b.size(); k-- > 0;)
      lengths[i][k] = a[i] == b[k] ? lengths[i + 1][k + 1] + 1 : std::max(lengths[i + 1][k], lengths[i][k + 1]);
  return lengths;
}

}  // namespace

std::string line_of(std::string_view channel, const std::string& payload) {
  const wire::Channel* known = wire::find_channel(channel);
  std::string line(channel);
  if (known == nullptr) return line + " (no channel of nacre's)";
  Json message = expected(wire::to_json(known->type, payload));
  message.erase("header");
  for (const auto& [name, value] : message.items()) {
    const bool is_count = name == "n" || name.starts_with("n_");  // stands at its list
    if (!is_count && !is_nothing(value)) line += " " + text_of_field(name, value);
  }
  return line;
}

std::vector<std::string> recorded_lines(const fs::path& run) {
  return lines_of_nodes(run, [](const std::string&, runtime::LogReader& reader, Lines& lines) {
    while (const auto record = reader.next())
      if (!lines.hear(*record)) add_recorded_output(lines, *record);
  });
}

std::vector<std::string> lines_of_now(const fs::path& run, const fs::path& scratch) {
  const game::Scenario scenario = game::read_scenario(run / "scenario.toml");
  return lines_of_nodes(run, [&](const std::string& node, runtime::LogReader& reader, Lines& lines) {
    const runtime::NodeProgram program = make_node(node, scenario, scratch / node);
    while (const auto record = reader.next())
      if (const auto input = lines.hear(*record)) lines.says(program.core->step(*input));
  });
}

std::string difference(const std::vector<std::string>& was, const std::vector<std::string>& now, int most) {
  const auto common = common_lengths(was, now);
  std::string text, before = "the beginning";
  int shown = 0;
  bool is_inside = false;
  const auto show = [&](char sign, const std::string& line) {
    if (++shown > most) return;
    if (!is_inside) text += "  " + before + "\n";
    is_inside = true;
    text += fmt::format("{} {}\n", sign, line);
  };
  for (std::size_t i = 0, k = 0; i < was.size() || k < now.size();) {
    if (i < was.size() && k < now.size() && was[i] == now[k]) {
      before = was[i];
      is_inside = false;
      ++i, ++k;
    } else if (k == now.size() || (i < was.size() && common[i + 1][k] >= common[i][k + 1])) {
      show('-', was[i++]);
    } else {
      show('+', now[k++]);
    }
  }
  if (shown > most) text += fmt::format("and {} lines more\n", shown - most);
  return text;
}

std::vector<std::string> read_transcript(const fs::path& folder) {
  std::vector<std::string> lines;
  std::istringstream text(read_file(folder / "transcript.txt"));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

void write_transcript(const std::vector<std::string>& lines, const fs::path& folder) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write_file_atomically(folder / "transcript.txt", text);
}

}  // namespace nacre::golden
