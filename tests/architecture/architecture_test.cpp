// The rules of docs/ARCHITECTURE.md that a compiler does not check.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tree.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<std::string> includes;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    if (std::smatch match; std::regex_search(line, match, kInclude)) includes.push_back(match[1]);
  }
  return includes;
}

/// Module -> rank, in the order of the five storeys.
std::map<std::string, int> module_ranks() {
  const std::string text = text_of("cmake/NacreModules.cmake");
  std::map<std::string, int> ranks;
  for (const char* storey : {"GROUND", "PHYSICS", "KNOWLEDGE", "GAME", "WORLD"}) {
    std::smatch match;
    const std::regex list(std::string("set\\(NACRE_") + storey + R"(([^)]*)\))");
    EXPECT_TRUE(std::regex_search(text, match, list)) << storey;
    std::istringstream words(match[1]);
    for (std::string word; words >> word;) ranks.emplace(word, static_cast<int>(ranks.size()));
  }
  return ranks;
}

std::string first_part(const std::string& include) { return include.substr(0, include.find('/')); }

TEST(Architecture, EveryFolderOfLibIsAModule) {
  const auto ranks = module_ranks();
  for (const auto& entry : fs::directory_iterator(kRoot / "lib")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(ranks.contains(entry.path().filename().string())) << entry.path();
  }
}

TEST(Architecture, ModulesIncludeOnlyModulesThatStandBeforeThem) {
  const auto ranks = module_ranks();
  int checked = 0;
  for (const fs::path& file : sources_below("lib")) {
    const std::string own = (++file.begin())->string();
    for (const std::string& include : includes_of(file)) {
      const auto other = ranks.find(first_part(include));
      if (other == ranks.end() || include.find('/') == std::string::npos) continue;
      ++checked;
      EXPECT_LE(other->second, ranks.at(own)) << file << " includes " << include;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(Architecture, OnlyRuntimeIncludesLcmAndClocks) {
  static const std::set<std::string> kClocks = {"chrono",     "ctime",       "time.h",
                                                "sys/time.h", "sys/times.h", "sys/timeb.h"};
  for (const fs::path& file : sources_below("lib")) {
    if (file.string().starts_with("lib/runtime/")) continue;
    // What work costs a thread: a figure for people, no decision hangs on it.
    const bool may_measure_work = file == "lib/base/processor_time.hpp";
    const std::string text = text_of(file);
    for (const char* call : {"clock_gettime", "gettimeofday", "std::time(", "std::clock("})
      EXPECT_TRUE(may_measure_work || text.find(call) == std::string::npos) << file << " calls " << call;
    for (const std::string& include : includes_of(file)) {
      // lcm_coretypes.h holds the encoding alone; wire needs it.
      const bool is_encoding = file.string().starts_with("lib/wire/") && include == "lcm/lcm_coretypes.h";
      EXPECT_TRUE(!include.starts_with("lcm/") || is_encoding) << file;
      EXPECT_TRUE(may_measure_work || !kClocks.contains(include))
          << file << " includes " << include << ": clocks belong to runtime";
    }
  }
}

TEST(Architecture, NodesDoNotIncludeLcm) {
  for (const fs::path& file : sources_below("nodes")) {
    for (const std::string& include : includes_of(file)) EXPECT_FALSE(include.starts_with("lcm/")) << file;
  }
}

TEST(Architecture, OnlyTheLaboratoryAndItsToolsReadTheTruth) {
  // The sealed answer: agents, analyser and diagnosis must not be able to look at it.
  const std::vector<std::string> allowed = {"lib/laboratory/",
                                            "nodes/virtual_lab/",
                                            "nodes/cli/measure",
                                            "nodes/cli/replay_laboratory",
                                            "nodes/python/measure.cpp",
                                            "bench/",
                                            "tests/"};
  for (const char* folder : {"lib", "nodes", "bench", "tests"}) {
    for (const fs::path& file : sources_below(folder)) {
      if (std::any_of(allowed.begin(), allowed.end(), [&](const auto& p) { return file.string().starts_with(p); }))
        continue;
      const std::string text = text_of(file);
      EXPECT_EQ(text.find("truth.toml"), std::string::npos) << file;
      for (const std::string& include : includes_of(file)) {
        EXPECT_FALSE(include.starts_with("laboratory/") || include.starts_with("virtual_lab/")) << file;
      }
    }
  }
}

TEST(Architecture, NoFileIsLongerThanFiveHundredLines) {
  for (const char* folder : {"lib", "nodes"}) {
    for (const fs::path& file : sources_below(folder)) {
      const std::string text = text_of(file);
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 500) << file;
    }
  }
}

/// A source is declared in the header of its own name, or its first line says what it is a part of.
bool has_a_header_or_says_of_what_it_is_a_part(const fs::path& source) {
  for (const char* extension : {".hpp", ".ipp"}) {
    if (fs::exists(kRoot / fs::path(source).replace_extension(extension))) return true;
  }
  return text_of(source).starts_with("// Part of ");
}

TEST(Architecture, EverySourceHasAHeaderOrSaysOfWhatItIsAPart) {
  for (const char* folder : {"lib", "nodes"}) {
    for (const fs::path& file : sources_below(folder)) {
      if (file.extension() != ".cpp" || file.filename() == "main.cpp") continue;
      EXPECT_TRUE(has_a_header_or_says_of_what_it_is_a_part(file)) << file;
    }
  }
}

TEST(Architecture, NodesAreThinMainsOnPureCores) {
  const std::map<std::string, int> most_lines = {{"nodes/analyser", 1200}, {"nodes/virtual_lab", 800}};
  for (const auto& [folder, most] : most_lines) {
    std::ptrdiff_t lines = 0;
    for (const fs::path& file : sources_below(folder)) {
      const std::string text = text_of(file);
      lines += std::count(text.begin(), text.end(), '\n');
    }
    EXPECT_GT(lines, 0) << folder;
    EXPECT_LT(lines, most) << folder;
  }
}

TEST(Architecture, EveryModuleHasAReadme) {
  for (const auto& [name, rank] : module_ranks()) {
    if (!fs::exists(kRoot / "lib" / name / "CMakeLists.txt")) continue;
    EXPECT_TRUE(fs::exists(kRoot / "lib" / name / "README.md")) << name;
  }
}

/// `name` -> the six digits behind it, at each match of `pattern` (name, digits).
std::map<std::string, std::string> colours_in(const fs::path& file, const std::string& pattern) {
  const std::string text = text_of(file);
  const std::regex colour(pattern);
  std::map<std::string, std::string> colours;
  for (std::sregex_iterator match(text.begin(), text.end(), colour), end; match != end; ++match)
    colours.emplace((*match)[1], (*match)[2]);
  return colours;
}

TEST(Architecture, ThePageHasTheColoursOfThePhases) {
  const auto printed = colours_in("lib/pattern/phase_colours.hpp", "k(Soft|Rigid|Interface)Rgb = 0x([0-9a-f]{6})");
  const auto shown = colours_in("web/src/colour.ts", "\\b(soft|rigid|interface): \"#([0-9a-f]{6})\"");
  ASSERT_EQ(printed.size(), 3u);
  EXPECT_EQ(shown,
            (std::map<std::string, std::string>{
                {"soft", printed.at("Soft")}, {"rigid", printed.at("Rigid")}, {"interface", printed.at("Interface")}}));
}

}  // namespace
}  // namespace nacre
