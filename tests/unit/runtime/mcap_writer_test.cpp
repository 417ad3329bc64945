// Written MCAP files, read by a reader of the tests' own that follows the specification.

#include "runtime/mcap_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../../json_schema_check.hpp"
#include "../../mcap_reader.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "temporary_folder.hpp"

namespace nacre::runtime {
namespace {

using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

constexpr std::string_view kSchema =
    R"({"type":"object","properties":{"n":{"type":"integer","minimum":0},"words":{"type":"string"}},"required":["n"]})";

class Mcap : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "log.mcap"; }
  /// `count` messages in turn on two channels, so many that they fill chunks; times run backwards within pairs.
  void write(int count, std::size_t words = 40) const {
    McapWriter writer(file(), "tests 1");
    const int channels[] = {writer.add_channel("A", "letter", kSchema),
                            writer.add_channel("sent/A", "letter", kSchema)};
    std::uint32_t noise = 1;
    for (int i = 0; i < count; ++i) {
      std::string text;
      for (std::size_t k = 0; k < words; ++k) text += std::to_string(noise = noise * 1664525U + 1013904223U);
      const std::string json = fmt::format(R"({{"n":{},"words":"{}"}})", i, text);
      const auto time_ns = static_cast<std::uint64_t>(1'000'000'000 + (i ^ 1));
      writer.add_message({.channel = channels[i % 2],
                          .sequence = static_cast<std::uint32_t>(i),
                          .log_time_ns = time_ns,
                          .publish_time_ns = time_ns - 7,
                          .json = json});
    }
    writer.add_metadata("loss", {{"missing", "3"}, {"torn_bytes", "0"}});
    writer.finish();
  }
  TemporaryFolder folder_;
};

TEST_F(Mcap, IsReadByAReaderWrittenFromTheSpecification) {
  write(11);
  const mcap::File read = mcap::read(read_file(file()));
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.library, "tests 1");
  ASSERT_EQ(read.messages.size(), 11U);
  const mcap::Message& message = read.messages[3];
  EXPECT_EQ(message.topic, "sent/A");
  EXPECT_EQ(message.sequence, 3U);
  EXPECT_EQ(message.log_time_ns, 1'000'000'002U);
  EXPECT_EQ(message.publish_time_ns, 999'999'995U);
  EXPECT_EQ(read.channels.at("A").schema_name, "letter");
  EXPECT_EQ(read.channels.at("A").schema, kSchema);
  EXPECT_THAT(read.metadata.at("loss"), ElementsAre(Pair("missing", "3"), Pair("torn_bytes", "0")));
}

TEST_F(Mcap, MessagesAreAsTheirSchemaSays) {
  write(5);
  for (const mcap::File read = mcap::read(read_file(file())); const mcap::Message& message : read.messages) {
    const auto schema = nlohmann::ordered_json::parse(read.channels.at(message.topic).schema);
    EXPECT_THAT(schema_fault(schema, nlohmann::ordered_json::parse(message.data)), IsEmpty());
  }
}

TEST_F(Mcap, ALongFileHasManyChunks) {
  write(20'000);
  const mcap::File read = mcap::read(read_file(file()));
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.messages.size(), 20'000U);
  EXPECT_THAT(read.chunks, Gt(5U));
}

TEST_F(Mcap, AMessageLargerThanAChunkIsWritten) {
  write(3, 200'000);
  const mcap::File read = mcap::read(read_file(file()));
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.chunks, 3U);
}

TEST_F(Mcap, OneWithoutMessagesIsSound) {
  write(0);
  const mcap::File read = mcap::read(read_file(file()));
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.channels.size(), 2U);
}

TEST_F(Mcap, TheReaderNoticesEveryAlteredByte) {
  write(4, 1);
  const std::string sound = read_file(file());
  for (std::size_t i = 0; i < sound.size(); ++i) {
    std::string altered = sound;
    altered[i] = static_cast<char>(altered[i] ^ 1);
    EXPECT_THAT(mcap::read(altered).faults, Not(IsEmpty())) << "byte " << i;
  }
}

TEST_F(Mcap, AFileThatWasNotFinishedLeavesNothing) {
  {
    McapWriter writer(file(), "tests");
    writer.add_channel("A", "letter", kSchema);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Mcap, AFolderThatIsMissingIsNamed) {
  try {
    McapWriter writer(folder_.path() / "nowhere" / "log.mcap", "tests");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nowhere"));
  }
}

}  // namespace
}  // namespace nacre::runtime
