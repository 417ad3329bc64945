#include "measurement/sweep_columns.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <utility>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr std::string_view kFrequencies[] = {
    "frequency",      "freq",          "frequenz", "prueffrequenz", "messfrequenz", "frequence", "frecuencia",
    "frequenza",      "omega",         "ω",        "pulsation",     "pulsazione",   "周波数",    "频率",
    "winkelfrequenz", "kreisfrequenz", "角周波数", "角频率",        "頻率",
};
constexpr std::string_view kAngular[] = {
    "angular",   "angulaire",  "angolare",       "omega",         "ω",
    "pulsation", "pulsazione", "winkelfrequenz", "kreisfrequenz", "角",
};
constexpr std::string_view kOtherFrequencies[] = {
    "resonance", "resonant", "resonanz", "natural", "reduced", "reduziert", "reduzierte",
    "shifted",   "sampling", "cutoff",   "log",     "log10",   "ln",        "lg",
};

constexpr std::string_view kStorageModuli[] = {
    "storage modulus",
    "modulus storage",
    "storage mod",
    "speichermodul",
    "module de conservation",
    "module conservation",
    "module de stockage",
    "modulo de almacenamiento",
    "modulo di conservazione",
    "modulo conservativo",
    "modulo de armazenamento",
    "e prime",
    "eprime",
    "e storage",
    "e stor",
    "貯蔵弾性率",
    "储能模量",
    "儲能模量",
};
constexpr std::string_view kRelaxationModuli[] = {
    "relaxation modulus",     "relax modulus",        "relax mod",  "relaxation mod", "modulus relaxation",
    "relaxationsmodul",       "module de relaxation", "e relax",    "e relaxation",   "modulo de relajacion",
    "modulo di rilassamento", "modulo de relaxacao",  "緩和弾性率", "松弛模量",       "鬆弛模量",
};
constexpr std::string_view kStepTimes[] = {"step", "relaxation", "relax", "hold", "schritt", "segment"};
constexpr std::string_view kOtherModuli[] = {
    "loss",       "verlust",    "verlustmodul", "verlustfaktor",
    "perte",      "perdita",    "perdida",      "dissipation",
    "tan",        "complex",    "komplex",      "komplexer",
    "complexe",   "complesso",  "complejo",     "log",
    "log10",      "ln",         "lg",           "ratio",
    "normalised", "normalized", "reduced",      "shifted",
    "compliance", "error",      "std",          "sd",
    "deviation",  "損失",       "损耗",         "損耗",
    "複素",
};
constexpr std::string_view kShear[] = {
    "shear",        "schub",  "scher",   "schubmodul", "schubspannung", "scherung",   "schermodul", "scherdehnung",
    "cisaillement", "taglio", "cizalla", "torsion",    "torque",        "drehmoment", "せん断",     "剪切",
};

constexpr std::string_view kAmplitudes[] = {
    "amplitude",
    "dehnungsamplitude",
    "verformungsamplitude",
    "amplitud",
    "ampiezza",
    "振幅",
    "oscillation strain",
    "oscillation displacement",
    "dynamic displacement",
    "oscillatory strain",
    "dynamic strain",
    "dynamische dehnung",
    "deformation dynamique",
};
constexpr std::string_view kStaticStrains[] = {
    "static", "statisch",  "statische",  "statique", "statica",    "estatica",
    "offset", "prestrain", "pre-strain", "preload",  "vordehnung", "mean",
};

constexpr std::string_view kTemperatures[] = {
    "temperature", "temperatur", "temperatura", "temp", "ts", "probentemperatur", "ofentemperatur", "温度", "溫度",
};
constexpr std::string_view kOvens[] = {"furnace", "oven", "ofen", "ofentemperatur", "chamber", "four", "forno"};

constexpr std::string_view kSamples[] = {
    "specimen",   "specimen id",  "specimen name", "sample",     "sample id",   "sample name", "probe",
    "probenname", "probekoerper", "pruefkoerper",  "eprouvette", "echantillon", "probeta",     "muestra",
    "provino",    "campione",     "試料",          "試験片",     "试样",        "試樣",
};

bool holds_one(std::span<const std::string_view> words, const std::string& name) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return holds_word(name, word); });
}

struct NamedUnit {
  std::string_view unit;  ///< in plain words
  SweepUnit scale;
};

constexpr double kTurn = 2.0 * std::numbers::pi, kZeroCelsius = 273.15, kFahrenheit = 5.0 / 9.0;
/// The longer first: a heading may end with one of them.
constexpr NamedUnit kFrequencyUnits[] = {
    {"rad/s", {1.0}},   {"rad/sec", {1.0}}, {"rad s-1", {1.0}},     {"rad s^-1", {1.0}},
    {"rad s⁻¹", {1.0}}, {"rad.s-1", {1.0}}, {"rad*s^-1", {1.0}},    {"rad s", {1.0}},
    {"hz", {kTurn}},    {"hertz", {kTurn}}, {"khz", {1e3 * kTurn}}, {"mhz", {1e-3 * kTurn}},
    {"1/s", {kTurn}},   {"s-1", {kTurn}},   {"s^-1", {kTurn}},      {"s⁻¹", {kTurn}},
};
constexpr NamedUnit kTemperatureUnits[] = {
    {"c", {}},
    {"degc", {}},
    {"deg c", {}},
    {"deg. c", {}},
    {"grad c", {}},
    {"celsius", {}},
    {"℃", {}},
    {"k", {1.0, -kZeroCelsius}},
    {"kelvin", {1.0, -kZeroCelsius}},
    {"f", {kFahrenheit, -32.0 * kFahrenheit}},
    {"degf", {kFahrenheit, -32.0 * kFahrenheit}},
    {"deg f", {kFahrenheit, -32.0 * kFahrenheit}},
};

