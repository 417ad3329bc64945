#include "measurement/word_finder.hpp"

namespace nacre::measurement {

bool is_east_asian(std::string_view word) { return !word.empty() && static_cast<unsigned char>(word[0]) >= 0xE3; }

WordFinder::WordFinder(std::span<const std::string_view> words) : words_(words.begin(), words.end()) {
  for (std::size_t i = 0; i < words_.size(); ++i)
    by_first_byte_[static_cast<unsigned char>(words_[i].front())].push_back(static_cast<std::uint16_t>(i));
}

/// Calls `found(index, begin)` for every word that stands in the text, until it says true.
template <class Found>
void WordFinder::search(std::string_view text, const Found& found) const {
  const auto is_letter = [&](std::size_t i) { return i < text.size() && text[i] >= 'a' && text[i] <= 'z'; };
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool may_begin = at == 0 || !is_letter(at - 1);
    for (const std::uint16_t index : by_first_byte_[static_cast<unsigned char>(text[at])]) {
      const std::string_view word = words_[index];
      if (!text.substr(at).starts_with(word)) continue;
      if (!is_east_asian(word) && (!may_begin || is_letter(at + word.size()))) continue;
      if (found(index, at)) return;
    }
  }
}

bool WordFinder::finds_one(std::string_view text) const {
  bool any = false;
  search(text, [&](std::size_t, std::size_t) { return any = true; });
  return any;
}

std::vector<FoundWord> WordFinder::find_all(std::string_view text) const {
  std::vector<FoundWord> all;
  search(text, [&](std::size_t index, std::size_t begin) {
    all.push_back({index, begin});
    return false;
  });
  return all;
}

}  // namespace nacre::measurement
