#include "measurement/tester_columns.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

/// Words of names that tell where an extension was recorded; any other name is ambiguous.
constexpr std::array<std::string_view, 12> kGripWords = {"crosshead", "travel", "traverse",    "traversenweg",
                                                         "weg",       "stroke", "standardweg", "course",
                                                         "carrera",   "corsa",  "ストローク",  "横梁"};
constexpr std::array<std::string_view, 11> kExtensometerWords = {"extensometer", "laengenaenderungsaufnehmer",
                                                                 "feindehnung",  "feindehnungsaufnehmer",
                                                                 "wegaufnehmer", "extensometre",
                                                                 "extensometro", "estensimetro",
                                                                 "estensometro", "伸び計",
                                                                 "引伸计"};

template <class Words>
bool holds_any(std::string_view name, const Words& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return holds_word(name, word); });
}

/// Whether the name holds a marker, or a compound word that begins or ends with one (Sollkraft, Kraftsollwert).
bool holds_marker(std::string_view name, std::span<const std::string_view> words) {
  constexpr std::size_t kLongEnough = 4;
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    if (holds_word(name, word)) return true;
    if (word.size() < kLongEnough) return false;
    const std::size_t at = name.find(word);
    const bool german = word == "soll" || word == "sollwert" || word == "vorgabe" || word == "rohwert" ||
                        word == "setpoint" || word == "command" || word == "consigne" || word == "quer" ||
                        word == "breite";
    if (at == std::string_view::npos || !german) return false;
    return !(word == "quer" && name.substr(at).starts_with("querhaupt"));
  });
}

constexpr std::string_view kBrackets = "([{<", kClosing = ")]}>";

/// The text of a heading in brackets, and its place.
struct Bracketed {
  std::size_t begin = 0, end = 0;  ///< with the brackets
  std::string text;
};

/// Outermost brackets, first to last; those that are never closed are left out.
std::vector<Bracketed> brackets_of(std::string_view name) {
  std::vector<Bracketed> found;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (kBrackets.find(name[i]) != std::string_view::npos && depth++ == 0) begin = i;
    if (kClosing.find(name[i]) == std::string_view::npos || depth == 0 || --depth > 0) continue;
    found.push_back({begin, i + 1, std::string(trimmed(name.substr(begin + 1, i - begin - 1)))});
  }
  return found;
}

struct NameAndUnit {
  std::string name, unit;
};

/// A unit that may stand without brackets: a number or a sign would be part of a name.
bool is_bare_unit(std::string_view unit) {
  return unit != "1" && unit != "-" && unit != "strain" && unit != "ratio" && unit != "count" && unit != "step" &&
         unit != "steps" && unit != "counts" && is_unit(unit);
}

std::optional<NameAndUnit> unit_in_brackets(const std::string& name) {
  const std::vector<Bracketed> groups = brackets_of(name);
  const auto without = [&](const Bracketed& group) {
    return std::string(trimmed(std::string(trimmed(name.substr(0, group.begin))) + " " +
                               std::string(trimmed(std::string_view(name).substr(group.end)))));
  };
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    const std::string first(trimmed(group->text.substr(0, group->text.find_first_of(",;"))));
    for (const std::string& unit : {group->text, first}) {
      if (group->begin > 0 && is_unit(unit)) return NameAndUnit{without(*group), unit};
    }
  }
  return std::nullopt;
}

std::optional<NameAndUnit> unit_at_the_end(const std::string& name) {
  for (const std::string_view mark : {" in ", " en ", "/", " ", ",", ":", "-"}) {
    const std::size_t at = name.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string unit = bare_unit(std::string_view(name).substr(at + mark.size()));
    if (is_bare_unit(unit)) return NameAndUnit{std::string(trimmed(std::string_view(name).substr(0, at))), unit};
  }
  return std::nullopt;
}

/// `Position mm Run 1`: a unit of two letters and more as a word of its own.
std::optional<NameAndUnit> unit_between(const std::string& name) {
  for (const std::string_view unit : {" mm ", " kn ", " lbf ", " cm ", " um ", " kgf ", " sec "}) {
    const std::size_t at = name.find(unit);
    if (at == std::string::npos || at == 0) continue;
    return NameAndUnit{name.substr(0, at) + name.substr(at + unit.size() - 1), std::string(trimmed(unit))};
  }
  return std::nullopt;
}

