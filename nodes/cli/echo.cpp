// Part of the command line (command.hpp): nacre echo, messages as they pass, or as they stand in a log, one JSON line
// each.

#include <chrono>
#include <filesystem>
#include <limits>
#include <string>

#include "base/files.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "forgiving_reader.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "runtime/interrupts.hpp"
#include "runtime/journal.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::cli {
namespace {

struct EchoOptions {
  std::string channel;
  std::string run = "logs/latest";
  std::string log;
  std::int64_t count = std::numeric_limits<std::int64_t>::max();
};

/// The word for the number of a test or a fidelity; nothing for any other field.
std::optional<std::string_view> word_for(const std::string& field, const nlohmann::ordered_json& value) {
  if (!value.is_number_integer()) return std::nullopt;
  const auto code = value.get<std::int8_t>();
  if (field == "test") {
    if (const auto test = wire::test_kind_of_code(code)) return tester::to_string(*test);
  } else if (field == "fidelity") {
    if (const auto fidelity = wire::fidelity_of_code(code)) return tester::to_string(*fidelity);
  }
  return std::nullopt;
}

/// The message with words behind such numbers: "test":0,"test_name":"modulus".
nlohmann::ordered_json with_words(const nlohmann::ordered_json& message) {
  if (!message.is_structured()) return message;
  auto result = message.is_array() ? nlohmann::ordered_json::array() : nlohmann::ordered_json::object();
  for (const auto& [field, value] : message.items()) {
    if (message.is_array()) {
      result.push_back(with_words(value));
      continue;
    }
    result[field] = with_words(value);
    if (const auto word = word_for(field, value)) result[field + "_name"] = *word;
  }
  return result;
}

/// A message as JSON; why it cannot be read where it cannot.
nlohmann::ordered_json to_json(std::string_view channel, std::string_view payload) {
  const wire::Channel* known = wire::find_channel(channel);
  if (known == nullptr) return {{"error", fmt::format("unknown channel, {} bytes", payload.size())}};
  if (wire::fingerprint_of(payload) != known->fingerprint)
    return {{"error", fmt::format("of another version of {}, {} bytes", known->type, payload.size())}};
  auto message = wire::to_json(known->type, payload);
  if (!message) return {{"error", message.error().message}};
  message->erase("header");
  return with_words(*message);
}

void print_line(const nlohmann::ordered_json& line) {
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  check_standard_output();  // at once: whoever reads us wants it now
}

nlohmann::ordered_json head(std::string_view channel, const wire::Header& header) {
  return {{"channel", channel},    {"utime", header.utime}, {"node", header.node},
          {"epoch", header.epoch}, {"seq", header.seq},     {"run_id", header.run_id}};
}

/// A record of a bus log or of a node's journal; nothing for what a journal keeps for itself.
std::optional<nlohmann::ordered_json> record_to_json(const runtime::LogRecord& record, const std::string& wanted) {
  const bool is_output = record.channel.rfind(runtime::kOutPrefix, 0) == 0;
  const std::string channel = is_output ? record.channel.substr(runtime::kOutPrefix.size()) : record.channel;
  if ((!wanted.empty() && channel != wanted) || channel.rfind('~', 0) == 0) return std::nullopt;
  if (is_output) {
    return nlohmann::ordered_json{{"channel", channel},
                                  {"utime", record.utime},
                                  {"direction", "out"},
                                  {"message", to_json(channel, record.data)}};
  }
  const auto blanked = wire::blank_header(channel, record.data);
  if (!blanked)
    return nlohmann::ordered_json{{"channel", channel}, {"utime", record.utime}, {"error", blanked.error().message}};
  nlohmann::ordered_json line = head(channel, blanked->header);
  line["message"] = to_json(channel, blanked->payload);
  return line;
}

int echo_log(const EchoOptions& options) {
  ForgivingReader reader(options.log);
  for (std::int64_t printed = 0; printed < options.count;) {
    const auto record = reader.next();
    if (!record) break;
    const auto line = record_to_json(*record, options.channel);
    if (!line) continue;
    print_line(*line);
    ++printed;
  }
  return reader.damaged_places() > 0 ? 1 : 0;
}

/// Says once that nobody is heard: nodes of a run that plays say STATUS twice a second.
class Silence {
 public:
  explicit Silence(const RunAccess& run) : log_(run.folder / "run.lcm") {}

  void heard() { is_over_ = true; }
  void look() {
    constexpr auto kPatience = std::chrono::seconds(3);
    if (is_over_ || Clock::now() - since_ < kPatience) return;
    is_over_ = true;
    remark(fmt::format("the run does not play; `nacre echo --log {}` reads its log. Waiting for it (Ctrl-C ends)",
                       shell_word(log_)));
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path log_;
  Clock::time_point since_ = Clock::now();
  bool is_over_ = false;
};

int echo_bus(const EchoOptions& options) {
  const RunAccess run = open_run(options.run);
  const auto is_wanted = [&](const std::string& channel) {
    return options.channel.empty() || channel == options.channel;
  };
  std::vector<std::string> channels;  // empty: all
  if (!options.channel.empty()) channels = {options.channel};
  if (!options.channel.empty() && options.channel != "STATUS") channels.emplace_back("STATUS");  // a sign of life
  const auto bus = listen(run, channels);
  const runtime::Interrupts interrupts;
  Silence silence(run);
  std::int64_t printed = 0;
  while (!interrupts.any() && printed < options.count) {
    silence.look();
    bus->receive(100, [&](const runtime::Received& received) {
      silence.heard();
      if (!is_wanted(received.message.channel) || printed++ >= options.count) return;
      nlohmann::ordered_json line = head(received.message.channel, received.header);
      line["message"] = to_json(received.message.channel, received.message.payload);
      print_line(line);
    });
  }
  return 0;
}

int echo(const EchoOptions& options) {
  if (!options.channel.empty() && wire::find_channel(options.channel) == nullptr) {
    std::string names;
    for (const wire::Channel& channel : wire::channels())
      names += (names.empty() ? "" : ", ") + std::string(channel.name);
    throw InputError::format("{}: no such channel: expected one of {}", options.channel, names);
  }
  return options.log.empty() ? echo_bus(options) : echo_log(options);
}

}  // namespace

void add_echo(CLI::App& app, Action& action) {
  const auto options = std::make_shared<EchoOptions>();
  CLI::App& command =
      add_command(app, action, "echo", "Print the messages of a run, one JSON line each", options, echo);
  command.add_option("CHANNEL", options->channel, "Print this channel alone (lcmtypes/README.md)");
  add_run_option(command, options->run);
  command.add_option("--log", options->log, "Read a log (RUN/run.lcm or a node's journal.lcm) instead of listening");
  command.add_option("--count", options->count, "Stop after so many messages")->check(CLI::Range(1, 1'000'000'000));
}

}  // namespace nacre::cli
