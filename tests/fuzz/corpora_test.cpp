// The fuzz targets as an ordinary test, with any compiler: every file of the kept corpora (what the fuzzers found worth
// keeping, and every input that was a finding once), and seeded changes of it. A finding ends the program.

#include <algorithm>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/random.hpp"
#include "fuzz.hpp"

#define NACRE_FUZZ_TARGETS(DO)                                                                       \
  DO(batch)                                                                                          \
  DO(dashboard)                                                                                      \
  DO(database)                                                                                       \
  DO(film)                                                                                           \
  DO(journal) DO(laboratory) DO(layout) DO(measurement_set) DO(messages) DO(parameters) DO(scenario) \
      DO(specimen_sheet) DO(tables) DO(tester_export)
#define DECLARE(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
NACRE_FUZZ_TARGETS(DECLARE)

namespace nacre {
namespace {

namespace fs = std::filesystem;

struct Target {
  std::string name;
  int (*run)(const std::uint8_t*, std::size_t);
};
#define ENTRY(name) {#name, fuzz_##name},
const std::vector<Target> kTargets = {NACRE_FUZZ_TARGETS(ENTRY)};

/// Layouts of makers, which are seeds, too.
const fs::path kExports = fs::path(NACRE_SOURCE_DIR) / "tests" / "unit" / "measurement" / "data" / "exports";
const fs::path kCorpora = fs::path(NACRE_SOURCE_DIR) / "tests" / "fuzz" / "corpus";

std::vector<std::string> corpus_of(const std::string& target) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kCorpora / target)) files.push_back(entry.path());
  if (target == "tester_export") {
    for (const auto& entry : fs::recursive_directory_iterator(kExports)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const fs::path& file : files) inputs.push_back(read_file(file));
  return inputs;
}

/// One to four changes: bits, bytes, pieces cut out, doubled, or taken from another input; numbers made extreme.
std::string changed(std::string bytes, const std::string& other, RandomStream& random) {
  const auto place = [&] { return static_cast<std::size_t>(random.index(static_cast<int>(bytes.size()) + 1)); };
  for (int change = random.index(4); change >= 0; --change) {
    const std::size_t at = place(), length = static_cast<std::size_t>(random.index(16));
    switch (random.index(6)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.index(8)));
        break;
      case 1:
        if (at < bytes.size()) bytes[at] = static_cast<char>(random.index(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(place(), length));
        break;
      case 4:
        bytes.replace(at, length, other.substr(std::min(at, other.size()), length));
        break;
      default:
        static const std::vector<std::string> kExtremes = {std::string(4, '\xff'),
                                                           std::string(8, '\x7f'),
                                                           std::string(4, '\0'),
                                                           "1e999",
                                                           "-nan",
                                                           "99999999999999999999",
                                                           "\"",
                                                           "\r\n",
                                                           ",,,,",
                                                           "\xef\xbb\xbf"};
        bytes.insert(at, kExtremes[random.index(static_cast<int>(kExtremes.size()))]);
    }
  }
  return bytes;
}

void feed(const Target& target, const std::string& bytes) {
  EXPECT_EQ(target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
}

class Corpora : public testing::TestWithParam<Target> {};

TEST_P(Corpora, HoldNothingThatBreaksAReader) {
  const Target& target = GetParam();
  const std::vector<std::string> inputs = corpus_of(target.name);
  ASSERT_FALSE(inputs.empty());
  for (const std::string& input : inputs) feed(target, input);
  RandomStream random(1, target.name);
  const int changes = target.name == "database" ? 60 : 1000;  // a database costs milliseconds
  for (int i = 0; i < changes; ++i) {
    const auto any = [&] { return inputs[random.index(static_cast<int>(inputs.size()))]; };
    const std::string input = any();
    feed(target, changed(input, any(), random));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpora, testing::ValuesIn(kTargets), [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace nacre
