#include "measurement/tester_columns.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

/// Words of names that tell that an extension is the travel of the grips; extensometers have a rank of their own.
const WordFinder& grip_words() {
  static constexpr std::string_view kWords[] = {"crosshead",
                                                "cross head",
                                                "travel",
                                                "traverse",
                                                "traversenweg",
                                                "traversenposition",
                                                "weg",
                                                "verfahrweg",
                                                "stroke",
                                                "standardweg",
                                                "course",
                                                "carrera",
                                                "corsa",
                                                "cruceta",
                                                "traversa",
                                                "querhaupt",
                                                "querhauptweg",
                                                "maschinenweg",
                                                "kolbenweg",
                                                "actuator",
                                                "piston",
                                                "grip separation",
                                                "jaw separation",
                                                "jaw travel",
                                                "ストローク",
                                                "クロスヘッド",
                                                "横梁",
                                                "夹头位移",
                                                "行程"};
  static const WordFinder finder(kWords);
  return finder;
}
constexpr int kExtensometerRank = 9;

/// Parts of the machine: another word of the heading tells what was measured there (`Actuator Force`).
constexpr std::array<std::string_view, 12> kPlaces = {"actuator",  "crosshead",    "cross head", "traverse",
                                                      "querhaupt", "traversa",     "cruceta",    "横梁",
                                                      "橫樑",      "クロスヘッド", "作动器",     "夹头"};

