#include "measurement/column_choice.hpp"

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {

int match(std::string_view heading, std::string_view name_without_unit, std::string_view wanted) {
  if (wanted.empty() || heading.empty()) return 0;
  if (trimmed(heading) == trimmed(wanted)) return 3;
  const std::string plain = plain_words(wanted), words = plain_words(heading);
  if (plain.empty()) return 0;
  if (plain == words || plain == name_without_unit) return 2;
  return holds_word(words, plain) ? 1 : 0;
}

}  // namespace nacre::measurement
