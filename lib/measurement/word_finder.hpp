#pragma once
// Finds the words of a fixed list in a heading, all at once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace nacre::measurement {

/// Whether `word` begins with a Japanese, Chinese or Korean letter: such words stand anywhere.
bool is_east_asian(std::string_view word);

/// A word of the list in a text.
struct FoundWord {
  std::size_t index = 0;  ///< of the list
  std::size_t begin = 0;  ///< byte of the text
};

/// A word is found whole, with no Latin letter before or behind it. One pass over the text: every word is looked for
/// only where its first byte stands, since readers ask for hundreds of words in every cell.
class WordFinder {
 public:
  explicit WordFinder(std::span<const std::string_view> words);
  std::span<const std::string_view> words() const { return words_; }
  bool finds_one(std::string_view text) const;
  std::vector<FoundWord> find_all(std::string_view text) const;

 private:
  template <class Found>
  void search(std::string_view text, const Found& found) const;

  std::vector<std::string_view> words_;
  std::array<std::vector<std::uint16_t>, 256> by_first_byte_;
};

}  // namespace nacre::measurement
