// What CONTRIBUTING.md asks of documents: budgets of words, width of lines, words that must not come back, little kept
// data.

#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tree.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t words_in(const std::string& text) {
  std::istringstream words(text);
  return std::distance(std::istream_iterator<std::string>(words), {});
}

/// Characters, not bytes.
std::ptrdiff_t width_of(const std::string& line) {
  return std::ranges::count_if(line, [](unsigned char byte) { return (byte & 0xC0) != 0x80; });
}

/// The most words that a document may have, by the folder or name that its path begins with; the longest match counts.
const std::map<std::string, int> kBudgets = {{"README.md", 700},
                                             {"CHANGELOG.md", 400},
                                             {"CONTRIBUTING.md", 700},
                                             {"docs/", 1300},
                                             {"docs/ARCHITECTURE.md", 1000},
                                             {"docs/GLOSSARY.md", 1500},
                                             {"docs/METHODS.md", 3200},
                                             {"docs/FORMATS.md", 4400},
                                             {"docs/recipes.md", 1000},
                                             {"docs/studies/", 500},
                                             {"docs/decisions/", 200},
                                             {"launch/README.md", 1000},
                                             {"lcmtypes/README.md", 700},
                                             {"nodes/cli/README.md", 600},
                                             {"", 450}};
constexpr std::ptrdiff_t kMostWordsInAll = 30000;

int budget_of(const fs::path& document) {
  std::size_t longest = 0;
  int words = kBudgets.at("");
  for (const auto& [begin, most] : kBudgets) {
    if (document.string().starts_with(begin) && begin.size() >= longest) longest = begin.size(), words = most;
  }
  return words;
}

TEST(Documents, KeepToTheirBudgetsOfWords) {
  std::ptrdiff_t all = 0;
  for (const fs::path& document : files_below("", {".md"})) {
    const std::ptrdiff_t words = words_in(text_of(document));
    EXPECT_LE(words, budget_of(document)) << document;
    all += words;
  }
  EXPECT_GT(all, 10000);
  EXPECT_LE(all, kMostWordsInAll);
}

TEST(Documents, LinesAreAtMost120CharactersWide) {
  for (const fs::path& file : files_below("", {".md", ".hpp", ".cpp", ".ipp", ".cu", ".ts", ".tsx", ".lcm", ".sh"})) {
    if (file.string().starts_with("tests/fuzz/corpus/")) continue;
    std::istringstream lines(text_of(file));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      EXPECT_LE(width_of(line), 120) << file.string() << ":" << number;
    }
  }
}

/// A word that must not come back, and what to say instead.
struct RetiredWord {
  std::string word, instead;
};

/// Lines "word -> instead" of retired_words.txt; # begins a comment.
std::vector<RetiredWord> retired_words() {
  std::vector<RetiredWord> words;
  std::istringstream lines(text_of("tests/architecture/retired_words.txt"));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t arrow = line.find(" -> ");
    if (!line.starts_with('#') && arrow != std::string::npos)
      words.push_back({line.substr(0, arrow), line.substr(arrow + 4)});
  }
  return words;
}

/// The line without what must keep its name: text in straight or backward quotes, where keys, streams and wire values
/// stand.
std::string prose_of(const std::string& line) {
  std::string prose;
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0 && line[i] == '\\') {
      ++i;
    } else if (quote != 0) {
      if (line[i] == quote) quote = 0;
    } else if (line[i] == '"' || line[i] == '`') {
      quote = line[i];
    } else {
      prose += line[i];
    }
  }
  return prose;
}

bool holds(const std::string& prose, const std::string& lower_prose, const std::string& word) {
  for (std::size_t at = lower_prose.find(word); at != std::string::npos; at = lower_prose.find(word, at + 1)) {
    const bool begins_a_word = at == 0 || std::isalpha(static_cast<unsigned char>(prose[at - 1])) == 0 ||
                               std::isupper(static_cast<unsigned char>(prose[at])) != 0;
    if (begins_a_word) return true;
  }
  return false;
}

TEST(Documents, RetiredWordsAreFoundInProseAndInNames) {
  const auto found = [](const std::string& line) {
    std::string lower = prose_of(line);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return holds(prose_of(line), lower, "foretold");
  };
  EXPECT_TRUE(found("T was Foretold"));
  EXPECT_TRUE(found("ForetoldTests tests;"));
  EXPECT_TRUE(found("int n_foretold = 1;"));
  EXPECT_TRUE(found("see `key`, foretold"));
  EXPECT_FALSE(found("keys.add(\"foretold\"); `foretold`"));
  EXPECT_FALSE(found("unforetold"));
}

TEST(Documents, RetiredWordsDoNotComeBack) {
  const std::vector<RetiredWord> retired = retired_words();
  ASSERT_GT(retired.size(), 10U);
  for (const fs::path& file : files_below("", {".md", ".hpp", ".cpp", ".ipp", ".cu", ".ts", ".tsx"})) {
    if (file.string().starts_with("tests/architecture/") || file == "CONTRIBUTING.md") continue;
    std::istringstream lines(text_of(file));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::string prose = prose_of(line);
      std::string lower = prose;
      std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
      for (const auto& [word, instead] : retired) {
        EXPECT_FALSE(holds(prose, lower, word))
            << file.string() << ":" << number << " says \"" << word << "\"; say: " << instead;
      }
    }
  }
}

TEST(Documents, EveryRelativeLinkLeadsSomewhere) {
  static const std::regex kLink(R"(\]\(([^)#\s]+)(#[^)\s]*)?\))");
  int links = 0;
  for (const fs::path& document : files_below("", {".md"})) {
    const std::string text = text_of(document);
    for (auto link = std::sregex_iterator(text.begin(), text.end(), kLink); link != std::sregex_iterator(); ++link) {
      const std::string target = (*link)[1];
      if (target.find("://") != std::string::npos) continue;
      ++links;
      EXPECT_TRUE(fs::exists(kRoot / document.parent_path() / target)) << document << " links to " << target;
    }
  }
  EXPECT_GT(links, 50);
}

TEST(Documents, NoStudyKeepsMoreThan200kB) {
  std::map<std::string, std::uintmax_t> kept;
  const std::set<std::string> data = {".csv", ".txt", ".json", ".jsonl", ".toml", ".svg", ".png", ".gif", ".md"};
  for (const char* folder : {"docs/studies", "bench"}) {
    for (const fs::path& file : files_below(folder, data)) {
      if (file.filename() == "CMakeLists.txt") continue;
      std::string study = std::next(file.begin(), folder == std::string("bench") ? 1 : 2)->string();
      if (study.ends_with(".md")) study.resize(study.size() - 3);
      kept[std::string(folder) + "/" + study] += fs::file_size(kRoot / file);
    }
  }
  ASSERT_GT(kept.size(), 10U);
  for (const auto& [study, bytes] : kept) EXPECT_LE(bytes, 200000U) << study;
}

}  // namespace
}  // namespace nacre
