#include "measurement/tester_text.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "base/csv.hpp"

namespace nacre::measurement {
namespace {

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

}  // namespace

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

std::vector<std::string_view> export_lines(std::string_view text) {
  constexpr std::size_t kSearched = 2000, kMostJoined = 6;
  std::vector<std::string_view> lines = lines_of(text);
  const auto quotes = [](std::string_view line) { return std::count(line.begin(), line.end(), '"'); };
  const auto is_torn = [&](std::string_view line) {
    return quotes(line) % 2 != 0 && line.find_first_of("0123456789") == std::string_view::npos;
  };
  for (std::size_t i = 0; i < std::min(lines.size(), kSearched); ++i) {
    if (!is_torn(lines[i])) continue;
    for (std::size_t end = i + 1; end < std::min(lines.size(), i + kMostJoined); ++end) {
      const char* begin = lines[i].data();
      const std::string_view joined(begin, static_cast<std::size_t>(lines[end].data() + lines[end].size() - begin));
      if (quotes(joined) % 2 != 0) continue;
      lines[i] = joined;
      for (std::size_t k = i + 1; k <= end; ++k) lines[k] = {};
      break;
    }
  }
  return lines;
}

std::vector<TextRow> rows_of(std::string_view text, char delimiter) {
  std::vector<TextRow> rows;
  for (int line = 1; !text.empty();) {
    TextRow row = first_row(text, delimiter);
    row.line = line;
    rows.push_back(row);
    line += std::max<std::size_t>(lines_of(row.text).size(), 1);
    text.remove_prefix(row.text.size());
    text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
  }
  return rows;
}

std::string_view delimiter_in_words(char delimiter) {
  switch (delimiter) {
    case '\t':
      return "tab";
    case ';':
      return "semicolon";
    case '|':
      return "bar";
    case kGaps:
    case kBlanks:
      return "blanks";
    default:
      return "comma";
  }
}

std::vector<std::string> cells_of(std::string_view line, char delimiter) {
  if (delimiter == kGaps || delimiter == kBlanks) {
    std::vector<std::string_view> views;
    split_cells(line, delimiter, views);
    return {views.begin(), views.end()};
  }
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

namespace {

void split_at_gaps(std::string_view line, std::vector<std::string_view>& cells) {
  line = trimmed(line);
  while (true) {
    const std::size_t end = std::min(line.find("  "), line.size());
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == line.size()) return;
    line = trimmed(line.substr(end));
  }
}

void split_at_blanks(std::string_view line, std::vector<std::string_view>& cells) {
  constexpr std::string_view kSpaces = " \t";
  while (true) {
    line = trimmed(line);
    if (line.empty()) return;
    const std::size_t end = std::min(line.find_first_of(kSpaces), line.size());
    const std::string_view word = line.substr(0, end);
    const bool is_unit = word.front() == '(' || word.front() == '[';
    const bool is_comment = cells.empty() && (word == "#" || word == "%");
    if (is_comment) {
      // The mark before a heading is none of its words.
    } else if (is_unit && !cells.empty()) {
      cells.back() = {cells.back().data(), static_cast<std::size_t>(word.data() + word.size() - cells.back().data())};
    } else {
      cells.push_back(word);
    }
    line.remove_prefix(end);
  }
}

}  // namespace

void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells) {
  cells.clear();
  if (delimiter == kGaps) return split_at_gaps(line, cells);
  if (delimiter == kBlanks) return split_at_blanks(line, cells);
  while (true) {
    std::size_t end = std::min(line.find(delimiter), line.size());
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.starts_with('"')) {
      const std::size_t open = line.find('"');
      std::size_t close = line.find('"', open + 1);
      while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == '"')
        close = line.find('"', close + 2);
      if (close != std::string_view::npos) {
        end = std::min(line.find(delimiter, close), line.size());
        cell = trimmed(line.substr(open + 1, close - open - 1));
      }
    }
    cells.push_back(cell);
    if (end >= line.size()) return;
    line.remove_prefix(end + 1);
  }
}

