#include "measurement/heading_lines.hpp"

#include <algorithm>

#include "measurement/tester_columns.hpp"
#include "measurement/tester_delimiter.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

bool tells_role(std::string_view cell) {
  if (recognise_column(cell).role != ColumnRole::measured) return true;
  return preferred_words().finds_one(plain_words(cell));
}

}  // namespace

std::vector<std::string> joined_headings(const std::vector<std::string_view>& upper,
                                         const std::vector<std::string_view>& lower) {
  if (upper.size() < 2 || lower.size() < 2 || upper.size() > lower.size() + 1 || lower.size() > upper.size() + 1)
    return {};
  std::vector<std::string> joined;
  std::string_view above;
  for (std::size_t i = 0; i < std::max(upper.size(), lower.size()); ++i) {
    const std::string_view own = i < upper.size() ? upper[i] : std::string_view{};
    const std::string_view below = i < lower.size() ? lower[i] : std::string_view{};
    if (!own.empty() || below.empty() || recognise_column(below).quantity) above = own;
    joined.emplace_back(above);
    if (above.ends_with('-') && !below.empty()) {
      joined.back().pop_back();
    } else if (!above.empty() && !below.empty()) {
      joined.back() += ' ';
    }
    joined.back() += below;
  }
  return joined;
}

bool tells_roles(const std::vector<std::string_view>& cells) {
  std::size_t filled = 0, roles = 0;
  for (const std::string_view cell : cells) {
    if (cell.empty()) continue;
    if (cell.find_first_of("0123456789:") != std::string_view::npos) return false;
    ++filled;
    roles += tells_role(cell);
  }
  const bool is_title = filled == 1 && !cells.front().empty();
  return 2 * roles > filled && !is_title;
}

bool is_unit_row(const std::vector<std::string_view>& cells, bool (*is_known)(std::string_view)) {
  std::size_t units = 0, others = 0;
  for (const std::string_view cell : cells) {
    if (cell.empty()) continue;
    const bool bracketed =
        cell.size() > 2 && (cell.front() == '(' || cell.front() == '[') && (cell.back() == ')' || cell.back() == ']');
    ++(bracketed || (!is_number(cell) && is_known(bare_unit(cell))) ? units : others);
  }
  return units > others;
}

}  // namespace nacre::measurement
