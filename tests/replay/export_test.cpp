// nacre export over the golden games: nothing is missing in what other programs get, and values are the same to the
// bit.

#include <bit>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../json_schema_check.hpp"
#include "../mcap_reader.hpp"
#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "golden_game.hpp"
#include "program.hpp"
#include "runtime/journal.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kBegin = 1'700'000'000'000'001;  // microseconds since 1970

/// What is said in a game, as it would be on the bus.
struct Said {
  std::string channel, payload;
};

class Export : public testing::Test {
 protected:
  void SetUp() override {
    run_ = fresh_folder("export");
    golden::unpack_golden_game(fs::path(NACRE_SOURCE_DIR) / "tests/replay/games/laboratory", run_);
    for (const std::string& node : golden::nodes_of(run_))
      for (runtime::LogReader reader(journal(node)); const auto record = reader.next();) hear(node, *record);
    wire::NodeStatus status;
    status.lost = 7;
    status.dropped = 2;
    said_.push_back({"STATUS", wire::write(status)});
    runtime::LogWriter writer(log());
    for (std::size_t i = 0; i < said_.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i);
      const wire::Header header{kBegin + 10 * number - 3, "golden", 1, ++sequences_[said_[i].channel], "golden"};
      ASSERT_TRUE(writer.append(kBegin + 10 * number, said_[i].channel,
                                wire::stamp_header(said_[i].channel, said_[i].payload, header)));
    }
    ASSERT_TRUE(writer.flush());
  }

  fs::path log() const { return run_ / "run.lcm"; }
  fs::path journal(const std::string& node) const { return run_ / "nodes" / node / "journal.lcm"; }

  std::map<std::string, std::size_t> counts() const {
    std::map<std::string, std::size_t> counts;
    for (const Said& each : said_) ++counts[each.channel];
    return counts;
  }
  template <class Message>
  std::vector<Message> all_said(const std::string& channel) const {
    std::vector<Message> messages;
    for (const Said& each : said_)
      if (each.channel == channel) messages.push_back(wire::read<Message>(each.payload).value());
    return messages;
  }

  fs::path run_;
  std::vector<Said> said_;

 private:
  /// What nodes said, and measurements: the game holds those where they were heard.
  void hear(const std::string& node, const runtime::LogRecord& record) {
    if (node == "validation_agent" && record.channel == "MEASUREMENT")
      said_.push_back({record.channel, wire::blank_header(record.channel, record.data).value().payload});
    if (!record.channel.starts_with(runtime::kOutPrefix)) return;
    said_.push_back({record.channel.substr(runtime::kOutPrefix.size()), record.data});
  }
  std::map<std::string, std::int64_t> sequences_;
};

/// A sound MCAP file whose messages are as their schemas say.
mcap::File sound_file(const fs::path& file) {
  mcap::File read = mcap::read(read_file(file));
  EXPECT_THAT(read.faults, IsEmpty());
  std::map<std::string, Json> schemas;
  for (const auto& [topic, channel] : read.channels) schemas[topic] = Json::parse(channel.schema);
  for (const mcap::Message& message : read.messages)
    EXPECT_THAT(schema_fault(schemas[message.topic], Json::parse(message.data)), IsEmpty()) << message.topic;
  return read;
}

std::map<std::string, std::size_t> counts_of(const mcap::File& file) {
  std::map<std::string, std::size_t> counts;
  for (const mcap::Message& message : file.messages) ++counts[message.topic];
  return counts;
}

