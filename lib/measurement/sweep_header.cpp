#include "measurement/sweep_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/csv.hpp"
#include "measurement/sweep_columns.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr std::array<std::string_view, 18> kLengths = {
    "length",   "sample length", "specimen length", "gauge length", "gage length", "free length",
    "laenge",   "probenlaenge",  "einspannlaenge",  "freie laenge", "messlaenge",  "longueur",
    "longitud", "lunghezza",     "comprimento",     "試料長",       "試料長さ",    "试样长度"};
constexpr std::array<std::string_view, 16> kLimits = {"start", "initial", "final",   "end",       "minimum", "maximum",
                                                      "min",   "max",     "range",   "first",     "last",    "lowest",
                                                      "limit", "highest", "bereich", "per decade"};

/// A line as words before its first number, the number, and what is behind it.
struct KeyAndNumber {
  std::string key, number, unit;
};

/// `1.0 Hz` -> the longest number that it begins with, and the rest.
std::optional<std::pair<std::string, std::string>> number_and_rest(std::string_view cell) {
  for (std::size_t end = cell.size(); end > 0; --end) {
    const std::string_view number = trimmed(cell.substr(0, end));
    if (looks_like_number(number)) return std::pair(std::string(number), std::string(trimmed(cell.substr(end))));
  }
  return std::nullopt;
}

bool is_digits(std::string_view text) { return std::ranges::all_of(text, is_digit); }

std::optional<KeyAndNumber> key_and_number(std::string_view line, char delimiter) {
  std::vector<std::string> tokens;
  for (const std::string& cell : cells_of(line, delimiter)) {
    const std::size_t colon = tokens.empty() ? cell.find(':') : std::string::npos;
    tokens.push_back(cell.substr(0, colon));
    if (colon != std::string::npos) tokens.emplace_back(trimmed(std::string_view(cell).substr(colon + 1)));
  }
  KeyAndNumber found;
  for (std::size_t k = 0; k < tokens.size(); ++k) {
    const auto number = k > 0 ? number_and_rest(tokens[k]) : std::nullopt;
    if (number) {
      found.number = number->first;
      // A decimal comma in a file whose cells commas part: `17,5 mm` is no `17`.
      const auto rest = k + 1 < tokens.size() && delimiter == ',' ? number_and_rest(tokens[k + 1]) : std::nullopt;
      if (rest && number->second.empty() && !rest->second.empty() && is_digits(number->first)) {
        found.number += "," + rest->first;
        found.unit = rest->second;
        return found;
      }
      found.unit = number->second.empty() && k + 1 < tokens.size() ? tokens[k + 1] : number->second;
      return found;
    }
    if (!tokens[k].empty()) found.key += (found.key.empty() ? "" : " ") + tokens[k];
  }
  return std::nullopt;
}

/// Numbers by what they are; of two that differ neither counts.
class HeaderReader {
 public:
  void read(std::string_view line, int number, char delimiter) {
    const auto found = key_and_number(line, delimiter);
    if (!found) return;
    const auto value = instrument_number(found->number, decimal_evidence(found->number).value_or(DecimalMark::point));
    if (!value || *value <= 0.0) return;
    const auto put = [&](Place& place, const SweepUnit& unit) {
      const HeaderNumber own{unit.base(*value), number, std::string(trimmed(found->number + " " + found->unit))};
      place.differs = place.differs || (place.number && place.number->value != own.value);
      if (!place.number) place.number = own;
    };
    const SweepColumn column = recognise_sweep_column(found->key, found->unit);
    const std::string& name = column.name.name;
    const auto unit = unit_of_sweep(column, column.name.unit);
    const bool is_limit =
        std::ranges::any_of(kLimits, [&](std::string_view word) { return holds_word(plain_words(found->key), word); });
    if (column.quantity == SweepQuantity::frequency && unit && !is_limit) put(frequency_, *unit);
    if (column.quantity == SweepQuantity::amplitude && unit && !is_limit)
      put(column.is_length ? amplitude_mm_ : amplitude_, *unit);
    const auto length = unit_factor(Quantity::extension, column.name.unit);
    if (length && std::ranges::find(kLengths, name) != kLengths.end()) put(length_mm_, {.factor = *length});
  }

  SweepHeader header() const { return {frequency_.told(), amplitude_.told(), amplitude_mm_.told(), length_mm_.told()}; }

 private:
  struct Place {
    std::optional<HeaderNumber> number;
    bool differs = false;
    std::optional<HeaderNumber> told() const { return differs ? std::nullopt : number; }
  };
  Place frequency_, amplitude_, amplitude_mm_, length_mm_;
};

}  // namespace

SweepHeader sweep_header_of(std::span<const std::string_view> lines, int first_line, char delimiter) {
  HeaderReader reader;
  for (std::size_t i = 0; i < lines.size(); ++i) reader.read(lines[i], first_line + static_cast<int>(i), delimiter);
  return reader.header();
}

SweepHeader with_missing_of(SweepHeader header, const SweepHeader& other) {
  if (!header.angular_frequency_per_s) header.angular_frequency_per_s = other.angular_frequency_per_s;
  if (!header.amplitude && !header.amplitude_mm) {
    header.amplitude = other.amplitude;
    header.amplitude_mm = other.amplitude_mm;
  }
  if (!header.length_mm) header.length_mm = other.length_mm;
  return header;
}

}  // namespace nacre::measurement