/// German words that begin or end compounds (Sollkraft, Kraftsollwert, Breitenaenderung), of one kind.
bool is_in_compound(std::string_view name, std::span<const std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    const std::size_t at = name.find(word);
    return at != std::string_view::npos && !(word == "quer" && name.substr(at).starts_with("querhaupt"));
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

/// Whether each bracket of the text is closed in it.
bool is_balanced(std::string_view text) {
  int depth = 0;
  for (const char letter : text) {
    depth += kBrackets.find(letter) != std::string_view::npos;
    depth -= kClosing.find(letter) != std::string_view::npos;
    if (depth < 0) return false;
  }
  return depth == 0;
}

/// A factor before a unit, `1/100` or `10^-3`, belongs to it; so does a number after `in`.
std::optional<NameAndUnit> unit_at_the_end(const std::string& name) {
  for (const std::string_view mark : {" in ", " en ", "/", " ", ",", ":", "-"}) {
    const std::size_t at = name.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string_view tail = std::string_view(name).substr(at + mark.size());
    const std::string unit = bare_unit(tail);
    const bool has_number = !unit.empty() && unit.front() >= '0' && unit.front() <= '9';
    if (!is_balanced(tail) || !is_bare_unit(unit) || (has_number && mark.size() < 2)) continue;
    const std::string_view before = trimmed(std::string_view(name).substr(0, at));
    const std::size_t word = before.find_last_of(' ') + 1;
    const std::string_view last = before.substr(word);
    if (last.find_first_of("0123456789") != std::string_view::npos &&
        last.find_first_of("/^*") != std::string_view::npos)
      return NameAndUnit{std::string(trimmed(before.substr(0, word))), std::string(last) + " " + unit};
    return NameAndUnit{std::string(before), unit};
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
  const std::vector<FoundQuantity> names = quantities_in(name);
  const auto is_whole = [&](const FoundQuantity& each) { return each.name->word == name; };
  if (std::any_of(names.begin(), names.end(), is_whole)) return {name, ""};  // `Fecha y hora` is not in hours
  if (auto found = unit_at_the_end(name)) return *found;
  if (auto found = unit_between(name)) return *found;
  const std::vector<Bracketed> groups = brackets_of(name);
  constexpr std::size_t kLongestUnit = 12;
  if (groups.empty() || groups.back().end != name.size() || groups.back().begin == 0) return {name, ""};
  const std::string& last = groups.back().text;
  if (last.empty() || last.size() > kLongestUnit || !quantities_in(last).empty()) return {name, ""};
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

bool is_place(std::string_view word) { return std::find(kPlaces.begin(), kPlaces.end(), word) != kPlaces.end(); }

/// The longest name that a heading holds, then the one with the smallest rank; a place only where nothing else is said.
void find_quantity(ColumnName& column, const std::vector<FoundQuantity>& found) {
  const NamedQuantity* best = nullptr;
  const auto order = [](const NamedQuantity& name) {
    return std::tuple(is_place(name.word), -static_cast<std::ptrdiff_t>(name.word.size()), name.rank);
  };
  for (const FoundQuantity& each : found) {
    if (each.name->word.size() <= 2 && column.name != each.name->word) continue;
    if (best == nullptr || order(*each.name) < order(*best)) best = each.name;
  }
  if (best == nullptr) return;
  column.quantity = best->quantity;
  column.rank = best->rank;
}

/// Whether another word than that of the quantity decides: a strain or a stress named after a column of extension or
/// force, `maximum`, `rate`.
void find_other_meaning(ColumnName& column, const std::vector<FoundQuantity>& found) {
  const auto of = [&](Quantity quantity) {
    return std::any_of(found.begin(), found.end(), [&](const FoundQuantity& each) {
      return each.name->quantity == quantity && each.name->word.size() > 3;
    });
  };
  if (column.quantity == Quantity::extension && of(Quantity::strain)) column.quantity = Quantity::strain;
  if (column.quantity && *column.quantity != Quantity::stress && of(Quantity::stress))
    column.quantity = Quantity::stress;
  std::string name = column.name;
  for (const std::string_view harmless : {"change in length", "time at", "test number"}) {
    if (const std::size_t at = name.find(harmless); at != std::string::npos) name.erase(at, harmless.size());
  }
  column.is_other = other_words().finds_one(name);
  if (column.quantity == Quantity::time && column.rank >= 4 && !holds_word(name, "rate")) column.is_other = false;
}

/// Whether words are left in a name beside its quantity's and harmless ones: `Grip Force`, `命令位移`.
bool has_qualifier(std::string_view name, Quantity quantity, const std::vector<FoundQuantity>& found) {
  std::vector<bool> known(name.size(), false);
  const auto mark = [&](std::size_t begin, std::size_t size) {
    std::fill_n(known.begin() + static_cast<std::ptrdiff_t>(begin), size, true);
  };
  for (const FoundQuantity& each : found) {
    if (each.name->quantity == quantity) mark(each.begin, each.name->word.size());
  }
  for (const WordFinder* words : {&harmless_words(), &preferred_words(), &specimen_words()}) {
    for (const FoundWord& each : words->find_all(name)) mark(each.begin, words->words()[each.index].size());
  }
  std::size_t letters = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_digit = name[i] >= '0' && name[i] <= '9';
    if (is_digit) i = std::min(name.find_first_of(" ()[].-_", i), name.size() - 1);  // a label, `5kn`, `t7`
    const bool is_letter =
        !is_digit && ((name[i] >= 'a' && name[i] <= 'z') || static_cast<unsigned char>(name[i]) > 127);
    letters = is_letter && !known[i] ? letters + 1 : 0;
    if (letters > 1) return true;
  }
  return false;
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
  constexpr std::array<std::string_view, 6> kSetPointParts = {"soll",    "vorgabe",  "setpoint",
                                                              "command", "consigne", "ziel"};
  constexpr std::array<std::string_view, 1> kRawParts = {"rohwert"};
  constexpr std::array<std::string_view, 2> kLateralParts = {"quer", "breite"};
  constexpr int kSlightly = 1;
  if (column.quantity == Quantity::time) return;
  const std::string& name = column.name;
  const bool is_nominal = column.quantity == Quantity::strain || column.quantity == Quantity::stress;
  if (lateral_words().finds_one(name) || is_in_compound(name, kLateralParts)) column.role = ColumnRole::lateral;
  if (raw_words().finds_one(name) || is_in_compound(name, kRawParts)) column.role = ColumnRole::raw;
  if (!is_nominal && (set_point_words().finds_one(name) || is_in_compound(name, kSetPointParts)))
    column.role = ColumnRole::set_point;
  column.rank = 2 * column.rank + (preferred_words().finds_one(name) ? 0 : kSlightly);
}

Gauge gauge_of(std::string_view name, const std::vector<FoundQuantity>& found) {
  const bool is_extensometer = std::any_of(found.begin(), found.end(), [](const FoundQuantity& each) {
    return each.name->quantity == Quantity::extension && each.name->rank == kExtensometerRank;
  });
  if (is_extensometer) return Gauge::extensometer;
  return grip_words().finds_one(name) ? Gauge::grips : Gauge::unknown;
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
  const std::vector<FoundQuantity> found = quantities_in(column.name);
  find_quantity(column, found);
  find_other_meaning(column, found);
  correct_by_unit(column, column.unit, !unit.empty() && column.unit == unit);
  if (column.quantity && known && is_unit(bare_unit(unit)) &&
      unit_factor(*column.quantity, unit) != unit_factor(*column.quantity, column.unit))
    column.other_unit = unit;
  if (column.is_other) column.quantity.reset();
  if (column.quantity) column.is_qualified = has_qualifier(column.name, *column.quantity, found);
  find_role(column);
  const auto specimens = specimen_words().words();
  column.is_specimen = std::any_of(specimens.begin(), specimens.end(), [&](std::string_view word) {
    return column.name == word || (column.name.ends_with('.') && column.name.substr(0, column.name.size() - 1) == word);
  });
  if (column.quantity == Quantity::extension) column.gauge = gauge_of(column.name, found);
  return column;
}

}  // namespace nacre::measurement
