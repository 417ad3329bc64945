#include "measurement/tester_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/csv.hpp"

namespace nacre::measurement {
namespace {

void append_utf8(std::string& text, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0 | point >> 6);
    put(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    put(0xE0 | point >> 12);
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  } else {
    put(0xF0 | point >> 18);
    put(0x80 | (point >> 12 & 0x3F));
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  }
}

constexpr std::uint32_t kReplacementCharacter = 0xFFFD;

Result<std::string> from_utf16(std::string_view bytes, bool low_byte_first) {
  if (bytes.size() % 2 != 0) return fail("UTF-16 text with half a character at its end, expected a whole file");
  const auto unit_at = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(low_byte_first ? a | b << 8 : b | a << 8);
  };
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const std::uint32_t unit = unit_at(i);
    const bool is_surrogate = unit >= 0xD800 && unit < 0xE000;
    const std::uint32_t low = is_surrogate && i + 3 < bytes.size() ? unit_at(i + 2) : 0;
    if (unit < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      append_utf8(text, 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00));
      i += 2;
    } else {
      append_utf8(text, is_surrogate ? kReplacementCharacter : unit);  // half a pair has no meaning
    }
  }
  return text;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// Windows-1252; its few signs between 0x80 and 0x9F, which no name or unit holds, become a question mark.
std::string from_windows_1252(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    append_utf8(text, value >= 0x80 && value < 0xA0 ? '?' : value);
  }
  return text;
}

/// UTF-16 without a mark: Latin text has a zero in every other byte.
std::optional<bool> unmarked_utf16(std::string_view bytes) {
  std::array<std::size_t, 2> zeros{};
  const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 400) & ~std::size_t{1};
  for (std::size_t i = 0; i < looked_at; ++i) zeros[i % 2] += bytes[i] == '\0';
  if (looked_at < 8) return std::nullopt;
  if (zeros[1] * 2 > looked_at * 8 / 10 && zeros[0] == 0) return true;
  if (zeros[0] * 2 > looked_at * 8 / 10 && zeros[1] == 0) return false;
  return std::nullopt;
}

/// Where the quoted cell whose text begins at `begin` is closed; nothing when it never is, or when more of a cell
/// follows: then another cell's quote was met.
std::optional<std::size_t> closing_quote(std::string_view text, std::size_t begin, char delimiter) {
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] != '"') continue;
    if (i + 1 < text.size() && text[i + 1] == '"') {
      ++i;
      continue;
    }
    std::size_t next = i + 1;
    while (next < text.size() && text[next] == ' ') ++next;
    const bool ends = next == text.size() || text[next] == delimiter || text[next] == '\r' || text[next] == '\n';
    return ends ? std::optional(i) : std::nullopt;
  }
  return std::nullopt;
}

/// The row at the head of `text`.
TextRow first_row(std::string_view text, char delimiter) {
  bool at_start = true;  // of a cell
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' || text[i] == '\n') return {.line = 0, .text = text.substr(0, i)};
    if (at_start && text[i] == '"') {
      const auto close = closing_quote(text, i + 1, delimiter);
      const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
      if (!close) return {.line = 0, .text = line, .is_torn = std::count(line.begin(), line.end(), '"') % 2 != 0};
      i = *close;
    }
    at_start = text[i] == delimiter || (at_start && (text[i] == ' ' || text[i] == '\t'));
  }
  return {.line = 0, .text = text};
}

constexpr std::string_view kNoBreakSpace = "\xC2\xA0", kNarrowNoBreakSpace = "\xE2\x80\xAF";

/// `text` with each no-break space as a blank, and none around it.
std::string with_plain_blanks(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t blank = text.starts_with(kNoBreakSpace)         ? kNoBreakSpace.size()
                              : text.starts_with(kNarrowNoBreakSpace) ? kNarrowNoBreakSpace.size()
                                                                      : 0;
    plain += blank > 0 ? ' ' : text.front();
    text.remove_prefix(std::max<std::size_t>(blank, 1));
  }
  return std::string(trimmed(plain));
}

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

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

}  // namespace

Result<std::string> utf8_from_instrument(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xD0\xCF\x11\xE0"))
    return fail("is a workbook, expected a text file: export or save it as CSV");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes.substr(2), true);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes.substr(2), false);
  if (const auto low_byte_first = unmarked_utf16(bytes)) return from_utf16(bytes, *low_byte_first);
  if (bytes.find('\0') != std::string_view::npos) return fail("holds zero bytes, expected a text file");
  return is_utf8(bytes) ? std::string(bytes) : from_windows_1252(bytes);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
  }
  return lines;
}

std::vector<TextRow> rows_of(std::string_view text, char delimiter) {
  std::vector<TextRow> rows;
  for (int line = 1; !text.empty();) {
    TextRow row = first_row(text, delimiter);
    row.line = line;
    rows.push_back(row);
    line += static_cast<int>(std::max<std::size_t>(lines_of(row.text).size(), 1));
    text.remove_prefix(row.text.size());
    text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
  }
  return rows;
}

