#include "measurement/tester_delimiter.hpp"

#include <algorithm>

#include "measurement/cell_units.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t,;|\"\r") == std::string_view::npos; }

bool has_letter(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           static_cast<unsigned char>(letter) > 127;
  });
}

bool is_number(std::string_view cell) {
  if (cell.empty()) return false;
  return instrument_number(cell, DecimalMark::point) || looks_like_number(cell);
}

bool is_measured(std::string_view cell) { return is_number(cell) || number_with_unit(cell).has_value(); }

std::size_t filled(const Cells& cells) {
  return std::count_if(cells.begin(), cells.end(), [](auto cell) { return !cell.empty(); });
}

double score_of(const std::vector<std::string_view>& lines, char delimiter) {
  constexpr std::size_t kLooked = 600;  // lines with digits
  double score = 0.0;
  std::size_t looked = 0;
  Cells cells;
  for (std::size_t i = 0; i < lines.size() && looked < kLooked; ++i) {
    const std::string_view line = lines[i];
    if (line.size() > 4000 || line.find_first_of("0123456789") == std::string_view::npos) continue;
    ++looked;
    split_cells(line, delimiter, cells);
    if (cells.size() < 2) continue;
    const auto numbers = static_cast<double>(std::count_if(cells.begin(), cells.end(), is_measured));
    if (numbers >= 2.0) score += numbers - 2.0 * (static_cast<double>(filled(cells)) - numbers);
  }
  return score;
}

char delimiter_of(const std::vector<std::string_view>& lines) {
  char best = '\0';
  double most = 0.0;
  for (const char delimiter : {'\t', ';', ',', '|'}) {
    const double score = score_of(lines, delimiter);
    if (score <= most) continue;
    most = score;
    best = delimiter;
  }
  return best;
}

}  // namespace nacre::measurement
