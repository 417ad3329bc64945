#include "wire/channels.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "samples.hpp"

namespace nacre::wire {
namespace {

struct Row {
  std::string type, receivers, reliable;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The channel table of lcmtypes/README.md.
std::map<std::string, Row> documented_channels() {
  std::ifstream readme(NACRE_SOURCE_DIR "/lcmtypes/README.md");
  std::map<std::string, Row> rows;
  for (std::string line; std::getline(readme, line);) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
    if (cells.size() == 7 && !cells[1].empty() && std::isupper(static_cast<unsigned char>(cells[1][0]))) {
      rows[cells[1]] = {cells[2], cells[4], cells[5]};
    }
  }
  return rows;
}

std::string documented(const std::vector<std::string_view>& receivers) {
  std::string text;
  for (const std::string_view receiver : receivers) {
    text += (text.empty() ? "" : ", ") + std::string(receiver);
  }
  return text;
}

TEST(Channels, AgreeWithTheDocumentedTable) {
  const std::map<std::string, Row> rows = documented_channels();
  EXPECT_EQ(rows.size(), channels().size());
  for (const Channel& channel : channels()) {
    ASSERT_TRUE(rows.count(std::string(channel.name))) << channel.name;
    const Row& row = rows.at(std::string(channel.name));
    EXPECT_EQ(row.type, channel.type) << channel.name;
    EXPECT_EQ(row.reliable.starts_with("yes"), channel.reliable) << channel.name;
    EXPECT_EQ(row.reliable.find("synced") != std::string::npos, channel.synced) << channel.name;
    if (channel.receivers[0] == kEveryNode) {
      EXPECT_TRUE(row.receivers == "all nodes" || row.receivers == "all" || row.receivers == "any") << channel.name;
    } else {
      const std::string receivers = row.receivers.substr(0, row.receivers.find(" ("));  // "virtual_lab (or a person)"
      EXPECT_EQ(receivers, documented(channel.receivers)) << channel.name;
    }
  }
}

TEST(Channels, EveryFingerprintIsUnique) {
  std::set<std::int64_t> fingerprints;
  for (const Channel& channel : channels())
    EXPECT_TRUE(fingerprints.insert(channel.fingerprint).second) << channel.name;
}

TEST(Channels, ResponsesAreForTheNodeThatTheRequestNames) {
  const Channel& simulated = *find_channel("SIMULATED");
  const std::string payload = write(samples::result());  // proposal_agent/0/17
  const std::vector<std::string> nodes{"validation_agent", "proposal_agent", "analyser", "simulator_farm"};
  EXPECT_EQ(receivers_of(simulated, payload, nodes, "simulator_farm"), std::vector<std::string>{"proposal_agent"});
  EXPECT_TRUE(is_meant_for(simulated, payload, "proposal_agent"));
  EXPECT_FALSE(is_meant_for(simulated, payload, "analyser"));
}

TEST(Channels, ReceiversAreThoseThatTakePartWithoutTheSender) {
  const std::vector<std::string> nodes{"validation_agent", "proposal_agent", "analyser"};
  EXPECT_EQ(receivers_of(*find_channel("ROUND"), "", nodes, "validation_agent"),
            (std::vector<std::string>{"proposal_agent", "analyser"}));
  EXPECT_TRUE(receivers_of(*find_channel("TEST_ORDER"), "", nodes, "validation_agent").empty());  // a person tests
}

}  // namespace
}  // namespace nacre::wire
