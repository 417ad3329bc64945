#include "measurement/tester_vocabulary.hpp"

#include <algorithm>
#include <array>

#include "base/csv.hpp"

namespace nacre::measurement {
namespace {

constexpr NamedQuantity e(std::string_view word, int rank) { return {Quantity::extension, word, rank}; }
constexpr NamedQuantity f(std::string_view word, int rank) { return {Quantity::force, word, rank}; }
constexpr NamedQuantity t(std::string_view word, int rank) { return {Quantity::time, word, rank}; }
constexpr NamedQuantity strain(std::string_view word) { return {Quantity::strain, word, 0}; }
constexpr NamedQuantity stress(std::string_view word) { return {Quantity::stress, word, 0}; }

/// An extensometer measures a part of the specimen: it is taken only where it is asked for, or is the only one. The
/// clock of a cycle or a step starts anew: it is the last choice.
constexpr NamedQuantity kNames[] = {
    e("extension", 0),
    e("estensione", 0),
    e("tensile extension", 0),
    e("standard travel", 1),
    e("standardweg", 1),
    e("ext", 1),
    e("displacement", 2),
    e("disp", 2),
    e("displ", 2),
    e("変位", 2),
    e("変位量", 2),
    e("位移", 2),
    e("位移量", 2),
    e("machine displacement", 2),
    e("crosshead", 3),
    e("cross head", 3),
    e("crosshead travel", 3),
    e("traverse", 3),
    e("traversenweg", 3),
    e("traversenposition", 3),
    e("maschinenweg", 3),
    e("weg", 3),
    e("pruefweg", 3),
    e("travel", 3),
    e("elongation", 3),
    e("verlaengerung", 3),
    e("laengenaenderung", 3),
    e("verschiebung", 3),
    e("kolbenweg", 3),
    e("zylinderweg", 3),
    e("querhauptweg", 3),
    e("querhaupt", 3),
    e("allongement", 3),
    e("deplacement", 3),
    e("desplazamiento", 3),
    e("spostamento", 3),
    e("allungamento", 3),
    e("alargamiento", 3),
    e("elongacion", 3),
    e("recorrido", 3),
    e("traversa", 3),
    e("cruceta", 3),
    e("traverse position", 3),
    e("jaw separation", 3),
    e("grip separation", 3),
    e("dl", 3),
    e("delta l", 3),
    e("伸び", 3),
    e("のび", 3),
    e("伸長", 3),
    e("伸长", 3),
    e("伸长量", 3),
    e("移動量", 3),
    e("クロスヘッド", 3),
    e("ｸﾛｽﾍｯﾄﾞ", 3),
    e("横梁", 3),
    e("橫樑", 3),
    e("change in length", 3),
    e("lvdt", 3),
    e("stroke", 4),
    e("course", 4),
    e("carrera", 4),
    e("corsa", 4),
    e("hub", 4),
    e("kolbenhub", 4),
    e("ストローク", 4),
    e("ｽﾄﾛｰｸ", 4),
    e("行程", 4),
    e("actuator", 4),
    e("position", 5),
    e("posicion", 5),
    e("posizione", 5),
    e("pos", 5),
    e("位置", 5),
    e("verformung", 6),
    e("deformation", 6),
    e("deformacion", 6),
    e("deformazione", 6),
    e("変形", 6),
    e("変形量", 6),
    e("变形", 6),
    e("变形量", 6),
    e("變形", 6),
    e("extensometer", 9),
    e("laengenaenderungsaufnehmer", 9),
    e("wegaufnehmer", 9),
    e("extensometre", 9),
    e("extensometro", 9),
    e("estensimetro", 9),
    e("estensometro", 9),
    e("feindehnung", 9),
    e("feindehnungsaufnehmer", 9),
    e("伸び計", 9),
    e("引伸计", 9),
    e("引伸計", 9),
    e("laser extensometer", 9),
    e("video extensometer", 9),
    f("force", 0),
    f("standard force", 0),
    f("standardkraft", 0),
    f("試験力", 0),
    f("试验力", 0),
    f("試驗力", 0),
    f("axial force", 0),
    f("load", 1),
    f("kraft", 1),
    f("pruefkraft", 1),
    f("zugkraft", 1),
    f("last", 1),
    f("belastung", 1),
    f("kraftaufnehmer", 1),
    f("kraftmessdose", 1),
    f("load cell", 1),
    f("charge", 1),
    f("effort", 1),
    f("fuerza", 1),
    f("carga", 1),
    f("forza", 1),
    f("carico", 1),
    f("荷重", 1),
    f("負荷", 1),
    f("负荷", 1),
    f("载荷", 1),
    f("載荷", 1),
    f("荷载", 1),
    f("拉力", 1),
    f("引張力", 1),
    f("力值", 1),
    f("ロード", 1),
    f("ﾛｰﾄﾞ", 1),
    f("载重", 1),
    f("frc", 1),
    f("axial load", 1),
    f("f", 2),
    f("力", 2),
    f("weight", 2),
    t("test time", 0),
    t("total time", 0),
    t("running time", 0),
    t("run time", 0),
    t("elapsed time", 0),
    t("pruefzeit", 0),
    t("laufzeit", 0),
    t("versuchszeit", 0),
    t("testzeit", 0),
    t("messzeit", 0),
    t("gesamtzeit", 0),
    t("temps d'essai", 0),
    t("temps ecoule", 0),
    t("temps total", 0),
    t("tiempo de ensayo", 0),
    t("tiempo total", 0),
    t("tiempo transcurrido", 0),
    t("tempo di prova", 0),
    t("tempo totale", 0),
    t("tempo trascorso", 0),
    t("試験時間", 0),
    t("経過時間", 0),
    t("试验时间", 0),
    t("試驗時間", 0),
    t("總時間", 0),
    t("总时间", 0),
    t("time", 1),
    t("zeit", 1),
    t("temps", 1),
    t("tiempo", 1),
    t("tempo", 1),
    t("時間", 1),
    t("时间", 1),
    t("testing time", 1),
    t("t", 2),
    t("dauer", 2),
    t("duration", 2),
    t("duree", 2),
    t("duracion", 2),
    t("durata", 2),
    t("versuchsdauer", 2),
    t("clock", 3),
    t("timestamp", 4),
    t("time stamp", 4),
    t("zeitstempel", 4),
    t("uhrzeit", 4),
    t("time of day", 4),
    t("heure", 4),
    t("hora", 4),
    t("ora", 4),
    t("時刻", 4),
    t("时刻", 4),
    t("datetime", 4),
    t("horodatage", 4),
    t("cycle time", 5),
    t("cycle elapsed time", 5),
    t("step time", 5),
    t("segment time", 5),
    t("zykluszeit", 5),
    t("schrittzeit", 5),
    t("zeit im zyklus", 5),
    t("temps de cycle", 5),
    t("temps du cycle", 5),
    t("temps d'etape", 5),
    t("tiempo de ciclo", 5),
    t("tiempo del ciclo", 5),
    t("tempo di ciclo", 5),
    t("tempo ciclo", 5),
    t("サイクル時間", 5),
    t("循环时间", 5),
    t("block time", 5),
    t("time in step", 5),
    t("time in cycle", 5),
    t("step elapsed time", 5),
    t("ramp time", 5),
    strain("strain"),
    strain("dehnung"),
    strain("epsilon"),
    strain("eps"),
    strain("ひずみ"),
    strain("歪み"),
    strain("歪"),
    strain("应变"),
    strain("應變"),
    strain("deformation relative"),
    strain("deformacion unitaria"),
    strain("deformazione unitaria"),
    strain("nominal strain"),
    strain("dehnungs"),
    strain("technical strain"),
    stress("stress"),
    stress("spannung"),
    stress("zugspannung"),
    stress("contrainte"),
    stress("esfuerzo"),
    stress("tension"),
    stress("tensione"),
    stress("sforzo"),
    stress("sigma"),
    stress("応力"),
    stress("应力"),
    stress("應力"),
    stress("tensile stress"),
    stress("pressure"),
    stress("druck"),
    stress("pression"),
};

constexpr std::string_view kOthers[] = {
    "rate",        "date",
    "datum",       "speed",
    "velocity",    "geschwindigkeit",
    "vitesse",     "velocidad",
    "velocita",    "maximum",
    "max",         "minimum",
    "min",         "maximal",
    "maximale",    "massimo",
    "massima",     "maximo",
    "maxima",      "peak",
    "valley",      "true",
    "at",          "bei",
    "break",       "bruch",
    "bruchkraft",  "rupture",
    "rotura",      "rottura",
    "yield",       "fmax",
    "temperature", "temperatur",
    "temperatura", "error",
    "abweichung",  "regelabweichung",
    "fehler",      "ecart",
    "deviation",   "energy",
    "work",        "arbeit",
    "energie",     "energia",
    "strength",    "modulus",
    "modul",       "module",
    "count",       "zaehler",
    "limit",       "vorkraft",
    "preload",     "average",
    "mean",        "mittelwert",
    "break load",  "height",
    "length",      "laenge",
    "longueur",    "longitud",
    "lunghezza",   "number",
    "nummer",      "速度",
    "速率",        "最大",
    "最小",        "破断",
    "断裂",        "強度",
    "强度",        "温度",
    "溫度",        "能量",
    "エネルギー",  "弾性",
    "弹性",        "率",
    "日付",        "日期",
    "counter",
};

constexpr std::string_view kSetPoints[] = {
    "command",      "cmd",
    "commanded",    "set point",
    "setpoint",     "set",
    "sollwert",     "soll",
    "sollkraft",    "sollweg",
    "sollposition", "setvalue",
    "set value",    "target",
    "demand",       "demanded",
    "desired",      "reference",
    "ref",          "vorgabe",
    "vorgabewert",  "fuehrungsgroesse",
    "consigne",     "cible",
    "commande",     "consigna",
    "objetivo",     "referencia",
    "comando",      "riferimento",
    "obiettivo",    "mando",
    "programmed",   "programm",
    "指令",         "目標",
    "目标",         "設定",
    "设定",         "給定",
    "给定",         "指令值",
    "指令値",       "sp",
};

constexpr std::string_view kRaw[] = {
    "raw",        "counts", "count",        "adc",          "bits",     "bit",     "digits",          "steps",
    "step",       "ticks",  "rohwert",      "rohdaten",     "roh",      "brut",    "brute",           "crudo",
    "grezzo",     "grezza", "uncalibrated", "unkalibriert", "signal",   "voltage", "spannungssignal", "inkremente",
    "increments", "pulses", "pulse",        "原始",         "生データ", "生値",    "未校正",          "电压",
    "電圧",
};

constexpr std::string_view kLateral[] = {
    "lateral",
    "laterale",
    "transverse",
    "transversal",
    "transversale",
    "trasversale",
    "quer",
    "querdehnung",
    "breite",
    "breitenaenderung",
    "querkontraktion",
    "width",
    "largeur",
    "ancho",
    "larghezza",
    "radial",
    "radiale",
    "diametral",
    "diametrale",
    "diameter",
    "thickness",
    "dicke",
    "circumferential",
    "hoop",
    "横向",
    "側向",
    "侧向",
    "径向",
    "幅",
    "横方向",
};

constexpr std::string_view kPreferred[] = {
    "axial",   "axiale",   "assiale",  "longitudinal", "longitudinale", "laengs",     "actual",
    "istwert", "ist",      "feedback", "measured",     "mesure",        "mesuree",    "medido",
    "medida",  "misurato", "misurata", "gemessen",     "calibrated",    "kalibriert", "filtered",
    "実測",    "实测",     "軸方向",   "轴向",
};

constexpr std::string_view kSpecimens[] = {
    "specimen",
    "sample",
    "probe",
    "probekoerper",
    "pruefkoerper",
    "eprouvette",
    "echantillon",
    "probeta",
    "muestra",
    "provino",
    "campione",
    "test",
    "test no",
    "test number",
    "specimen no",
    "specimen number",
    "specimen id",
    "specimen label",
    "sample no",
    "sample id",
    "probe nr",
    "proben nr",
    "probennummer",
    "run",
    "part",
    "試験片",
    "試料",
    "試験番号",
    "试样",
    "试样编号",
    "试件",
    "試樣",
    "numero d'eprouvette",
    "n eprouvette",
    "serial",
    "nr",
    "no",
};

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

bool is_east_asian(std::string_view word) { return !word.empty() && static_cast<unsigned char>(word[0]) >= 0xE3; }

}  // namespace

std::string_view to_string(Quantity quantity) {
  constexpr std::array<std::string_view, kQuantities> kWords = {"time", "extension", "force", "strain", "stress"};
  return kWords[static_cast<std::size_t>(quantity)];
}

std::span<const NamedQuantity> quantity_names() { return kNames; }
std::span<const std::string_view> other_words() { return kOthers; }
std::span<const std::string_view> set_point_words() { return kSetPoints; }
std::span<const std::string_view> raw_words() { return kRaw; }
std::span<const std::string_view> lateral_words() { return kLateral; }
std::span<const std::string_view> preferred_words() { return kPreferred; }
std::span<const std::string_view> specimen_words() { return kSpecimens; }

bool holds_word(std::string_view text, std::string_view word) {
  if (word.empty()) return false;
  const bool anywhere = is_east_asian(word);
  const auto is_letter = [&](std::size_t i) { return i < text.size() && text[i] >= 'a' && text[i] <= 'z'; };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    if (anywhere || ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size()))) return true;
  }
  return false;
}

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

std::size_t east_asian_words(std::string_view text) {
  std::size_t found = 0;
  for (const NamedQuantity& name : kNames)
    found += is_east_asian(name.word) && text.find(name.word) != std::string_view::npos;
  return found;
}

}  // namespace nacre::measurement
