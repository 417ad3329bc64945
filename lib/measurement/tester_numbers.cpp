#include "measurement/tester_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "base/csv.hpp"

namespace nacre::measurement {
namespace {

/// Whether every letter is one that std::from_chars() and the marks know, so that no sign has to be rewritten.
bool is_plain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char letter) {
    return is_digit(letter) || letter == '.' || letter == ',' || letter == '-' || letter == '+' || letter == 'e' ||
           letter == 'E';
  });
}

/// Letters that stand in numbers; all beyond ASCII may be signs.
constexpr std::array<bool, 256> kOfNumbers = [] {
  std::array<bool, 256> table{};
  for (const char letter : std::string_view("0123456789.,-+eE' ")) table[static_cast<unsigned char>(letter)] = true;
  for (std::size_t byte = 0x80; byte < table.size(); ++byte) table[byte] = true;
  return table;
}();

/// Whether no letter speaks against a number. Most cells of a header are words: they are told by their first letter.
bool may_be_number(std::string_view text) {
  bool any_digit = false;
  for (const char letter : text) {
    if (!kOfNumbers[static_cast<unsigned char>(letter)]) return false;
    any_digit = any_digit || is_digit(letter) || letter == '\xEF';  // full-width digits
  }
  return any_digit;
}

struct Sign {
  std::string_view utf8;
  char plain;
};

/// No-break, narrow no-break, thin and figure spaces; typographic apostrophes; true and full-width minus signs.
constexpr Sign kSigns[] = {{"\xC2\xA0", ' '},      {"\xE2\x80\xAF", ' '}, {"\xE2\x80\x89", ' '}, {"\xE2\x80\x87", ' '},
                           {"\xE2\x80\x99", '\''}, {"\xCA\xBC", '\''},    {"\xC2\xB4", '\''},    {"\xE2\x88\x92", '-'},
                           {"\xEF\xBC\x8D", '-'},  {"\xE2\x80\x93", '-'}, {"\xE2\x80\x92", '-'}, {"\xEF\xBC\x8B", '+'},
                           {"\xEF\xBC\x8C", ','},  {"\xEF\xBC\x8E", '.'}};

/// `text` with plain signs, ASCII digits, and no blank around it.
std::string with_plain_signs(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    if (static_cast<unsigned char>(text.front()) < 0x80) {
      plain += text.front();
      text.remove_prefix(1);
      continue;
    }
    const auto sign = std::find_if(std::begin(kSigns), std::end(kSigns),
                                   [&](const Sign& each) { return text.starts_with(each.utf8); });
    if (sign != std::end(kSigns)) {
      plain += sign->plain;
      text.remove_prefix(sign->utf8.size());
    } else if (text.size() >= 3 && text.starts_with("\xEF\xBC") && static_cast<unsigned char>(text[2]) >= 0x90 &&
               static_cast<unsigned char>(text[2]) <= 0x99) {  // full-width digits
      plain += static_cast<char>('0' + static_cast<unsigned char>(text[2]) - 0x90);
      text.remove_prefix(3);
    } else {
      plain += text.front();
      text.remove_prefix(1);
    }
  }
  return std::string(trimmed(plain));
}

bool has_exponent(std::string_view number) { return number.find_first_of("eE") != std::string_view::npos; }

/// Digits in groups of three: `1,234` or `12.345.678` with `mark` between them.
bool is_grouped(std::string_view number, char mark) {
  number = number.substr(0, number.find_first_of("eE"));
  while (!number.empty() && (number.front() == '-' || number.front() == '+')) number.remove_prefix(1);
  std::size_t group = 0;
  bool first = true;
  for (std::size_t i = 0; i <= number.size(); ++i) {
    if (i < number.size() && is_digit(number[i])) {
      ++group;
      continue;
    }
    if (i < number.size() && number[i] != mark) return false;
    if (first ? group < 1 || group > 3 : group != 3) return false;
    first = false;
    group = 0;
  }
  return number.front() != '0';
}

std::optional<double> from_plain(std::string_view digits) {
  if (digits.starts_with('+')) digits.remove_prefix(1);
  if (digits.empty() || digits.starts_with('+')) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = error == std::errc{} && end == digits.data() + digits.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The general way, for numbers with groups or with signs that are not plain.
std::optional<double> general_number(std::string_view text, DecimalMark mark) {
  const char decimal = mark == DecimalMark::point ? '.' : ',', grouping = mark == DecimalMark::point ? ',' : '.';
  std::string digits;
  bool seen_decimal = false;
  std::string number = with_plain_signs(text);
  const std::size_t whole_size =
      std::min(number.find_first_of(mark == DecimalMark::point ? ".eE" : ",eE"), number.size());
  const std::string_view whole = std::string_view(number).substr(0, whole_size);
  const bool has_decimal = whole_size < number.size() && number[whole_size] == decimal;
  if (has_exponent(number) && !has_decimal && whole.find(grouping) != std::string_view::npos) return std::nullopt;
  for (const char group : {grouping, ' ', '\''}) {
    if (whole.find(group) != std::string_view::npos && !is_grouped(whole, group)) return std::nullopt;
  }
  const auto is_group = [](char letter) { return letter == ' ' || letter == '\''; };
  const auto end_of_whole = number.begin() + static_cast<std::ptrdiff_t>(whole_size);
  number.erase(std::remove_if(number.begin(), end_of_whole, is_group), end_of_whole);
  for (const char letter : number) {
    if (letter == grouping && seen_decimal) return std::nullopt;
    if (letter == grouping) continue;
    if (letter == decimal) {
      if (seen_decimal) return std::nullopt;
      seen_decimal = true;
    }
    digits += letter == decimal ? '.' : letter;
  }
  return from_plain(digits);
}

std::optional<DecimalMark> evidence_of(std::string_view text) {
  const std::size_t comma = text.rfind(','), point = text.rfind('.');
  if (comma != std::string_view::npos && point != std::string_view::npos)
    return comma > point ? DecimalMark::comma : DecimalMark::point;
  const bool exponent = has_exponent(text);
  if (comma != std::string_view::npos && (exponent || !is_grouped(text, ','))) return DecimalMark::comma;
  if (point != std::string_view::npos && (exponent || !is_grouped(text, '.'))) return DecimalMark::point;
  return std::nullopt;
}

}  // namespace

