#include "base/names.hpp"

#include <algorithm>
#include <charconv>

namespace nacre {

bool is_plain_name(std::string_view name, std::size_t most_bytes, std::string_view also) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  const auto holds = [](std::string_view letters, char letter) { return letters.find(letter) != letters.npos; };
  return !name.empty() && name.size() <= most_bytes &&
         std::ranges::all_of(name, [&](char letter) { return holds(kLetters, letter) || holds(also, letter); });
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  return result;
}

std::optional<int> number_between(std::string_view before, std::string_view after, std::string_view id) {
  if (!id.starts_with(before)) return std::nullopt;
  id.remove_prefix(before.size());
  int number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  if (error != std::errc{} || id.front() == '-') return std::nullopt;
  id.remove_prefix(static_cast<std::size_t>(end - id.data()));
  return id.starts_with(after) ? std::optional(number) : std::nullopt;
}

}  // namespace nacre
