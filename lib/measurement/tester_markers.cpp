// Part of the vocabulary of headings (tester_vocabulary.hpp): words beside the name of a quantity.
#include <algorithm>
#include <iterator>

#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {
namespace {

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
    "counter",     "offset",
    "tare",        "tara",
    "friction",    "reibung",
    "reibkraft",   "frottement",
    "attrito",     "clamping",
    "clamp",       "klemmkraft",
    "spannkraft",  "shear",
    "torque",      "drehmoment",
    "moment",      "previous",
    "threshold",   "schwelle",
    "vorlast",     "restkraft",
    "kraftabfall", "drop",
    "precarga",    "precarico",
    "precharge",   "remaining",
    "rest",        "摩擦",
    "扭矩",        "残余",
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
    "requested",    "request",
    "planned",      "expected",
    "program",      "profile",
    "profil",       "generator",
    "drive",        "ideal",
    "nominal",      "nominale",
    "nominell",     "theoretical",
    "theorique",    "teorico",
    "teorica",      "ziel",
    "zielwert",     "zielkraft",
    "zielweg",      "zielposition",
    "stellgroesse", "sollgroesse",
    "deseado",      "deseada",
    "programado",   "programada",
    "comandato",    "comandata",
    "richiesto",    "richiesta",
    "impostato",    "impostata",
    "demande",      "demandee",
    "commandee",    "prevu",
    "prevue",       "命令",
    "期望",         "指示",
    "プログラム",   "预设",
    "預設",         "理论",
    "理論",         "プリセット",
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
    "horizontal",
    "orizzontale",
    "poisson",
    "querweg",
    "seitlich",
    "幅方向",
};

constexpr std::string_view kPreferred[] = {
    "axial",   "axiale",    "assiale",        "longitudinal",   "longitudinale", "laengs",     "actual",
    "istwert", "ist",       "feedback",       "measured",       "mesure",        "mesuree",    "medido",
    "medida",  "misurato",  "misurata",       "gemessen",       "calibrated",    "kalibriert", "filtered",
    "実測",    "实测",      "軸方向",         "轴向",           "mesures",       "reel",       "reelle",
    "reale",   "effettivo", "effettiva",      "effettivamente", "effectif",      "pv",         "fbk",
    "反馈",    "反饋",      "フィードバック", "真实",           "实际",          "実際",
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

/// Beside the name of a quantity they change nothing.
constexpr std::string_view kHarmless[] = {
    "channel",    "ch",       "kanal",    "canal",    "canale",      "voie",
    "test",       "machine",  "maschine", "total",    "gesamt",      "abs",
    "absolute",   "absolut",  "absolu",   "absoluto", "assoluto",    "relative",
    "relativ",    "relatif",  "relativo", "rel",      "net",         "main",
    "primary",    "current",  "tensile",  "pull",     "zug",         "traction",
    "traccion",   "trazione", "standard", "linear",   "digital",     "analog",
    "cell",       "no",       "nr",       "num",      "number",      "run",
    "value",      "wert",     "messwert", "valeur",   "valor",       "valore",
    "data",       "reading",  "vertical", "de",       "du",          "des",
    "la",         "le",       "of",       "der",      "die",         "das",
    "di",         "del",      "della",    "the",      "from",        "instron",
    "zwick",      "mts",      "shimadzu", "specimen", "sample",      "probe",
    "eprouvette", "probeta",  "provino",  "applied",  "measurement", "corrected for zero",
    "拉伸",       "通道",     "值",       "主",       "引張",        "チャンネル",
    "値",         "试验",     "試験",     "试样",     "試験片",
};
/// Of rows that sum up others.
constexpr std::string_view kStatistics[] = {
    "mean",
    "average",
    "avg",
    "median",
    "std",
    "std dev",
    "std. dev.",
    "stdev",
    "standard deviation",
    "sd",
    "s.d.",
    "cv",
    "c.v.",
    "cov",
    "coefficient of variation",
    "variance",
    "minimum",
    "maximum",
    "min",
    "max",
    "range",
    "sum",
    "count",
    "mittelwert",
    "mw",
    "standardabweichung",
    "s",
    "x",
    "v",
    "moyenne",
    "ecart type",
    "ecart-type",
    "mediane",
    "media",
    "promedio",
    "desviacion",
    "desviacion estandar",
    "deviazione standard",
    "massimo",
    "minimo",
    "maximo",
    "平均",
    "平均値",
    "平均值",
    "標準偏差",
    "标准偏差",
    "标准差",
    "最大",
    "最小",
    "最大値",
    "最小値",
    "最大值",
    "最小值",
    "変動係数",
    "变异系数",
};

}  // namespace

const WordFinder& other_words() {
  static const WordFinder finder(kOthers);
  return finder;
}
const WordFinder& set_point_words() {
  static const WordFinder finder(kSetPoints);
  return finder;
}
const WordFinder& raw_words() {
  static const WordFinder finder(kRaw);
  return finder;
}
const WordFinder& lateral_words() {
  static const WordFinder finder(kLateral);
  return finder;
}
const WordFinder& preferred_words() {
  static const WordFinder finder(kPreferred);
  return finder;
}
const WordFinder& specimen_words() {
  static const WordFinder finder(kSpecimens);
  return finder;
}
const WordFinder& harmless_words() {
  static const WordFinder finder(kHarmless);
  return finder;
}

bool is_statistic(std::string_view words) {
  return std::find(std::begin(kStatistics), std::end(kStatistics), words) != std::end(kStatistics);
}

}  // namespace nacre::measurement