bool looks_like_number(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text.size() > 60) return false;
  if (text.find_first_of("0123456789") == std::string_view::npos && text.find("\xEF\xBC") == std::string_view::npos)
    return false;
  return instrument_number(text, DecimalMark::point) || instrument_number(text, DecimalMark::comma);
}

std::optional<DecimalMark> decimal_evidence(std::string_view text) {
  text = trimmed(text);
  if (text.find_first_of(",.\xEF") == std::string_view::npos || !looks_like_number(text)) return std::nullopt;
  return is_plain(text) ? evidence_of(text) : evidence_of(with_plain_signs(text));
}

std::optional<double> instrument_number(std::string_view text, DecimalMark mark) {
  text = trimmed(text);
  if (!may_be_number(text)) return std::nullopt;
  if (is_plain(text)) {
    const bool comma = text.find(',') != std::string_view::npos;
    if (!comma && (mark == DecimalMark::point || text.find('.') == std::string_view::npos)) return from_plain(text);
    if (comma && mark == DecimalMark::comma && text.find('.') == std::string_view::npos && text.size() < 40 &&
        text.find(',') == text.rfind(',')) {
      char digits[40];
      std::replace_copy(text.begin(), text.end(), digits, ',', '.');
      return from_plain({digits, text.size()});
    }
  }
  return general_number(text, mark);
}

ColumnMark column_mark(std::span<const std::string_view> cells) {
  ColumnMark found;
  std::size_t marked = 0, unmarked_small = 0, unmarked_large = 0;
  std::optional<DecimalMark> grouped_by;
  bool one_mark = true;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string_view cell = cells[i];
    const std::size_t at = cell.find_first_of(",.");
    if (at == std::string_view::npos) {
      const auto value = instrument_number(cell, DecimalMark::point);
      if (value && *value != 0.0) ++(std::abs(*value) < 1000.0 ? unmarked_small : unmarked_large);
      continue;
    }
    const auto evidence = decimal_evidence(cell);
    if (!evidence) {
      const DecimalMark mark = cell[at] == ',' ? DecimalMark::comma : DecimalMark::point;
      one_mark = one_mark && grouped_by.value_or(mark) == mark;
      grouped_by = mark;
      ++marked;
    } else if (!found.mark) {
      found.mark = evidence;
      found.first = i;
    } else if (*found.mark != *evidence) {
      found.contradiction = i;
      return found;
    }
  }
  constexpr std::size_t kEnough = 3;  // numbers of either kind
  if (!found.mark && one_mark && marked >= kEnough && unmarked_small >= kEnough && unmarked_large == 0)
    found.mark = *grouped_by == DecimalMark::comma ? DecimalMark::point : DecimalMark::comma;
  if (!found.mark && one_mark) found.lone = grouped_by;
  return found;
}

std::optional<double> clock_seconds(std::string_view text) {
  text = trimmed(text);
  if (text.find(':') == std::string_view::npos) return std::nullopt;
  if (text.ends_with('Z')) text.remove_suffix(1);
  if (const std::size_t zone = text.find_last_of("+-"); zone != std::string_view::npos && zone > text.find(':'))
    text = text.substr(0, zone);
  const std::size_t before = text.find_last_of(" T", text.find(':'));
  double days = 0.0;
  if (before != std::string_view::npos) text.remove_prefix(before + 1);
  for (const std::string_view half : {" AM", " PM", " am", " pm"}) {
    if (!text.ends_with(half)) continue;
    text.remove_suffix(half.size());
    days += (half[1] == 'P' || half[1] == 'p') && !text.starts_with("12") ? 43200.0 : 0.0;
  }
  double seconds = 0.0;
  int fields = 0;
  while (!text.empty() && fields < 3) {
    const std::size_t end = std::min(text.find(':'), text.size());
    const std::string_view field = text.substr(0, end);
    const bool last = end == text.size();
    const auto value =
        instrument_number(field, field.find(',') != std::string_view::npos ? DecimalMark::comma : DecimalMark::point);
    if (!value || *value < 0.0 || (!last && *value != std::floor(*value))) return std::nullopt;
    seconds = 60.0 * seconds + *value;
    ++fields;
    text.remove_prefix(last ? end : end + 1);
  }
  return fields >= 2 && text.empty() ? std::optional(seconds + days) : std::nullopt;
}

}  // namespace nacre::measurement