std::vector<Json> contents_of(const mcap::File& file, const std::string& topic) {
  std::vector<Json> contents;
  for (const mcap::Message& message : file.messages)
    if (message.topic == topic) contents.push_back(Json::parse(message.data));
  return contents;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

TEST_F(Export, McapHoldsEveryMessageOfAGame) {
  const Outcome outcome = run_nacre({"export", "--mcap", run_.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr(fmt::format("{0} messages of {0} records: ", said_.size())));
  const mcap::File file = sound_file(run_ / "run.mcap");
  EXPECT_EQ(counts_of(file), counts());
  EXPECT_GT(counts().size(), 8U) << "the game has few channels";
  EXPECT_EQ(file.channels.at("PROPOSAL").schema_name, "nacre.proposal_t");
  for (std::size_t i = 0; i < file.messages.size(); ++i) {
    EXPECT_EQ(file.messages[i].log_time_ns, 1000 * static_cast<std::uint64_t>(kBegin) + 10'000 * i);
    EXPECT_EQ(file.messages[i].publish_time_ns, file.messages[i].log_time_ns - 3000);
  }
}

TEST_F(Export, McapHoldsValuesToTheBit) {
  ASSERT_EQ(run_nacre({"export", "--mcap", log().string(), "--out", (run_ / "x.mcap").string()}).status, 0);
  const mcap::File file = sound_file(run_ / "x.mcap");
  const auto gamuts = contents_of(file, "GAMUT");
  const auto chunks = all_said<wire::GamutChunk>("GAMUT");
  ASSERT_EQ(gamuts.size(), chunks.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i)
    for (std::size_t k = 0; k < chunks[i].samples.size(); ++k, ++compared) {
      EXPECT_EQ(gamuts[i]["pattern"][k], chunks[i].samples[k].pattern.key());
      EXPECT_TRUE(same_bits(gamuts[i]["modulus_pa"][k], chunks[i].samples[k].performance.modulus_pa));
    }
  EXPECT_GT(compared, 10U);
  const auto models = contents_of(file, "PARAMETERS");
  const auto adopted = all_said<wire::AdoptedModel>("PARAMETERS");
  ASSERT_EQ(models.size(), adopted.size());
  for (std::size_t i = 0; i < adopted.size(); ++i)
    EXPECT_TRUE(same_bits(models[i]["toughness_objective"], adopted[i].provenance.toughness_objective));
}

TEST_F(Export, McapOfAJournalTellsWhatWasHeardFromWhatWasSaid) {
  for (const std::string& node : golden::nodes_of(run_)) {
    std::map<std::string, std::size_t> expected;
    for (runtime::LogReader reader(journal(node)); const auto record = reader.next();) {
      const std::string& channel = record->channel;
      if (channel.starts_with(runtime::kOutPrefix)) ++expected["sent/" + channel.substr(runtime::kOutPrefix.size())];
      if (!channel.starts_with('~')) ++expected[channel];
    }
    const fs::path out = run_ / (node + ".mcap");
    const Outcome outcome = run_nacre({"export", "--mcap", journal(node).string(), "--out", out.string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(counts_of(sound_file(out)), expected) << node;
  }
}

TEST_F(Export, LossesAreCountedAndNamed) {
  {
    runtime::LogWriter writer(log());
    wire::Review review;
    review.specimen = "S-1";
    std::string bytes = wire::stamp_header("REVIEW", wire::write(review), {1, "person", 1, 1, "golden"});
    EXPECT_TRUE(writer.append(2, "REVIEW", bytes));
    bytes.back() ^= 1;
    EXPECT_TRUE(writer.append(3, "REVIEW", bytes));
    EXPECT_TRUE(writer.append(4, "NOI\nSE", "noise"));
    EXPECT_TRUE(
        writer.append(5, "REVIEW", wire::stamp_header("REVIEW", wire::write(review), {1, "person", 1, 4, "g"})));
    EXPECT_TRUE(writer.flush());
  }
  std::ofstream(log(), std::ios::app | std::ios::binary) << read_file(log()).substr(0, 40);
  const Outcome outcome = run_nacre({"export", "--mcap", run_.string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("REVIEW: 1 message cannot be read; the first, record at byte "));
  EXPECT_THAT(outcome.err, HasSubstr("the checksum does not fit the bytes"));
  EXPECT_THAT(outcome.err, HasSubstr("2 messages were said and not recorded"));
  const mcap::File file = sound_file(run_ / "run.mcap");
  EXPECT_EQ(file.messages.size(), said_.size() + 2);
  auto losses = file.metadata.at("losses");
  EXPECT_EQ(losses["records"], fmt::format("{}", said_.size() + 4));
  EXPECT_EQ(losses["messages"], fmt::format("{}", said_.size() + 2));
  EXPECT_EQ(losses["unread"], "2");
  EXPECT_EQ(losses["unread/REVIEW"], "1");
  EXPECT_EQ(losses["unread/NOI?SE"], "1");
  EXPECT_THAT(losses["unread/NOI?SE/first"], HasSubstr("nacre has no such channel"));
  EXPECT_EQ(losses["never_recorded"], "2");
  EXPECT_EQ(losses["torn_bytes"], "40");
  EXPECT_EQ(losses["node/golden/lost"], "7");
  EXPECT_EQ(losses["node/golden/dropped"], "2");
}

TEST_F(Export, ATruncatedLogGivesWhatIsWhole) {
  fs::resize_file(log(), fs::file_size(log()) - 5);
  const Outcome outcome = run_nacre({"export", "--mcap", run_.string()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("ends in a torn record"));
  const mcap::File file = sound_file(run_ / "run.mcap");
  EXPECT_EQ(file.messages.size(), said_.size() - 1);
  EXPECT_NE(file.metadata.at("losses").at("torn_bytes"), "0");
}

/// The rows of a table by heading.
std::vector<std::map<std::string, std::string>> rows_of(const fs::path& table) {
  const std::string text = read_file(table);
  CsvReader reader(text, table.string(), {.bytes_per_cell = 1 << 20});
  CsvRow heading, row;
  EXPECT_TRUE(reader.next(heading));
  std::vector<std::map<std::string, std::string>> rows;
  while (reader.next(row)) {
    EXPECT_THAT(row.fault, IsEmpty());
    EXPECT_EQ(row.cells.size(), heading.cells.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < row.cells.size(); ++i) rows.back()[heading.cells[i].text] = row.cells[i].text;
  }
  return rows;
}

TEST_F(Export, CsvHasATablePerChannelAndARowPerMessage) {
  const fs::path out = run_ / "tables";
  const Outcome outcome = run_nacre({"export", "--csv", run_.string(), "--out", out.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, std::size_t> rows;
  for (const auto& entry : fs::directory_iterator(out))
    if (entry.path().stem() != "losses") rows[entry.path().stem().string()] = rows_of(entry.path()).size();
  EXPECT_EQ(rows, counts());
  EXPECT_EQ(rows_of(out / "losses.csv").front()["what"], "damaged_places");
}

TEST_F(Export, CsvHoldsValuesToTheBit) {
  const fs::path out = run_ / "tables";
  ASSERT_EQ(run_nacre({"export", "--csv", run_.string(), "--out", out.string()}).status, 0);
  auto rows = rows_of(out / "MEASUREMENT.csv");
  const auto measured = all_said<wire::Measurement>("MEASUREMENT");
  ASSERT_EQ(rows.size(), measured.size());
  EXPECT_GT(rows.size(), 5U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i]["specimen"], measured[i].record.specimen);
    const auto modulus_pa = measured[i].record.modulus_pa;
    EXPECT_EQ(rows[i]["modulus_pa"].empty(), !modulus_pa.has_value());
    if (!modulus_pa) continue;
    EXPECT_TRUE(same_bits(number_from_text(rows[i]["modulus_pa"]).value(), *modulus_pa));
  }
  rows = rows_of(out / "PARAMETERS.csv");
  const auto models = all_said<wire::AdoptedModel>("PARAMETERS");
  ASSERT_EQ(rows.size(), models.size());
  const auto toughness = Json::parse(rows[0]["parameters.toughness"]);
  const auto expected = material::to_vector(models[0].parameters.toughness);
  ASSERT_EQ(toughness.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(same_bits(toughness[k], expected[k]));
  EXPECT_THAT(rows[0]["log_time_s"], testing::MatchesRegex("17[0-9]{8}\\.[0-9]{6}"));
  EXPECT_EQ(rows[0]["header.node"], "golden");
}

TEST_F(Export, NothingIsWrittenOver) {
  const fs::path full = run_ / "full";
  fs::create_directories(full);
  write_file_atomically(full / "kept.txt", "kept");
  const Outcome csv = run_nacre({"export", "--csv", run_.string(), "--out", full.string()});
  EXPECT_EQ(csv.status, 2);
  EXPECT_THAT(csv.err, HasSubstr("full: holds files; expected a new folder"));
  const std::string before = read_file(log());
  const Outcome mcap = run_nacre({"export", "--mcap", run_.string(), "--out", log().string()});
  EXPECT_EQ(mcap.status, 2);
  EXPECT_THAT(mcap.err, HasSubstr("is read by the same command"));
  EXPECT_EQ(read_file(log()), before);
}

}  // namespace
}  // namespace nacre
