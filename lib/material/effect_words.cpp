#include "material/effect_words.hpp"

#include <algorithm>

namespace nacre::material {

std::string effect_in_words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string unit_behind_number(std::string_view unit) { return unit == "1" ? "" : " " + std::string(unit); }

}  // namespace nacre::material
