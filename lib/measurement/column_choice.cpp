#include "measurement/column_choice.hpp"

#include <algorithm>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {

std::vector<std::string> units_of_sheet(const ColumnChoice& choice) {
  std::vector<std::string> units;
  for (std::size_t begin = 0; begin < choice.unit.size();) {
    const std::size_t end = std::min(choice.unit.find_first_of(" ,;", begin), choice.unit.size());
    if (end > begin) units.push_back(choice.unit.substr(begin, end - begin));
    begin = end + 1;
  }
  return units;
}

int match(std::string_view heading, std::string_view name_without_unit, std::string_view wanted) {
  if (wanted.empty() || heading.empty()) return 0;
  if (trimmed(heading) == trimmed(wanted)) return 3;
  const std::string plain = plain_words(wanted), words = plain_words(heading);
  if (plain.empty()) return 0;
  if (plain == words || plain == name_without_unit) return 2;
  return holds_word(words, plain) ? 1 : 0;
}

}  // namespace nacre::measurement
