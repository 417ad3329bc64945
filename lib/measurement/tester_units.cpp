// Part of the vocabulary of headings (tester_vocabulary.hpp): units.
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {
namespace {

constexpr double kInchMm = 25.4, kPoundForceN = 4.4482216152605, kKilogramForceN = 9.80665;

struct UnitNames {
  Quantity quantity;
  double factor;
  std::string_view names;  ///< each followed by a semicolon
};

constexpr UnitNames kUnits[] = {
    {Quantity::time, 1,
     "s;sec;secs;second;seconds;sek;sekunde;sekunden;seconde;secondes;segundo;segundos;seg;secondo;secondi;秒;"},
    {Quantity::time, 0.001,
     "ms;msec;msecs;millisecond;milliseconds;millisekunde;millisekunden;milliseconde;millisecondes;milisegundos;"
     "millisecondi;毫秒;ミリ秒;"},
    {Quantity::time, 1e-06, "us;microseconds;microsecond;微秒;マイクロ秒;"},
    {Quantity::time, 60, "min;mins;minute;minutes;minuten;minuto;minutos;minuti;分;分钟;分鐘;"},
    {Quantity::time, 3600, "h;hr;hrs;hour;hours;stunde;stunden;std;heure;heures;hora;horas;ora;ore;小时;小時;"},
    {Quantity::extension, 1,
     "mm;millimeter;millimeters;millimetre;millimetres;milimetro;milimetros;millimetro;millimetri;毫米;ミリ;"
     "ミリメートル;"},
    {Quantity::extension, 10,
     "cm;centimeter;centimeters;centimetre;centimetres;zentimeter;centimetro;centimetros;centimetri;厘米;"
     "センチメートル;"},
    {Quantity::extension, 1000, "m;meter;meters;metre;metres;metro;metros;metri;米;メートル;"},
    {Quantity::extension, 0.001,
     "um;micron;microns;micrometer;micrometers;micrometre;micrometres;mikrometer;micrometros;micrometro;micrometri;"
     "微米;マイクロメートル;ミクロン;"},
    {Quantity::time, 86400, "day;days;tag;tage;jour;jours;dia;dias;giorno;giorni;天;日;"},
    {Quantity::extension, 1e-06, "nm;nanometer;nanometers;"},
    {Quantity::extension, 100, "dm;decimeter;decimeters;dezimeter;"},
    {Quantity::extension, 36 * kInchMm, "yd;yard;yards;"},
    {Quantity::extension, kInchMm, "in;inch;inches;zoll;pouce;pouces;pulgada;pulgadas;pollice;pollici;\";英寸;インチ;"},
    {Quantity::extension, 1e-3 * kInchMm, "mil;mils;thou;"},
    {Quantity::extension, 12 * kInchMm, "ft;feet;foot;fuss;"},
    {Quantity::force, 1, "n;newton;newtons;牛;牛顿;牛頓;ニュートン;"},
    {Quantity::force, 1000.0, "kn;kilonewton;kilonewtons;千牛;キロニュートン;"},
    {Quantity::force, 0.001, "mn;millinewton;millinewtons;"},
    {Quantity::force, 10, "dan;decanewton;decanewtons;dekanewton;decanewton;"},
    {Quantity::force, 0.01, "cn;centinewton;"},
    {Quantity::force, 0.1, "dn;decinewton;decinewtons;"},
    {Quantity::force, kPoundForceN,
     "lbf;lb;lbs;lbsf;lb f;pound;pounds;pound-force;pounds-force;pound force;pounds "
     "force;libra;libras;libbre;livres;ポンド;磅;磅力;"},
    {Quantity::force, 1e3 * kPoundForceN, "klbf;klb;kip;kips;kilopound;kilopounds;kilopound-force;"},
    {Quantity::force, kPoundForceN / 16, "ozf;oz;ounce;ounces;ounce-force;"},
    {Quantity::force, kKilogramForceN,
     "kilogramos fuerza;kilogramo fuerza;kilogramos-fuerza;kilogramme force;kilogramme-force;kilogrammes-force;"
     "chilogrammi;chilogrammi forza;kg "
     "fuerza;kgf;kg;kp;kilopond;kilogram;kilograms;kilogram-force;kilogramm;kilogrammes;kilogramos;kg-f;kg "
     "f;公斤;千克;千克力;公斤力;"},
    {Quantity::force, 1e-3 * kKilogramForceN, "gf;g;pond;gram;grams;gram-force;gramm;克;"},
    {Quantity::force, 1e3 * kKilogramForceN, "tf;ton-force;tonf;"},
    {Quantity::strain, 1, "mm/mm;m/m;in/in;in./in.;inch/inch;1;-;strain;ratio;"},
    {Quantity::strain, 0.01, "%;pct;percent;per cent;prozent;pour cent;%gl;百分比;"},
    {Quantity::strain, 0.001, "permille;mm/m;mstrain;millistrain;milli strain;"},
    {Quantity::strain, 1e-06, "ustrain;microstrain;micro strain;um/m;ue;ustr;ppm;"},
    {Quantity::stress, 1, "pa;n/m2;n/m^2;pascal;"},
    {Quantity::stress, 1000.0, "kpa;kn/m2;"},
    {Quantity::stress, 1000000.0, "mpa;n/mm2;n/mm^2;n/mm 2;megapascal;mn/m2;兆帕;メガパスカル;"},
    {Quantity::stress, 1000000000.0, "gpa;kn/mm2;kn/mm^2;"},
    {Quantity::stress, 100000.0, "bar;"},
    {Quantity::stress, 6894.757293168, "psi;lbf/in2;lbf/in^2;"},
    {Quantity::stress, 6894757.293168, "ksi;kip/in2;"},
    {Quantity::stress, 1e6 * kKilogramForceN, "kgf/mm2;kgf/mm^2;kg/mm2;"},
};

/// Of signals that are not calibrated.
constexpr std::string_view kRawUnits =
    "v;mv;volt;volts;mv/v;counts;count;cts;bits;bit;steps;step;digits;lsb;adc;pulses;ticks;";

/// What a unit's name means in each quantity.
using UnitFactors = std::array<std::optional<double>, kQuantities>;

const std::unordered_map<std::string_view, UnitFactors>& units() {
  static const auto table = [] {
    std::unordered_map<std::string_view, UnitFactors> all;
    for (const UnitNames& each : kUnits) {
      for (std::string_view rest = each.names; !rest.empty(); rest.remove_prefix(rest.find(';') + 1))
        all[rest.substr(0, rest.find(';'))][static_cast<std::size_t>(each.quantity)] = each.factor;
    }
    return all;
  }();
  return table;
}

const UnitFactors* known_unit(std::string_view unit) {
  if (unit.empty()) return nullptr;
  auto found = units().find(unit);
  if (found == units().end() && unit.size() > 1 && unit.ends_with('.'))
    found = units().find(unit.substr(0, unit.size() - 1));
  return found == units().end() ? nullptr : &found->second;
}

std::optional<double> whole_of(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

struct ScaledUnit {
  double factor = 1.0;
  std::string_view unit;  ///< empty: a mere number
};

/// `10^-3 mm`, `1/100 mm`, `0.1 s`, `10 n`, `10^-6`: so many of a unit. Not `x 10 n`, which may mean either.
std::optional<ScaledUnit> scaled_unit(std::string_view unit) {
  if (unit.empty() || unit.front() < '0' || unit.front() > '9') return std::nullopt;
  ScaledUnit scaled;
  const auto first = whole_of(unit);
  if (!first) return std::nullopt;
  scaled.factor = *first;
  const bool is_power = unit.starts_with('^'), is_share = unit.starts_with('/');
  if (is_power || is_share) {
    unit.remove_prefix(1);
    if (unit.empty() || (is_share && (unit.front() < '0' || unit.front() > '9'))) return std::nullopt;
    const auto second = whole_of(unit);
    if (!second) return std::nullopt;
    scaled.factor = is_power ? std::pow(*first, *second) : *first / *second;
  }
  if (!(scaled.factor > 0.0) || !std::isfinite(scaled.factor)) return std::nullopt;
  if (!unit.empty() && unit.front() != ' ') return std::nullopt;
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit.empty() && !is_power) return std::nullopt;
  scaled.unit = unit;
  return scaled;
}

}  // namespace

std::optional<double> named_unit(Quantity quantity, std::string_view unit) {
  if (const UnitFactors* known = known_unit(unit)) return (*known)[static_cast<std::size_t>(quantity)];
  const auto scaled = scaled_unit(unit);
  if (!scaled) return std::nullopt;
  if (scaled->unit.empty()) return quantity == Quantity::strain ? std::optional(scaled->factor) : std::nullopt;
  const UnitFactors* known = known_unit(scaled->unit);
  const auto factor = known ? (*known)[static_cast<std::size_t>(quantity)] : std::nullopt;
  return factor ? std::optional(scaled->factor * *factor) : std::nullopt;
}

bool is_raw_unit(std::string_view unit) {
  for (std::string_view rest = kRawUnits; !rest.empty() && !unit.empty(); rest.remove_prefix(rest.find(';') + 1)) {
    if (rest.substr(0, rest.find(';')) == unit) return true;
  }
  return false;
}

bool is_unit(std::string_view unit) {
  if (known_unit(unit) != nullptr || is_raw_unit(unit)) return true;
  const auto scaled = scaled_unit(unit);
  return scaled && (scaled->unit.empty() || known_unit(scaled->unit) != nullptr);
}

}  // namespace nacre::measurement