namespace {

/// One character of UTF-8, and the plain letters that stand for it in names.
struct Spelling {
  std::string_view character, plain;
};

constexpr std::array kSpellings = {
    Spelling{"ä", "ae"},
    Spelling{"ö", "oe"},
    Spelling{"ü", "ue"},
    Spelling{"Ä", "ae"},
    Spelling{"Ö", "oe"},
    Spelling{"Ü", "ue"},
    Spelling{"ß", "ss"},
    Spelling{"é", "e"},
    Spelling{"è", "e"},
    Spelling{"ê", "e"},
    Spelling{"ë", "e"},
    Spelling{"É", "e"},
    Spelling{"È", "e"},
    Spelling{"à", "a"},
    Spelling{"â", "a"},
    Spelling{"á", "a"},
    Spelling{"À", "a"},
    Spelling{"Á", "a"},
    Spelling{"ã", "a"},
    Spelling{"å", "a"},
    Spelling{"ç", "c"},
    Spelling{"Ç", "c"},
    Spelling{"í", "i"},
    Spelling{"ì", "i"},
    Spelling{"î", "i"},
    Spelling{"ï", "i"},
    Spelling{"Í", "i"},
    Spelling{"ó", "o"},
    Spelling{"ò", "o"},
    Spelling{"ô", "o"},
    Spelling{"õ", "o"},
    Spelling{"Ó", "o"},
    Spelling{"ø", "o"},
    Spelling{"ú", "u"},
    Spelling{"ù", "u"},
    Spelling{"û", "u"},
    Spelling{"Ú", "u"},
    Spelling{"ñ", "n"},
    Spelling{"Ñ", "n"},
    Spelling{"µ", "u"},
    Spelling{"μ", "u"},
    Spelling{"²", "2"},
    Spelling{"³", "3"},
    Spelling{"Δ", "d"},
    Spelling{"∆", "d"},
    Spelling{"₂", ""},
    Spelling{"°", ""},
    Spelling{"ε", "strain"},
    Spelling{"σ", "stress"},
    Spelling{"​", ""},
    Spelling{"\xC2\xA0", " "},
    Spelling{"\xE2\x80\xAF", " "},
    Spelling{"\xE2\x80\x89", " "},
    Spelling{"\xE3\x80\x80", " "},
    Spelling{"【", "["},
    Spelling{"】", "]"},
    Spelling{"〔", "["},
    Spelling{"〕", "]"},
    Spelling{"［", "["},
    Spelling{"］", "]"},
    Spelling{"｛", "["},
    Spelling{"｝", "]"},
    Spelling{"「", "["},
    Spelling{"」", "]"},
    Spelling{"『", "["},
    Spelling{"』", "]"},
    Spelling{"〈", "["},
    Spelling{"〉", "]"},
    Spelling{"《", "["},
    Spelling{"》", "]"},
    Spelling{"∕", "/"},
    Spelling{"⁄", "/"},
    Spelling{"−", "-"},
    Spelling{"–", "-"},
    Spelling{"‰", "permille"},
    Spelling{"㎜", "mm"},
    Spelling{"㎝", "cm"},
    Spelling{"㎛", "um"},
    Spelling{"㎳", "ms"},
    Spelling{"㎏", "kg"},
    Spelling{"㎫", "mpa"},
    Spelling{"㎪", "kpa"},
    Spelling{"㎬", "gpa"},
    Spelling{"％", "%"},
    Spelling{"·", " "},
};

/// Full-width ASCII (U+FF01 to U+FF5E), or nothing.
std::optional<char> full_width(std::string_view text) {
  if (text.size() < 3 || static_cast<unsigned char>(text[0]) != 0xEF) return std::nullopt;
  const auto lead = static_cast<unsigned char>(text[1]), trail = static_cast<unsigned char>(text[2]);
  if (lead == 0xBC && trail >= 0x81) return static_cast<char>(trail - 0x81 + '!');
  if (lead == 0xBD && trail <= 0x9E) return static_cast<char>(trail - 0x80 + '`');
  return std::nullopt;
}

/// The spellings by their first byte.
const std::array<std::vector<const Spelling*>, 256>& spellings() {
  static const auto table = [] {
    std::array<std::vector<const Spelling*>, 256> all;
    for (const Spelling& each : kSpellings) all[static_cast<unsigned char>(each.character.front())].push_back(&each);
    return all;
  }();
  return table;
}

/// Replaces the first character of `text` by plain letters at the end of `plain`.
void spell_out(std::string_view& text, std::string& plain) {
  for (const Spelling* known : spellings()[static_cast<unsigned char>(text.front())]) {
    if (!text.starts_with(known->character)) continue;
    if (known->plain != " " || (!plain.empty() && plain.back() != ' ')) plain += known->plain;
    return text.remove_prefix(known->character.size());
  }
  if (const auto letter = full_width(text)) {
    plain += *letter >= 'A' && *letter <= 'Z' ? static_cast<char>(*letter - 'A' + 'a') : *letter;
    text.remove_prefix(3);
  } else {
    plain += text.front();
    text.remove_prefix(1);
  }
}

}  // namespace

std::string plain_words(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const char letter = text.front();
    if (static_cast<unsigned char>(letter) >= 0x80) {
      spell_out(text, plain);
      continue;
    }
    const bool is_blank = letter == ' ' || letter == '\t' || letter == '_' || letter == '\r' || letter == '\n';
    if (!is_blank || (!plain.empty() && plain.back() != ' '))
      plain += is_blank ? ' ' : letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    text.remove_prefix(1);
  }
  return std::string(trimmed(plain));
}

}  // namespace nacre::measurement