std::vector<std::string> cells_of(std::string_view line, char delimiter) {
  std::vector<std::string> cells;
  std::string cell;
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (is_quoted) {
      const bool doubled = letter == '"' && i + 1 < line.size() && line[i + 1] == '"';
      if (letter == '"' && !doubled) {
        is_quoted = false;
      } else {
        cell += letter;
        i += doubled;
      }
    } else if (letter == delimiter) {
      cells.emplace_back(trimmed(cell));
      cell.clear();
    } else if (letter == '"' && trimmed(cell).empty()) {
      is_quoted = true;
      cell.clear();
    } else {
      cell += letter;
    }
  }
  cells.emplace_back(trimmed(cell));
  return cells;
}

std::string plain_words(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 31> kSpelt = {{
      {"\xC3\xA4", "ae"},         {"\xC3\xB6", "oe"}, {"\xC3\xBC", "ue"},   {"\xC3\x84", "ae"}, {"\xC3\x96", "oe"},
      {"\xC3\x9C", "ue"},         {"\xC3\x9F", "ss"}, {"\xC3\xA9", "e"},    {"\xC3\xA8", "e"},  {"\xC3\xAA", "e"},
      {"\xC3\x89", "e"},          {"\xC3\xA0", "a"},  {"\xC3\xA2", "a"},    {"\xC3\xA1", "a"},  {"\xC3\xA7", "c"},
      {"\xC3\xAD", "i"},          {"\xC3\xAE", "i"},  {"\xC3\xB3", "o"},    {"\xC3\xB4", "o"},  {"\xC3\xBA", "u"},
      {"\xC3\xBB", "u"},          {"\xC3\xB1", "n"},  {"\xC2\xB5", "u"},    {"\xCE\xBC", "u"},  {kNoBreakSpace, " "},
      {"\xC2\xB2", "2"},          {"\xCE\x94", "d"},  {"\xE2\x82\x82", ""}, {"\xC2\xB0", ""},   {"\xCE\xB5", "strain"},
      {kNarrowNoBreakSpace, " "},
  }};
  std::string plain;
  while (!text.empty()) {
    const auto known =
        std::find_if(kSpelt.begin(), kSpelt.end(), [&](const auto& each) { return text.starts_with(each.first); });
    if (known != kSpelt.end()) {
      plain += known->second;
      text.remove_prefix(known->first.size());
      continue;
    }
    const char letter = text.front();
    const bool is_blank = letter == ' ' || letter == '\t' || letter == '_';
    if (!is_blank || (!plain.empty() && plain.back() != ' '))
      plain += is_blank ? ' ' : letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    text.remove_prefix(1);
  }
  return std::string(trimmed(plain));
}

bool looks_like_number(std::string_view text) {
  return instrument_number(text, DecimalMark::point) || instrument_number(text, DecimalMark::comma);
}

std::optional<DecimalMark> decimal_evidence(std::string_view text) {
  text = trimmed(text);
  if (!looks_like_number(text)) return std::nullopt;
  const std::size_t comma = text.rfind(','), point = text.rfind('.');
  if (comma != std::string_view::npos && point != std::string_view::npos)
    return comma > point ? DecimalMark::comma : DecimalMark::point;
  if (comma != std::string_view::npos && !is_grouped(text, ',')) return DecimalMark::comma;
  if (point != std::string_view::npos && !is_grouped(text, '.')) return DecimalMark::point;
  return std::nullopt;
}

std::optional<double> instrument_number(std::string_view text, DecimalMark mark) {
  const char decimal = mark == DecimalMark::point ? '.' : ',', grouping = mark == DecimalMark::point ? ',' : '.';
  std::string digits;
  bool seen_decimal = false;
  std::string number = with_plain_blanks(text);
  const std::size_t whole_size =
      std::min(number.find_first_of(mark == DecimalMark::point ? ".eE" : ",eE"), number.size());
  const std::string_view whole = std::string_view(number).substr(0, whole_size);
  for (const char group : {grouping, ' '}) {
    if (whole.find(group) != std::string_view::npos && !is_grouped(whole, group)) return std::nullopt;
  }
  number.erase(std::remove(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(whole_size), ' '),
               number.begin() + static_cast<std::ptrdiff_t>(whole_size));
  for (const char letter : number) {
    if (letter == grouping && seen_decimal) return std::nullopt;
    if (letter == grouping || letter == '\'') continue;
    if (letter == decimal) {
      if (seen_decimal) return std::nullopt;
      seen_decimal = true;
    }
    digits += letter == decimal ? '.' : letter;
  }
  const std::string_view unsigned_digits = std::string_view(digits).substr(digits.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(unsigned_digits.data(), unsigned_digits.data() + unsigned_digits.size(), value);
  const bool is_whole = error == std::errc{} && end == unsigned_digits.data() + unsigned_digits.size();
  return is_whole && !unsigned_digits.empty() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace nacre::measurement