/// Takes the unit out of a name in plain words; a last bracket that is no known unit is one that nobody knows, unless
/// it holds a word of headings.
NameAndUnit unit_apart(const std::string& name) {
  if (auto found = unit_in_brackets(name)) return *found;
  if (auto found = unit_at_the_end(name)) return *found;
  if (auto found = unit_between(name)) return *found;
  const std::vector<Bracketed> groups = brackets_of(name);
  constexpr std::size_t kLongestUnit = 12;
  if (groups.empty() || groups.back().end != name.size() || groups.back().begin == 0) return {name, ""};
  const std::string& last = groups.back().text;
  const auto is_known = [&](const NamedQuantity& each) { return holds_word(last, each.word); };
  if (last.empty() || last.size() > kLongestUnit ||
      std::any_of(quantity_names().begin(), quantity_names().end(), is_known))
    return {name, ""};
  return {std::string(trimmed(std::string_view(name).substr(0, groups.back().begin))), last};
}

/// A unit as the heading writes it, in its brackets if it has some: its case tells mega from milli.
std::string as_written(std::string_view heading, const std::string& unit) {
  std::string lower;
  for (const char letter : heading) lower += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter;
  const std::size_t at = lower.rfind(unit);
  if (at == std::string::npos || unit.empty()) return unit;
  const bool bracketed = at > 0 && at + unit.size() < heading.size() &&
                         kBrackets.find(heading[at - 1]) != std::string_view::npos &&
                         kClosing.find(heading[at + unit.size()]) != std::string_view::npos;
  return std::string(bracketed ? heading.substr(at - 1, unit.size() + 2) : heading.substr(at, unit.size()));
}

/// The longest name that a heading holds, then the one with the smallest rank.
void find_quantity(ColumnName& column) {
  int best = 100;
  std::size_t longest = 0;
  for (const NamedQuantity& word : quantity_names()) {
    const bool is_short = word.word.size() <= 2;
    if (is_short ? column.name != word.word : !holds_word(column.name, word.word)) continue;
    if (word.word.size() < longest || (word.word.size() == longest && word.rank >= best)) continue;
    longest = word.word.size();
    best = word.rank;
    column.quantity = word.quantity;
    column.rank = word.rank;
  }
}

/// Whether another word than that of the quantity decides: a strain or a stress named after a column of extension or
/// force, `maximum`, `rate`.
void find_other_meaning(ColumnName& column) {
  const auto of = [&](Quantity quantity) {
    return std::any_of(quantity_names().begin(), quantity_names().end(), [&](const NamedQuantity& each) {
      return each.quantity == quantity && each.word.size() > 3 && holds_word(column.name, each.word);
    });
  };
  if (column.quantity == Quantity::extension && of(Quantity::strain)) column.quantity = Quantity::strain;
  if (column.quantity && *column.quantity != Quantity::stress && of(Quantity::stress))
    column.quantity = Quantity::stress;
  std::string name = column.name;
  for (const std::string_view harmless : {"change in length", "time at", "test number"}) {
    if (const std::size_t at = name.find(harmless); at != std::string::npos) name.erase(at, harmless.size());
  }
  column.is_other = holds_any(name, other_words());
  if (column.quantity == Quantity::time && column.rank >= 4 && !holds_word(name, "rate")) column.is_other = false;
}

/// A unit of another quantity corrects the name, or tells the meaning of one letter.
void correct_by_unit(ColumnName& column, std::string_view unit, bool has_own_row) {
  constexpr int kByLetter = 7, kByUnit = 8;
  const auto is_of = [&](Quantity quantity) { return unit_factor(quantity, unit).has_value(); };
  if (unit.empty()) return;
  if (is_raw_unit(bare_unit(unit))) {
    if (column.role == ColumnRole::measured) column.role = ColumnRole::raw;
    return;
  }
  if (!column.quantity) {
    const bool is_letter = column.name.size() <= 2 && !column.name.empty();
    const bool starts_with_number = column.name.find_first_of("0123456789+-.,") == 0;
    const bool is_marked = has_own_row || kBrackets.find(unit.front()) != std::string_view::npos;
    if (column.is_other || column.name.empty() || starts_with_number || (!is_letter && !is_marked)) return;
    for (const Quantity quantity : {Quantity::time, Quantity::extension, Quantity::force}) {
      if (!is_of(quantity)) continue;
      column.quantity = quantity;
      column.rank = is_letter ? kByLetter : kByUnit;
    }
    return;
  }
  if (is_of(*column.quantity)) return;
  if (column.quantity == Quantity::extension && is_of(Quantity::strain)) column.quantity = Quantity::strain;
  if (column.quantity == Quantity::force && is_of(Quantity::stress)) column.quantity = Quantity::stress;
  if (column.quantity == Quantity::stress && is_of(Quantity::force)) column.quantity = Quantity::force;
  if (column.quantity == Quantity::strain && is_of(Quantity::extension)) column.is_other = true;
}

