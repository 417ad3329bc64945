#include "measurement/tester_columns.hpp"

#include <algorithm>
#include <array>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

struct NamedUnit {
  Quantity quantity;
  std::string_view name;
  double factor;
};

constexpr double kInchMm = 25.4, kPoundForceN = 4.4482216152605, kKilogramForceN = 9.80665;
constexpr std::array kUnits = {
    NamedUnit{Quantity::time, "s", 1.0},
    NamedUnit{Quantity::time, "sec", 1.0},
    NamedUnit{Quantity::time, "secs", 1.0},
    NamedUnit{Quantity::time, "second", 1.0},
    NamedUnit{Quantity::time, "seconds", 1.0},
    NamedUnit{Quantity::time, "sek", 1.0},
    NamedUnit{Quantity::time, "ms", 1e-3},
    NamedUnit{Quantity::time, "msec", 1e-3},
    NamedUnit{Quantity::time, "min", 60.0},
    NamedUnit{Quantity::time, "minutes", 60.0},
    NamedUnit{Quantity::time, "h", 3600.0},
    NamedUnit{Quantity::time, "hr", 3600.0},
    NamedUnit{Quantity::extension, "mm", 1.0},
    NamedUnit{Quantity::extension, "cm", 10.0},
    NamedUnit{Quantity::extension, "m", 1000.0},
    NamedUnit{Quantity::extension, "um", 1e-3},
    NamedUnit{Quantity::extension, "in", kInchMm},
    NamedUnit{Quantity::extension, "in.", kInchMm},
    NamedUnit{Quantity::extension, "inch", kInchMm},
    NamedUnit{Quantity::extension, "inches", kInchMm},
    NamedUnit{Quantity::extension, "\"", kInchMm},
    NamedUnit{Quantity::extension, "mil", 1e-3 * kInchMm},
    NamedUnit{Quantity::extension, "mils", 1e-3 * kInchMm},
    NamedUnit{Quantity::extension, "ft", 12 * kInchMm},
    NamedUnit{Quantity::force, "n", 1.0},
    NamedUnit{Quantity::force, "newton", 1.0},
    NamedUnit{Quantity::force, "kn", 1e3},
    NamedUnit{Quantity::force, "mn", 1e-3},
    NamedUnit{Quantity::force, "dan", 10.0},
    NamedUnit{Quantity::force, "lbf", kPoundForceN},
    NamedUnit{Quantity::force, "lb", kPoundForceN},
    NamedUnit{Quantity::force, "lbs", kPoundForceN},
    NamedUnit{Quantity::force, "klbf", 1e3 * kPoundForceN},
    NamedUnit{Quantity::force, "kip", 1e3 * kPoundForceN},
    NamedUnit{Quantity::force, "kips", 1e3 * kPoundForceN},
    NamedUnit{Quantity::force, "ozf", kPoundForceN / 16},
    NamedUnit{Quantity::force, "kgf", kKilogramForceN},
    NamedUnit{Quantity::force, "kp", kKilogramForceN},
    NamedUnit{Quantity::force, "gf", 1e-3 * kKilogramForceN},
};

struct NamedQuantity {
  Quantity quantity;
  std::string_view word;  ///< the name is this, or holds it as whole words
  int rank;
};

