#include "measurement/tester_text.hpp"
#include "measurement/tester_encoding.hpp"
#include "measurement/tester_numbers.hpp"

#include <gtest/gtest.h>

#include <array>

#include "measurement/tester_columns.hpp"

namespace nacre::measurement {
namespace {

TEST(InstrumentNumber, ReadsBothDecimalMarksAndGroups) {
  EXPECT_EQ(instrument_number("1,5", DecimalMark::comma), 1.5);
  EXPECT_EQ(instrument_number("1.234,5", DecimalMark::comma), 1234.5);
  EXPECT_EQ(instrument_number("-1,234.5e-3", DecimalMark::point), -1.2345);
  EXPECT_EQ(instrument_number("+0.25", DecimalMark::point), 0.25);
  EXPECT_EQ(instrument_number("1,234", DecimalMark::point), 1234.0);
  EXPECT_EQ(instrument_number("1,234", DecimalMark::comma), 1.234);
  for (const char* wrong : {"", "-", "1,5", "1..5", "12 mm", "nan", "inf", "0x10", "1,23.4", "----"})
    EXPECT_FALSE(instrument_number(wrong, DecimalMark::point)) << wrong;
}

TEST(InstrumentNumber, BlanksMayGroupThousands) {
  for (const char* text : {"1 013,11",
                           "1\xC2\xA0"
                           "013,11",
                           "1\xE2\x80\xAF"
                           "013,11"}) {
    EXPECT_EQ(instrument_number(text, DecimalMark::comma), 1013.11) << text;
    EXPECT_EQ(decimal_evidence(text), DecimalMark::comma) << text;
  }
  EXPECT_EQ(instrument_number("-12 345 678.5", DecimalMark::point), -12345678.5);
  EXPECT_EQ(decimal_evidence("1 013,110"), DecimalMark::comma);
  for (const char* wrong : {"1 2", "10 20", "0 013", "1 013 11", "1 013,1 1", "1e5 000", "1 234.567,8", "1  013"})
    EXPECT_FALSE(instrument_number(wrong, DecimalMark::comma)) << wrong;
}

TEST(DecimalEvidence, OnlyUnambiguousNumbersSpeak) {
  EXPECT_EQ(decimal_evidence("0,123"), DecimalMark::comma);
  EXPECT_EQ(decimal_evidence("12,5"), DecimalMark::comma);
  EXPECT_EQ(decimal_evidence("12.5"), DecimalMark::point);
  EXPECT_EQ(decimal_evidence("1.234,5"), DecimalMark::comma);
  EXPECT_FALSE(decimal_evidence("1,234"));
  EXPECT_FALSE(decimal_evidence("12"));
  EXPECT_FALSE(decimal_evidence("mm"));
}

TEST(InstrumentText, IsReadInAnyOfItsEncodings) {
  const std::string expected =
      "Pr\xC3\xBC"
      "fzeit;\xC2\xB5m";
  EXPECT_EQ(*utf8_from_instrument("\xEF\xBB\xBFPr\xC3\xBC"
                                  "fzeit;\xC2\xB5m"),
            expected);
  EXPECT_EQ(*utf8_from_instrument("Pr\xFC"
                                  "fzeit;\xB5m"),
            expected);
  std::string little("\xFF\xFE"), big("\xFE\xFF"), unmarked;
  for (const char letter : std::string("Pr\xFC"
                                       "fzeit;\xB5m")) {
    little += letter;
    little += '\0';
    big += '\0';
    big += letter;
    unmarked += letter;
    unmarked += '\0';
  }
  EXPECT_EQ(*utf8_from_instrument(little), expected);
  EXPECT_EQ(*utf8_from_instrument(big), expected);
  EXPECT_EQ(*utf8_from_instrument(unmarked), expected);
  EXPECT_FALSE(utf8_from_instrument("PK\x03\x04workbook"));
}

// What is written into a set must be read back from it, so halves of surrogate pairs cannot stay what they are.
TEST(InstrumentText, HalvesOfSurrogatePairsBecomeReplacementCharacters) {
  using namespace std::string_view_literals;
  EXPECT_EQ(utf8_from_instrument("\xFF\xFE"
                                 "A\0\x0B\xDC"
                                 "B\0"sv)
                .value(),
            "A\xEF\xBF\xBD"
            "B");
  EXPECT_EQ(utf8_from_instrument("\xFF\xFE"
                                 "\x3D\xD8"
                                 "B\0"sv)
                .value(),
            "\xEF\xBF\xBD"
            "B");
  EXPECT_EQ(utf8_from_instrument("\xFF\xFE"
                                 "\x3D\xD8\x00\xDE"sv)
                .value(),
            "\xF0\x9F\x98\x80");
}

TEST(Columns, AreRecognisedByNameInAnyLanguageWithTheirUnit) {
  struct Case {
    const char* heading;
    Quantity quantity;
    double factor;
  };
  for (const Case& each : {Case{"Load (N)", Quantity::force, 1.0},
                           Case{"Standardkraft [kN]", Quantity::force, 1e3},
                           Case{"Kraft in N", Quantity::force, 1.0},
                           Case{"Force / lbf", Quantity::force, 4.4482216152605},
                           Case{"force_n", Quantity::force, 1.0},
                           Case{"Axial Force (kN)", Quantity::force, 1e3},
                           Case{"Force (MN)", Quantity::force, 1e6},
                           Case{"Force (mN)", Quantity::force, 1e-3},
                           Case{"Force MN", Quantity::force, 1e6},
                           Case{"Force mN", Quantity::force, 1e-3},
                           Case{"Force/MN", Quantity::force, 1e6},
                           Case{"Force\xC2\xA0MN", Quantity::force, 1e6},
                           Case{"Displacement (Crosshead) mm", Quantity::extension, 1.0},
                           Case{"Extension \xC2\xB5m", Quantity::extension, 1e-3},
                           Case{"Extension (in)", Quantity::extension, 25.4},
                           Case{"Tensile extension (mm)", Quantity::extension, 1.0},
                           Case{"Crosshead (mm)", Quantity::extension, 1.0},
                           Case{"Position(Linear:Digital Position) (mm)", Quantity::extension, 1.0},
                           Case{"D\xC3\xA9placement [mm]", Quantity::extension, 1.0},
                           Case{"Verl\xC3\xA4ngerung in mm", Quantity::extension, 1.0},
                           Case{"Extension (\xC2\xB5m)", Quantity::extension, 1e-3},
                           Case{"time_s", Quantity::time, 1.0},
                           Case{"Pr\xC3\xBC"
                                "fzeit [min]",
                                Quantity::time, 60.0}}) {
    const ColumnName column = recognise_column(each.heading);
    ASSERT_TRUE(column.quantity) << each.heading;
    EXPECT_EQ(*column.quantity, each.quantity) << each.heading;
    EXPECT_DOUBLE_EQ(unit_factor(each.quantity, column.unit).value_or(-1.0), each.factor) << each.heading;
  }
}

TEST(Columns, ThatMeanSomethingElseAreLeftAlone) {
  for (const char* heading :
       {"Maximum Load (N)", "Load at Break (N)", "Extension at Break (mm)", "Test date", "Strain rate", "Specimen"})
    EXPECT_FALSE(recognise_column(heading).quantity) << heading;
  EXPECT_EQ(recognise_column("Tensile strain (Extension) (mm/mm)").quantity, Quantity::strain);
  EXPECT_EQ(recognise_column("Tensile stress (MPa)").quantity, Quantity::stress);
  EXPECT_EQ(recognise_column("Strain 1 (mm)").unit, "(mm)") << "who asks for it by name gets its unit";
}

/// Headings without a unit, so that the words alone decide.
TEST(RecogniseColumn, KnowsTheWordsOfMakersInTheirLanguages) {
  const auto expect_all = [](Quantity quantity, std::initializer_list<const char*> headings) {
    for (const char* heading : headings) {
      EXPECT_EQ(recognise_column(heading).quantity, quantity) << heading;
      EXPECT_EQ(recognise_column(heading).role, ColumnRole::measured) << heading;
    }
  };
  expect_all(Quantity::extension, {"Verfahrweg",
                                   "Traverse abs.",
                                   "Traversenweg absolut",
                                   "Achsweg",
                                   "Klemmenabstand",
                                   "Kolbenposition",
                                   "Crosshead Separation",
                                   "Jaw Travel",
                                   "Ram Position",
                                   "Displacement(Linear:Digital Position)",
                                   "C_1_Déplacement",
                                   "Écartement des mors",
                                   "Course vérin",
                                   "Separación de mordazas",
                                   "Posición cruceta",
                                   "Corsa traversa",
                                   "Posizione traversa",
                                   "チャック間変位",
                                   "つかみ具間距離",
                                   "移動距離",
                                   "横梁位移",
                                   "夹头位移",
                                   "活塞行程",
                                   "변위"});
  expect_all(Quantity::force,
             {"Prüflast", "Messkraft", "Crosshead Force", "Force(Linear:Load)", "C_1_Force", "Fuerza de tracción",
              "Célula de carga", "Cella di carico", "Forza di trazione", "引張力", "張力", "轴向力", "負載", "하중"});
  expect_all(Quantity::time, {"Datum/Uhrzeit", "Fecha y hora", "測定時間", "采集时间"});
  for (const char* heading :
       {"Dehnungsmessgerät", "Dehnungsaufnehmer", "Ansetzaufnehmer", "Clip-on", "videoXtens", "Extensomètre",
        "Extensómetro", "Estensometro", "伸び計", "変位計", "电子引伸计", "Virtual extensometer"}) {
    EXPECT_EQ(recognise_column(heading).gauge, Gauge::extensometer) << heading;
  }
  for (const char* heading : {"Verfahrweg", "Traversenweg", "Crosshead", "横梁位移", "クロスヘッド"})
    EXPECT_EQ(recognise_column(heading).gauge, Gauge::grips) << heading;
}

TEST(WordFinder, FindsWordsBetweenLatinLettersAndEastAsianOnesAnywhere) {
  const std::array<std::string_view, 4> words = {"load", "load cell", "力", "n"};
  const WordFinder finder(words);
  EXPECT_EQ(finder.find_all("load cell (n)").size(), 3U);
  EXPECT_TRUE(finder.finds_one("試験力"));
  for (const char* text : {"", "unload", "loads", "kn"}) EXPECT_FALSE(finder.finds_one(text)) << text;
}

}  // namespace
}  // namespace nacre::measurement