void find_role(ColumnName& column) {
  constexpr int kSlightly = 1;
  if (column.quantity == Quantity::time) return;
  if (holds_marker(column.name, lateral_words())) column.role = ColumnRole::lateral;
  if (holds_marker(column.name, raw_words())) column.role = ColumnRole::raw;
  if (holds_marker(column.name, set_point_words())) column.role = ColumnRole::set_point;
  column.rank = 2 * column.rank + (holds_any(column.name, preferred_words()) ? 0 : kSlightly);
}

Gauge gauge_of(std::string_view name) {
  if (holds_any(name, kExtensometerWords)) return Gauge::extensometer;
  return holds_any(name, kGripWords) ? Gauge::grips : Gauge::unknown;
}

}  // namespace

std::string bare_unit(std::string_view unit) {
  std::string bare = plain_words(unit);
  while (!bare.empty() && kBrackets.find(bare.front()) != std::string_view::npos) bare.erase(bare.begin());
  while (!bare.empty() && kClosing.find(bare.back()) != std::string_view::npos) bare.pop_back();
  return std::string(trimmed(bare));
}

std::string unit_as_written(std::string_view unit) {
  std::string written(trimmed(unit));
  std::erase_if(written, [](char c) { return std::string_view("()[]{}<>").find(c) != std::string_view::npos; });
  return written;
}

std::string_view base_unit(Quantity quantity) {
  constexpr std::array<std::string_view, kQuantities> kUnits = {"s", "mm", "N", "1", "Pa"};
  return kUnits[static_cast<std::size_t>(quantity)];
}

std::string_view expected_names(Quantity quantity) {
  constexpr std::array<std::string_view, kQuantities> kNames = {
      "Time, Pruefzeit", "Extension, Displacement, Crosshead, Standardweg", "Force, Load, Standardkraft",
      "Strain, Dehnung", "Stress, Spannung"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::string_view expected_units(Quantity quantity) {
  constexpr std::array<std::string_view, kQuantities> kNames = {"s, ms, min, h", "mm, cm, m, um, in, mil, ft",
                                                                "N, kN, mN, MN, daN, lbf, kip, kgf, gf",
                                                                "%, mm/mm, ustrain", "MPa, kPa, GPa, Pa, psi, ksi"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::optional<double> unit_factor(Quantity quantity, std::string_view unit) {
  // Milli and mega differ in the first letter's case alone.
  if (quantity == Quantity::force && unit.find("MN") != std::string_view::npos && bare_unit(unit) == "mn") return 1e6;
  return named_unit(quantity, bare_unit(unit));
}

ColumnName recognise_column(std::string_view heading) { return recognise_column(heading, {}); }

ColumnName recognise_column(std::string_view heading, std::string_view unit) {
  constexpr std::size_t kLongestHeading = 200;  // bytes
  ColumnName column;
  column.heading = heading;
  if (heading.size() > kLongestHeading) return column;
  const NameAndUnit apart = unit_apart(plain_words(heading));
  column.name = apart.name;
  column.unit = as_written(heading, apart.unit);
  const bool known = !apart.unit.empty() && is_unit(apart.unit);
  if (!unit.empty() && !known && (apart.unit.empty() || is_unit(bare_unit(unit)))) column.unit = unit;
  find_quantity(column);
  find_other_meaning(column);
  correct_by_unit(column, column.unit, !unit.empty() && column.unit == unit);
  if (column.is_other) column.quantity.reset();
  find_role(column);
  column.is_specimen = std::any_of(specimen_words().begin(), specimen_words().end(), [&](std::string_view word) {
    return column.name == word || (column.name.ends_with('.') && column.name.substr(0, column.name.size() - 1) == word);
  });
  if (column.quantity == Quantity::extension) column.gauge = gauge_of(column.name);
  return column;
}

}  // namespace nacre::measurement