/// In English, German, French, Spanish, Italian. An extensometer measures a part of the specimen: it is taken only
/// where it is asked for, or is the only one.
constexpr std::array kWords = {
    NamedQuantity{Quantity::extension, "extension", 0},
    NamedQuantity{Quantity::extension, "standard travel", 1},
    NamedQuantity{Quantity::extension, "standardweg", 1},
    NamedQuantity{Quantity::extension, "displacement", 2},
    NamedQuantity{Quantity::extension, "crosshead", 3},
    NamedQuantity{Quantity::extension, "crosshead travel", 3},
    NamedQuantity{Quantity::extension, "traverse", 3},
    NamedQuantity{Quantity::extension, "traversenweg", 3},
    NamedQuantity{Quantity::extension, "weg", 3},
    NamedQuantity{Quantity::extension, "travel", 3},
    NamedQuantity{Quantity::extension, "elongation", 3},
    NamedQuantity{Quantity::extension, "verlaengerung", 3},
    NamedQuantity{Quantity::extension, "allongement", 3},
    NamedQuantity{Quantity::extension, "deplacement", 3},
    NamedQuantity{Quantity::extension, "desplazamiento", 3},
    NamedQuantity{Quantity::extension, "spostamento", 3},
    NamedQuantity{Quantity::extension, "allungamento", 3},
    NamedQuantity{Quantity::extension, "alargamiento", 3},
    NamedQuantity{Quantity::extension, "stroke", 4},
    NamedQuantity{Quantity::extension, "position", 5},
    NamedQuantity{Quantity::extension, "verformung", 6},
    NamedQuantity{Quantity::extension, "deformation", 6},
    NamedQuantity{Quantity::extension, "extensometer", 9},
    NamedQuantity{Quantity::extension, "laengenaenderungsaufnehmer", 9},
    NamedQuantity{Quantity::extension, "feindehnung", 9},
    NamedQuantity{Quantity::extension, "dl", 3},
    NamedQuantity{Quantity::extension, "laengenaenderung", 3},
    NamedQuantity{Quantity::force, "force", 0},
    NamedQuantity{Quantity::force, "standard force", 0},
    NamedQuantity{Quantity::force, "standardkraft", 0},
    NamedQuantity{Quantity::force, "load", 1},
    NamedQuantity{Quantity::force, "kraft", 1},
    NamedQuantity{Quantity::force, "pruefkraft", 1},
    NamedQuantity{Quantity::force, "charge", 1},
    NamedQuantity{Quantity::force, "effort", 1},
    NamedQuantity{Quantity::force, "fuerza", 1},
    NamedQuantity{Quantity::force, "carga", 1},
    NamedQuantity{Quantity::force, "forza", 1},
    NamedQuantity{Quantity::force, "carico", 1},
    NamedQuantity{Quantity::force, "last", 1},
    NamedQuantity{Quantity::force, "f", 2},
    NamedQuantity{Quantity::time, "test time", 0},
    NamedQuantity{Quantity::time, "pruefzeit", 0},
    NamedQuantity{Quantity::time, "running time", 0},
    NamedQuantity{Quantity::time, "elapsed time", 0},
    NamedQuantity{Quantity::time, "time", 1},
    NamedQuantity{Quantity::time, "zeit", 1},
    NamedQuantity{Quantity::time, "temps", 1},
    NamedQuantity{Quantity::time, "tiempo", 1},
    NamedQuantity{Quantity::time, "tempo", 1},
    NamedQuantity{Quantity::time, "t", 2},
};

/// Words of names that tell where an extension was recorded; any other name is ambiguous.
constexpr std::array<std::string_view, 7> kGripWords = {"crosshead", "travel", "traverse",   "traversenweg",
                                                        "weg",       "stroke", "standardweg"};
constexpr std::array<std::string_view, 3> kExtensometerWords = {"extensometer", "laengenaenderungsaufnehmer",
                                                                "feindehnung"};

/// Words that give a name of the list another meaning.
constexpr std::array<std::string_view, 18> kOthers = {"strain", "stress", "dehnung", "spannung", "rate",  "date",
                                                      "speed",  "cell",   "count",   "maximum",  "max",   "zeitstempel",
                                                      "true",   "at",     "bei",     "break",    "bruch", "yield"};

bool holds_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const auto is_letter = [&](std::size_t i) { return i < text.size() && text[i] >= 'a' && text[i] <= 'z'; };
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(end)) return true;
  }
  return false;
}

Gauge gauge_of(std::string_view name) {
  const auto is_held = [&](std::string_view word) { return holds_word(name, word); };
  if (std::any_of(kExtensometerWords.begin(), kExtensometerWords.end(), is_held)) return Gauge::extensometer;
  return std::any_of(kGripWords.begin(), kGripWords.end(), is_held) ? Gauge::grips : Gauge::unknown;
}

std::string bare_unit(std::string_view unit) {
  std::string bare = plain_words(unit);
  while (!bare.empty() && (bare.front() == '(' || bare.front() == '[')) bare.erase(bare.begin());
  while (!bare.empty() && (bare.back() == ')' || bare.back() == ']')) bare.pop_back();
  return std::string(trimmed(bare));
}