std::optional<SweepUnit> scale_of(std::span<const NamedUnit> units, std::string_view unit) {
  const auto found = std::find_if(units.begin(), units.end(), [&](const NamedUnit& each) { return each.unit == unit; });
  return found == units.end() ? std::nullopt : std::optional(found->scale);
}

/// Primes as people and spreadsheets write them: E' is the storage modulus, E'' the loss modulus.
std::string with_plain_primes(std::string_view heading) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kPrimes = {{{"′", "'"},
                                                                                     {"’", "'"},
                                                                                     {"‘", "'"},
                                                                                     {"´", "'"},
                                                                                     {"`", "'"},
                                                                                     {"″", "''"},
                                                                                     {"”", "''"},
                                                                                     {"“", "''"},
                                                                                     {"\"", "''"}}};
  std::string plain(heading);
  for (const auto& [prime, apostrophes] : kPrimes) {
    for (std::size_t at = plain.find(prime); at != std::string::npos; at = plain.find(prime, at))
      plain.replace(at, prime.size(), apostrophes);
  }
  return plain;
}

/// Whether a name holds `e'` as a symbol of its own: not `e''`.
bool holds_primed(const std::string& name, std::string_view symbol) {
  for (std::size_t at = name.find(symbol); at != std::string::npos; at = name.find(symbol, at + 1)) {
    const bool begins = at == 0 || !((name[at - 1] >= 'a' && name[at - 1] <= 'z') || name[at - 1] == '|');
    const std::size_t end = at + symbol.size();
    if (begins && (end >= name.size() || name[end] != '\'')) return true;
  }
  return false;
}

/// The name with its unit, also where that stands behind it without brackets, `f / hz`, `temp./c`.
ColumnName with_unit_of(const ColumnName& name, std::span<const NamedUnit> units) {
  if (scale_of(units, bare_unit(name.unit))) return name;
  const std::string words = plain_words(name.heading);
  constexpr std::string_view kMarks = " /,:-";
  for (const NamedUnit& each : units) {
    if (!words.ends_with(each.unit)) continue;
    std::string_view before = std::string_view(words).substr(0, words.size() - each.unit.size());
    if (before.empty() || kMarks.find(before.back()) == std::string_view::npos) continue;
    before = before.substr(0, before.find_last_not_of(kMarks) + 1);
    for (const std::string_view in : {" in", " en"}) {
      if (before.ends_with(in)) before.remove_suffix(in.size());
    }
    const std::string_view tail = std::string_view(name.heading).substr(name.heading.size() - each.unit.size());
    ColumnName apart = name;
    apart.name = before;
    apart.unit = plain_words(tail) == each.unit ? tail : each.unit;  // as written where no letter was spelt out
    return apart;
  }
  return name;
}

bool names_frequency(SweepColumn& column) {
  column.name = with_unit_of(column.name, kFrequencyUnits);
  const std::string& name = column.name.name;
  column.is_angular = holds_one(kAngular, name);
  if (name == "f") return scale_of(kFrequencyUnits, bare_unit(column.name.unit)).has_value();
  return holds_one(kFrequencies, name) && !holds_one(kOtherFrequencies, name);
}

bool names_storage_modulus(SweepColumn& column) {
  const std::string& name = column.name.name;
  const bool is_symbol = holds_primed(name, "e'"), is_shear = holds_primed(name, "g'");
  if (!is_symbol && !is_shear && !holds_one(kStorageModuli, name)) return false;
  if (name.find("''") != std::string::npos || name.find('*') != std::string::npos || holds_one(kOtherModuli, name))
    return false;
  column.is_shear = column.is_shear || is_shear;
  column.rank = is_symbol ? 0 : 1;
  return true;
}

bool names_relaxation_modulus(SweepColumn& column) {
  const std::string& name = column.name.name;
  const std::string words = plain_words(column.name.heading);
  const bool is_symbol = words.starts_with("e(t)"), is_shear = words.starts_with("g(t)");
  if (!is_symbol && !is_shear && !holds_one(kRelaxationModuli, name)) return false;
  if (holds_one(kOtherModuli, name)) return false;
  column.is_shear = column.is_shear || is_shear;
  column.rank = is_symbol ? 0 : 1;
  return true;
}

