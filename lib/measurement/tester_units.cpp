// Part of the vocabulary of headings (tester_vocabulary.hpp): units.
#include <array>

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
    {Quantity::extension, 1e-06, "nm;nanometer;nanometers;"},
    {Quantity::extension, kInchMm, "in;inch;inches;zoll;pouce;pouces;pulgada;pulgadas;pollice;pollici;\";英寸;インチ;"},
    {Quantity::extension, 1e-3 * kInchMm, "mil;mils;thou;"},
    {Quantity::extension, 12 * kInchMm, "ft;feet;foot;fuss;"},
    {Quantity::force, 1, "n;newton;newtons;牛;牛顿;牛頓;ニュートン;"},
    {Quantity::force, 1000.0, "kn;kilonewton;kilonewtons;千牛;キロニュートン;"},
    {Quantity::force, 0.001, "mn;millinewton;millinewtons;"},
    {Quantity::force, 10, "dan;decanewton;decanewtons;dekanewton;"},
    {Quantity::force, 0.01, "cn;centinewton;"},
    {Quantity::force, kPoundForceN,
     "lbf;lb;lbs;lbsf;lb f;pound;pounds;pound-force;pounds-force;pound force;pounds "
     "force;libra;libras;libbre;livres;ポンド;磅;磅力;"},
    {Quantity::force, 1e3 * kPoundForceN, "klbf;klb;kip;kips;kilopound;kilopounds;kilopound-force;"},
    {Quantity::force, kPoundForceN / 16, "ozf;oz;ounce;ounces;ounce-force;"},
    {Quantity::force, kKilogramForceN,
     "kgf;kg;kp;kilopond;kilogram;kilograms;kilogram-force;kilogramm;kilogrammes;kilogramos;kg-f;kg "
     "f;公斤;千克;千克力;公斤力;"},
    {Quantity::force, 1e-3 * kKilogramForceN, "gf;g;pond;gram;grams;gram-force;gramm;克;"},
    {Quantity::force, 1e3 * kKilogramForceN, "tf;ton-force;tonf;"},
    {Quantity::strain, 1, "mm/mm;m/m;in/in;in./in.;inch/inch;1;-;strain;ratio;"},
    {Quantity::strain, 0.01, "%;pct;percent;per cent;prozent;pour cent;%gl;百分比;"},
    {Quantity::strain, 0.001, "permille;mm/m;"},
    {Quantity::strain, 1e-06, "ustrain;microstrain;micro strain;um/m;ue;ustr;"},
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

bool stands_in(std::string_view names, std::string_view name) {
  for (std::size_t at = names.find(name); at != std::string_view::npos; at = names.find(name, at + 1)) {
    if ((at == 0 || names[at - 1] == ';') && names[at + name.size()] == ';') return true;
  }
  return false;
}

}  // namespace

std::optional<double> named_unit(Quantity quantity, std::string_view unit) {
  constexpr std::size_t kLongest = 24;  // bytes of a unit's name
  if (unit.empty() || unit.size() > kLongest || unit.find(';') != std::string_view::npos) return std::nullopt;
  for (const UnitNames& each : kUnits) {
    if (each.quantity != quantity) continue;
    if (stands_in(each.names, unit)) return each.factor;
    if (unit.size() > 1 && unit.ends_with('.') && stands_in(each.names, unit.substr(0, unit.size() - 1)))
      return each.factor;
  }
  return std::nullopt;
}

bool is_raw_unit(std::string_view unit) { return !unit.empty() && stands_in(kRawUnits, unit); }

bool is_unit(std::string_view unit) {
  if (is_raw_unit(unit)) return true;
  for (const Quantity quantity :
       {Quantity::time, Quantity::extension, Quantity::force, Quantity::strain, Quantity::stress}) {
    if (named_unit(quantity, unit)) return true;
  }
  return false;
}

}  // namespace nacre::measurement