/// Takes the unit off the end of a heading; empty when there is none.
std::string take_unit(std::string& name) {
  for (const auto& [open, close] : {std::pair('(', ')'), std::pair('[', ']')}) {
    if (name.empty() || name.back() != close) continue;
    const std::size_t begin = name.rfind(open);
    if (begin == std::string::npos || begin == 0) continue;
    const std::string unit = bare_unit(std::string_view(name).substr(begin));
    name = std::string(trimmed(std::string_view(name).substr(0, begin)));
    return unit;
  }
  for (const std::string_view mark : {" in ", "/", " ", ","}) {
    const std::size_t at = name.rfind(mark);
    if (at == std::string::npos || at == 0) continue;
    const std::string unit = bare_unit(std::string_view(name).substr(at + mark.size()));
    const auto is_unit = [&](const NamedUnit& each) { return each.name == unit; };
    if (std::none_of(kUnits.begin(), kUnits.end(), is_unit)) continue;
    name = std::string(trimmed(std::string_view(name).substr(0, at)));
    return unit;
  }
  return "";
}

/// The unit at the end of a heading as it is written, in its brackets if it has some.
std::string unit_as_written(std::string_view heading) {
  heading = trimmed(heading);
  const bool is_bracketed = heading.ends_with(')') || heading.ends_with(']');
  // The last byte of a no-break space ends a blank, too; no unit holds it.
  const std::size_t at =
      is_bracketed ? heading.rfind(heading.back() == ')' ? '(' : '[') : heading.find_last_of(" \t_/,\xA0");
  if (at == std::string_view::npos) return std::string(heading);
  return std::string(heading.substr(is_bracketed ? at : at + 1));
}

}  // namespace

std::string_view to_string(Quantity quantity) {
  constexpr std::array<std::string_view, 3> kNames = {"time", "extension", "force"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::string_view expected_names(Quantity quantity) {
  constexpr std::array<std::string_view, 3> kNames = {
      "Time, Pruefzeit", "Extension, Displacement, Crosshead, Standardweg", "Force, Load, Standardkraft"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::string_view expected_units(Quantity quantity) {
  constexpr std::array<std::string_view, 3> kNames = {"s, ms, min, h", "mm, cm, m, um, in, mil, ft",
                                                      "N, kN, mN, MN, daN, lbf, kip, kgf, gf"};
  return kNames[static_cast<std::size_t>(quantity)];
}

std::optional<double> unit_factor(Quantity quantity, std::string_view unit) {
  const std::string bare = bare_unit(unit);
  // Milli and mega differ in the first letter's case alone.
  if (quantity == Quantity::force && unit.find("MN") != std::string_view::npos) return 1e6;
  for (const NamedUnit& each : kUnits) {
    if (each.quantity == quantity && each.name == bare) return each.factor;
  }
  return std::nullopt;
}

ColumnName recognise_column(std::string_view heading) {
  ColumnName column{.heading = std::string(heading), .quantity = {}, .rank = 0, .unit = {}, .gauge = Gauge::unknown};
  std::string name = plain_words(heading);
  const bool is_other = std::any_of(kOthers.begin(), kOthers.end(), [&](auto word) { return holds_word(name, word); });
  const std::string unit = take_unit(name);
  if (!unit.empty()) column.unit = unit_as_written(heading);  // its case tells mega from milli
  if (is_other) return column;
  int best = 100;
  std::size_t longest = 0;
  for (const NamedQuantity& word : kWords) {
    const bool is_short = word.word.size() <= 2;
    if (is_short ? name != word.word : !holds_word(name, word.word)) continue;
    if (word.word.size() < longest || (word.word.size() == longest && word.rank >= best)) continue;
    longest = word.word.size();
    best = word.rank;
    column.quantity = word.quantity;
    column.rank = word.rank;
  }
  if (column.quantity == Quantity::extension) column.gauge = gauge_of(name);
  return column;
}

std::size_t best_column(const std::vector<ColumnName>& columns, Quantity quantity, std::string_view wanted) {
  std::size_t best = columns.size();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!wanted.empty()) {
      if (holds_word(plain_words(columns[i].heading), plain_words(wanted))) return i;
      continue;
    }
    if (columns[i].quantity == quantity && (best == columns.size() || columns[i].rank < columns[best].rank)) best = i;
  }
  return best;
}

}  // namespace nacre::measurement