bool names_time(SweepColumn& column) {
  const ColumnName& name = column.name;
  if (name.quantity != Quantity::time || name.is_other) return false;
  column.rank = holds_one(kStepTimes, name.name) ? 0 : 1;
  return true;
}

bool names_stress(SweepColumn& column) {
  const ColumnName& name = column.name;
  column.rank = name.rank;
  return name.quantity == Quantity::stress && !name.is_other && !holds_one(kStaticStrains, name.name);
}

bool names_amplitude(SweepColumn& column) {
  const ColumnName& name = column.name;
  const bool is_strain = name.quantity == Quantity::strain, is_amplitude = holds_one(kAmplitudes, name.name);
  if ((!is_strain && !is_amplitude) || holds_one(kStaticStrains, name.name)) return false;
  column.is_length =
      is_amplitude && !unit_factor(Quantity::strain, name.unit) && unit_factor(Quantity::extension, name.unit);
  if (column.is_length) {
    column.rank = 3;
    return true;
  }
  if (name.unit.empty() ? name.quantity && !is_strain : !unit_factor(Quantity::strain, name.unit)) return false;
  column.rank = set_point_words().finds_one(name.name) ? 2 : is_amplitude ? 0 : 1;
  return true;
}

bool names_temperature(SweepColumn& column) {
  column.name = with_unit_of(column.name, kTemperatureUnits);
  const std::string& name = column.name.name;
  const bool is_symbol = name == "t" && scale_of(kTemperatureUnits, bare_unit(column.name.unit));
  if ((!is_symbol && !holds_one(kTemperatures, name)) || holds_word(name, "rate")) return false;
  column.rank = set_point_words().finds_one(name) || holds_one(kOvens, name) ? 1 : 0;
  return true;
}

}  // namespace

std::string_view to_string(SweepQuantity quantity) {
  constexpr std::array<std::string_view, kSweepQuantities> kWords = {
      "frequency", "storage_modulus", "amplitude", "temperature", "time", "relaxation_modulus", "stress"};
  return kWords[static_cast<std::size_t>(quantity)];
}

std::string_view expected_units(SweepQuantity quantity) {
  constexpr std::string_view kStresses = "Pa, kPa, MPa, GPa, psi";
  constexpr std::array<std::string_view, kSweepQuantities> kUnits = {
      "Hz, kHz, mHz, rad/s", kStresses, "%, mm/mm, ustrain, um", "C, K, F", "s, ms, min, h", kStresses, kStresses};
  return kUnits[static_cast<std::size_t>(quantity)];
}

std::optional<SweepUnit> unit_of_sweep(const SweepColumn& column, std::string_view unit) {
  const std::string bare = bare_unit(unit);
  const auto scaled = [](std::optional<double> factor) {
    return factor ? std::optional(SweepUnit{.factor = *factor}) : std::nullopt;
  };
  if (bare.empty() || !column.quantity) return std::nullopt;
  switch (*column.quantity) {
    case SweepQuantity::frequency:
      if (column.is_angular && bare.find("hz") == std::string::npos && scale_of(kFrequencyUnits, bare))
        return SweepUnit{};
      return scale_of(kFrequencyUnits, bare);
    case SweepQuantity::storage_modulus:
    case SweepQuantity::relaxation_modulus:
    case SweepQuantity::stress:
      return scaled(unit_factor(Quantity::stress, unit));
    case SweepQuantity::amplitude:
      return scaled(unit_factor(column.is_length ? Quantity::extension : Quantity::strain, unit));
    case SweepQuantity::time:
      return scaled(unit_factor(Quantity::time, unit));
    default:
      return scale_of(kTemperatureUnits, bare);
  }
}

bool is_unit_of_sweep(std::string_view unit) {
  return is_unit(unit) || unit == "deg" || scale_of(kFrequencyUnits, unit) || scale_of(kTemperatureUnits, unit);
}

SweepColumn recognise_sweep_column(std::string_view heading, std::string_view unit) {
  SweepColumn column{.name = recognise_column(with_plain_primes(heading), unit)};
  const ColumnName as_read = column.name;
  column.is_shear = holds_one(kShear, column.name.name);
  column.is_sample = std::find(std::begin(kSamples), std::end(kSamples), column.name.name) != std::end(kSamples);
  constexpr std::array<std::pair<SweepQuantity, bool (*)(SweepColumn&)>, kSweepQuantities> kRules = {
      {{SweepQuantity::storage_modulus, names_storage_modulus},
       {SweepQuantity::relaxation_modulus, names_relaxation_modulus},
       {SweepQuantity::frequency, names_frequency},
       {SweepQuantity::temperature, names_temperature},
       {SweepQuantity::amplitude, names_amplitude},
       {SweepQuantity::time, names_time},
       {SweepQuantity::stress, names_stress}}};
  for (const auto& [quantity, is_named] : kRules) {
    column.name = as_read;
    column.is_length = false;
    column.quantity = quantity;
    if (is_named(column)) {
      column.name.heading = heading;
      return column;
    }
  }
  column.name = as_read;
  column.name.heading = heading;
  column.quantity.reset();
  return column;
}

}  // namespace nacre::measurement
