// Streams of random numbers are named, and a name is part of the seed: whoever renames one changes every game. Their
// names and first draws are pinned here.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "base/random.hpp"
#include "tree.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// Name as the source writes it ({} and the end of a prefix stand for what is filled in) -> first draw of seed 1.
const std::map<std::string, std::uint64_t> kFirstDraws = {};

/// The first piece of text of every RandomStream that is made below lib and nodes.
std::set<std::string> names_in_sources() {
  static const std::regex kStream(R"re((?:RandomStream(?:\s+\w+)?|random_|numbered)\([^;{}]*?"([^"]+)")re");
  std::set<std::string> names;
  for (const char* folder : {"lib", "nodes"}) {
    for (const fs::path& file : sources_below(folder)) {
      const std::string text = text_of(file);
      for (auto found = std::sregex_iterator(text.begin(), text.end(), kStream); found != std::sregex_iterator();
           ++found)
        names.insert((*found)[1]);
    }
  }
  return names;
}

TEST(RandomStreams, HaveTheNamesThatTheyAlwaysHad) {
  for (const std::string& name : names_in_sources()) {
    EXPECT_TRUE(kFirstDraws.contains(name))
        << "a new stream: add it, {\"" << name << "\", " << RandomStream(1, name).bits() << "U}";
  }
  const std::set<std::string> names = names_in_sources();
  for (const auto& [name, draw] : kFirstDraws) EXPECT_TRUE(names.contains(name)) << "renamed or gone: " << name;
}

TEST(RandomStreams, FirstDrawsArePinned) {
  for (const auto& [name, draw] : kFirstDraws) EXPECT_EQ(RandomStream(1, name).bits(), draw) << name;
}

}  // namespace
}  // namespace nacre
