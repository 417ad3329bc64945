// Frequency sweeps of dynamic mechanical analysis, as several makers write them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "layouts.hpp"
#include "measurement/export_list.hpp"
#include "measurement/piece.hpp"
#include "measurement/read_set.hpp"
#include "measurement/surroundings.hpp"
#include "measurement/write_import.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// One frequency of the sample: E' grows as a power of the frequency.
struct Row {
  double frequency_hz, storage_pa;
};
constexpr std::array<Row, 3> kUsualSweep = {{{0.1, 1.0e9}, {1.0, 1.2e9}, {10.0, 1.44e9}}};

/// The rows under `heading`; {0} Hz, {1} rad/s, {2} Pa, {3} MPa, {4} loss modulus in MPa, {5} tan delta.
std::string sweep_table(const std::string& heading, const std::string& format) {
  std::string text = heading;
  for (const Row& row : kUsualSweep)
    text += fmt::format(fmt::runtime(format), row.frequency_hz, kTurn * row.frequency_hz, row.storage_pa,
                        1e-6 * row.storage_pa, 5e-8 * row.storage_pa, 0.05);
  return text;
}

class Sweeps : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-sweeps-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Import import(const std::string& text, const std::string& columns = "", const std::string& cells = "",
                const std::string& design = "mix:0.75,modulus") const {
    std::ofstream(folder_ / "a.csv") << text;
    std::ofstream(folder_ / "sheet.csv") << "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm" << columns
                                         << "\na.csv,s," << design << ",6,2,20" << cells << "\n";
    return import_exports({}, folder_ / "sheet.csv");
  }
  Import import_with_amplitude(const std::string& text) const { return import(text, ",strain_amplitude", ",0.001"); }

  /// The usual sweep at an amplitude of 0.1 %.
  static void expect_usual(const Import& import) {
    ASSERT_EQ(import.specimens.size(), kUsualSweep.size()) << all_of(import);
    for (std::size_t i = 0; i < import.specimens.size(); ++i) {
      const SpecimenRecord& record = import.specimens[i].record;
      const Row& row = kUsualSweep[i];
      EXPECT_EQ(record.specimen, fmt::format("s-{}", i + 1));
      EXPECT_EQ(piece_of(record), "s");
      EXPECT_EQ(record.design.name(), "mix:0.75");
      EXPECT_TRUE(record.valid && record.curve.empty());
      EXPECT_NEAR(record.modulus_pa.value_or(0.0), row.storage_pa, 1e-5 * row.storage_pa) << all_of(import);
      EXPECT_NEAR(record.conditions.strain_rate_per_s, kTurn * row.frequency_hz * 1e-3, 1e-5 * row.frequency_hz);
    }
  }
  void expect_refused(const Import& import, const std::string& column, int line, const std::string& expected) const {
    EXPECT_TRUE(import.specimens.empty());
    ASSERT_EQ(import.rejected.size(), 1U) << all_of(import);
    EXPECT_EQ(import.rejected[0].column, column) << all_of(import);
    EXPECT_EQ(import.rejected[0].line, line) << all_of(import);
    EXPECT_THAT(import.rejected[0].reason, HasSubstr(expected));
  }
  static std::vector<std::string> temperatures_of(const Import& import) {
    std::vector<std::string> temperatures;
    for (const auto& one : import.specimens) temperatures.push_back(one.record.other_columns.at("temperature_c"));
    return temperatures;
  }
  fs::path folder_;
};

TEST_F(Sweeps, FrequenciesInHertzAndInRadiansGiveTheSameRates) {
  for (const char* name : {"Frequency (Hz)", "f/Hz", "Frequenz in Hz", "frequency_hz", "周波数 (Hz)"}) {
    SCOPED_TRACE(name);
    expect_usual(import_with_amplitude(sweep_table(std::string(name) + ",Storage modulus (MPa)\n", "{0},{3}\n")));
  }
  for (const char* name : {"Angular frequency (rad/s)", "omega / rad/s", "Kreisfrequenz [1/s]", "ω in rad/s",
                           "Angular frequency", "Pulsation (rad.s-1)"}) {
    SCOPED_TRACE(name);
    expect_usual(import_with_amplitude(sweep_table(std::string(name) + ",Storage modulus (MPa)\n", "{1},{3}\n")));
  }
}

TEST_F(Sweeps, ModuliOfAnyNameAndUnitAreTheSame) {
  for (const char* name : {"Storage modulus (Pa)", "E' (Pa)", "E′ [Pa]", "Speichermodul E' / Pa", "E_stor (Pa)",
                           "Module de conservation (Pa)", "Módulo de almacenamiento (Pa)"}) {
    SCOPED_TRACE(name);
    expect_usual(import_with_amplitude(sweep_table(std::string("Frequency (Hz),") + name + "\n", "{0},{2}\n")));
  }
  for (const char* name : {"Storage modulus (MPa)", "E'/MPa", "Modulo di conservazione (MPa)", "e_prime_mpa"}) {
    SCOPED_TRACE(name);
    expect_usual(import_with_amplitude(sweep_table(std::string("Frequency (Hz),") + name + "\n", "{0},{3}\n")));
  }
}

TEST_F(Sweeps, AnExportWithUnitsInARowOfTheirOwnIsReadWithItsAmplitude) {  // as TA Instruments' TRIOS
  const Import import = this->import(sweep_table(
      "Filename\ta.tri\nOperator\tA. Lovelace\n\n[step]\nFrequency sweep - 1\n"
      "Angular frequency\tStorage modulus\tLoss modulus\tTan(delta)\tOscillation strain\tTemperature\tPhase angle\n"
      "rad/s\tMPa\tMPa\t\t%\t°C\t°\n",
      "{1}\t{3}\t{4}\t{5}\t0.1\t25.0\t3\n"));
  expect_usual(import);
  EXPECT_THAT(temperatures_of(import), ElementsAre("25", "25", "25"));
  EXPECT_EQ(import.specimens[0].record.other_columns.at("operator"), "A. Lovelace");
  EXPECT_EQ(import.specimens[0].rate_source, "record");
}

TEST_F(Sweeps, DecimalCommasBetweenSemicolonsAreRead) {  // as Netzsch and Mettler in German
  const Import import =
      this->import(with_commas(sweep_table("Temp./°C;Zeit/min;Frequenz/Hz;E'/MPa;E''/MPa;tan δ;Dehnungsamplitude/%\n",
                                           "25.5;1.5;{0};{3:.3f};{4};{5};0.1\n")));
  expect_usual(import);
  EXPECT_THAT(temperatures_of(import), ElementsAre("25.5", "25.5", "25.5"));
}

TEST_F(Sweeps, TheSymbolsOfARowOfUnitsTellOneLetterColumns) {  // as Mettler's STARe
  const Import import =
      this->import(sweep_table("Index,t,Ts,E',E'',tan delta,f,Strain\n[],[s],[°C],[MPa],[MPa],[],[Hz],[%]\n",
                               "1,0.5,-20,{3},{4},{5},{0},0.1\n"));
  expect_usual(import);
  EXPECT_THAT(temperatures_of(import), ElementsAre("-20", "-20", "-20"));
}

TEST_F(Sweeps, HeadingsInTwoLinesAndUtf16AreRead) {  // as Anton Paar's RheoCompass
  const std::string text = sweep_table(
      "Test:\tDMA 1\t\t\t\n\nMeas. Pts.\tAngular\tStorage\tLoss\tDeformation\n\tFrequency\tModulus\tModulus\t\n"
      "\t[rad/s]\t[Pa]\t[Pa]\t[%]\n",
      "1\t{1}\t{2}\t{4}\t0.1\n");
  expect_usual(this->import(text));
  std::string utf16 = "\xFF\xFE";
  for (const char letter : text) utf16 += std::string{letter, '\0'};
  expect_usual(this->import(utf16));
}

TEST_F(Sweeps, UnitsInTheCellsAreRead) {
  expect_usual(import_with_amplitude(sweep_table("Frequency (Hz);E'\n", "{0};{3} MPa\n")));
}

TEST_F(Sweeps, TheLossModulusIsNeverTakenForTheStorageModulus) {
  for (const char* names : {"Loss modulus (MPa),Tan(delta),Storage modulus (MPa)", "E'' (MPa),E''/E',E' (MPa)",
                            "E″ (MPa),tan δ,E′ (MPa)", "Verlustmodul (MPa),tan(d),Speichermodul (MPa)",
                            "\"E\"\" (MPa)\",tan,E' (MPa)", "Complex modulus (MPa),tan,Storage modulus (MPa)",
                            "Loss modulus E'' (MPa),log(E' (MPa)),Storage modulus E' (MPa)"}) {
    SCOPED_TRACE(names);
    const Import import =
        import_with_amplitude(sweep_table(fmt::format("Frequency (Hz),{}\n", names), "{0},{4},{5},{3}\n"));
    expect_usual(import);
  }
  EXPECT_TRUE(
      import_with_amplitude(sweep_table("Frequency (Hz),Loss modulus (MPa),tan\n", "{0},{4},{5}\n")).specimens.empty());
}

TEST_F(Sweeps, KelvinBecomesDegreesCelsius) {
  for (const char* name : {"Temperature (K)", "T / K", "Temp. [Kelvin]"}) {
    SCOPED_TRACE(name);
    const Import import = import_with_amplitude(
        sweep_table(fmt::format("{},Frequency (Hz),Storage modulus (MPa)\n", name), "298.15,{0},{3}\n"));
    expect_usual(import);
    EXPECT_THAT(temperatures_of(import), ElementsAre("25", "25", "25"));
  }
}

TEST_F(Sweeps, ChineseAndJapaneseHeadingsAreRead) {
  for (const char* names : {"频率 (Hz),储能模量 (MPa),损耗模量 (MPa),应变 (%),温度 (℃)",
                            "周波数 [Hz],貯蔵弾性率 E' [MPa],損失弾性率 E'' [MPa],ひずみ [%],温度 [℃]"}) {
    SCOPED_TRACE(names);
    const Import import = this->import(sweep_table(fmt::format("{}\n", names), "{0},{3},{4},0.1,25\n"));
    expect_usual(import);
    EXPECT_THAT(temperatures_of(import), ElementsAre("25", "25", "25"));
  }
}

TEST_F(Sweeps, EveryTemperatureHasItsRows) {
  std::string text = "Frequency (Hz),Temperature (°C),Storage modulus (MPa),Strain (%)\n";
  for (const double temperature : {20.0, 40.5, 60.0})
    for (const double frequency : {1.0, 10.0})
      text += fmt::format("{},{},{},0.05\n", frequency, temperature, 2000.0 - 10.0 * temperature);
  const Import import = this->import(text);
  EXPECT_THAT(temperatures_of(import), ElementsAre("20", "20", "40.5", "40.5", "60", "60"));
  EXPECT_NEAR(*import.specimens[2].record.modulus_pa, 1595e6, 1.0);
  EXPECT_NEAR(import.specimens[5].record.conditions.strain_rate_per_s, kTurn * 10.0 * 5e-4, 1e-7);
}

TEST_F(Sweeps, StepsWithHeadingsOfTheirOwnAreOnePiece) {
  const std::string step =
      sweep_table("[step]\nFrequency (Hz),Temperature (°C),Storage modulus (MPa)\n", "{0},20,{3}\n");
  const Import import = import_with_amplitude(step + "\n" + step + "\n" + step + "\n" + step);
  ASSERT_EQ(import.specimens.size(), 12U) << all_of(import);
  EXPECT_EQ(import.specimens.front().record.specimen, "s-01") << "names sort as their rows do";
  EXPECT_EQ(import.specimens.back().record.specimen, "s-12");
  EXPECT_EQ(piece_of(import.specimens.back().record), "s");
}

TEST_F(Sweeps, SamplesOfOneTableAreParts) {
  std::string text = "No,Sample,Frequency (Hz),E' (MPa),Strain (%)\n";
  for (const int i : {1, 2, 3})
    for (const char* sample : {"A", "B"})
      text += fmt::format("{},{},{},{}00,0.1\n", i, sample, i, *sample == 'A' ? 1 : 2);
  expect_refused(import(text), "part", 2, "A, B");
  const Import chosen = import(text, ",part", ",b");
  ASSERT_EQ(chosen.specimens.size(), 3U) << all_of(chosen);
  EXPECT_EQ(chosen.specimens[0].record.modulus_pa, 2e8);
  EXPECT_EQ(chosen.specimens[0].provenance.at("part"), "B");
}

TEST_F(Sweeps, WithoutAnAmplitudeTheSheetIsAskedForIt) {
  const std::string text = sweep_table("Frequency (Hz),Storage modulus (MPa)\n", "{0},{3}\n");
  expect_refused(import(text), "strain_amplitude", 2, "`a.csv`");
  expect_usual(import_with_amplitude(text));
  EXPECT_EQ(import_with_amplitude(text).specimens[0].rate_source, "sheet");
  const std::string doubtful = sweep_table("Frequency (Hz),E' (MPa),Strain\n", "{0},{3},0.1\n");
  expect_refused(import(doubtful), "strain_amplitude", 2, "`Strain`");
  expect_usual(import(doubtful, ",unit", ",%"));
  expect_refused(import(sweep_table("Frequency (Hz),E' (MPa),Amplitude (um)\n", "{0},{3},20\n")), "strain_amplitude", 2,
                 "expected the strain amplitude");
  EXPECT_EQ(import(text, ",strain_amplitude", ",5").rejected.at(0).column, "strain_amplitude");
}

TEST_F(Sweeps, AStaticStrainIsNoAmplitude) {
  expect_usual(this->import(sweep_table(
      "Frequency (Hz),E' (MPa),Static strain (%),Dynamic strain (%),Strain rate (1/s)\n", "{0},{3},2.5,0.1,7\n")));
}

TEST_F(Sweeps, OnlyModulusTestsOfHomogeneousMaterialsHaveSweeps) {
  const std::string text = sweep_table("Frequency (Hz),Storage modulus (MPa),Strain (%)\n", "{0},{3},0.1\n");
  expect_refused(import(text, "", "", "577fffe9fffdef,modulus"), "pattern", 2, "homogeneous");
  expect_refused(import(text, "", "", "checkerboard:2,modulus"), "pattern", 2, "homogeneous");
  expect_refused(import(text, "", "", "rigid,tensile"), "test", 2, "`modulus`");
  expect_refused(import(text, "", "", "rigid,"), "test", 2, "`modulus`");
  EXPECT_EQ(import(text, "", "", "rigid,modulus").specimens.size(), 3U);
}

TEST_F(Sweeps, AModulusNeedsAUnit) {
  const std::string text = sweep_table("Frequency (Hz),E',Strain (%)\n", "{0},{3},0.1\n");
  expect_refused(import(text), "E'", 1, "MPa");
  expect_usual(import(text, ",unit", ",MPa"));
  expect_refused(import(sweep_table("Frequency (Hz),E' (stone),Strain (%)\n", "{0},{3},0.1\n")), "E' (stone)", 1,
                 "`stone`");
  expect_refused(import(sweep_table("Frequency,E' (MPa),Strain (%)\n", "{0},{3},0.1\n")), "Frequency", 1, "rad/s");
  expect_usual(import(sweep_table("Frequency,E' (MPa),Strain (%)\n", "{0},{3},0.1\n"), ",unit", ",Hz"));
  expect_refused(import(sweep_table("Temp,Frequency (Hz),E' (MPa),Strain (%)\n", "25,{0},{3},0.1\n")), "Temp", 1, "K");
}

TEST_F(Sweeps, AStorageModulusWithoutFrequencyIsNamed) {
  expect_refused(import(sweep_table("Temp (°C),E'' (MPa),E' (MPa)\n", "25,{4},{3}\n")), "E' (MPa)", 1,
                 "Frequency (Hz)");
}

TEST_F(Sweeps, AModulusInShearIsRefused) {
  expect_refused(import(sweep_table("Frequency (Hz),Storage modulus (MPa),Shear strain (%)\n", "{0},{3},0.1\n")),
                 "Shear strain (%)", 1, "shear");
  expect_refused(import(sweep_table("Frequency (Hz),G' (MPa),Strain (%)\n", "{0},{3},0.1\n")), "G' (MPa)", 1, "shear");
}

TEST_F(Sweeps, RowsWithoutPositiveNumbersAreLeftOutAndThatIsSaid) {
  const Import import = this->import(
      "Frequency (Hz),Storage modulus (MPa),Strain (%)\n,,\n--,1000,0.1\n0,1000,0.1\n0.1,1000,0.1\n1,-3,0.1\n"
      "1,1200,0.1\n2,n.a.,0.1\n3,1300,0\n10,1440,0.1\nMean,1213,0.1\n");
  expect_usual(import);
  EXPECT_THAT(all_of(import), HasSubstr("5 rows left out, the first in line 3"));
  expect_refused(this->import("Frequency (Hz),E' (MPa),Strain (%)\n0,0,0.1\n"), "", 1, "above 0");
}

TEST_F(Sweeps, AWrongUnitIsAskedAboutBeforeAnyOfItsModuliCounts) {
  const Import import = import_with_amplitude(sweep_table("Frequency (Hz),Storage modulus (GPa)\n", "{0},{2}\n"));
  ASSERT_EQ(import.specimens.size(), kUsualSweep.size());
  for (const auto& one : import.specimens) {
    ASSERT_EQ(one.doubts.size(), 1U) << one.record.specimen;
    EXPECT_TRUE(one.doubts[0].is_of_scale);
    EXPECT_THAT(one.doubts[0].text, HasSubstr("Pa are unusual: is the unit right?"));
  }
  EXPECT_TRUE(import_with_amplitude(sweep_table("Frequency (Hz),Storage modulus (MPa)\n", "{0},{3}\n"))
                  .specimens[0]
                  .doubts.empty());
}

TEST_F(Sweeps, RowsTornAtDecimalCommasAreNamed) {
  expect_refused(this->import("Frequency (Hz),E' (MPa),Strain (%)\n0,1,1000,5,0,1\n1,0,1200,5,0,1\n"), "", 2,
                 "6 cells");
}

TEST_F(Sweeps, ANoteTellsFrequencyAndAmplitude) {
  const Import import =
      this->import(sweep_table("Frequency (Hz),E' (MPa),Strain (%)\n", "{0},{3},0.1\n"), ",note,batch", ",dried,march");
  ASSERT_EQ(import.specimens.size(), 3U);
  EXPECT_EQ(import.specimens[1].record.note, "dried; E' at 1 Hz, amplitude 0.001");
  EXPECT_EQ(import.specimens[1].record.batch, "march");
}

TEST_F(Sweeps, ARecordOfExtensionAndForceIsReadAsBefore) {
  std::string text = "Time (s),Extension (mm),Force (N),Frequency (Hz),Modulus (MPa)\n";
  for (int i = 0; i <= 100; ++i) text += fmt::format("{},{},{},1,5\n", i, 0.002 * i, 2e3 * 1e-4 * i * 12.0);
  const Import import = this->import(text);
  ASSERT_EQ(import.specimens.size(), 1U) << all_of(import);
  EXPECT_EQ(import.specimens[0].record.specimen, "s");
  EXPECT_NEAR(*import.specimens[0].record.modulus_pa, 2e9, 1e7);
  std::string both = "Extension (mm),Force (N),Frequency (Hz),Storage modulus (MPa)\n";
  for (int i = 0; i <= 100; ++i) both += fmt::format("{},{},1,5\n", 0.002 * i, 2e3 * 1e-4 * i * 12.0);
  const Import named = this->import(both, ",extension_column,force_column", ",Extension,Force");
  ASSERT_EQ(named.specimens.size(), 1U) << all_of(named);
  EXPECT_NEAR(*named.specimens[0].record.modulus_pa, 2e9, 1e7);
}

TEST_F(Sweeps, TheSetIsReadBackWithPieceAndTemperatureAndTheImportRepeats) {
  const std::string text =
      sweep_table("Frequency (Hz),Temperature (K),E' (MPa),E'' (MPa),Strain (%)\n", "{0},313.15,{3},{4},0.1\n");
  Import first = this->import(text), again = this->import(text);
  write_import(folder_ / "set", "sheet.csv", first);
  const MeasurementSet set = read_measurement_set(folder_ / "set");
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_TRUE(set.warnings.empty()) << set.warnings.front();
  ASSERT_EQ(set.specimens.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(set.specimens[i], first.specimens[i].record);
    EXPECT_EQ(piece_of(set.specimens[i]), "s");
    EXPECT_THAT(surroundings_of(set.specimens[i]).temperature_c.value_or(0.0), DoubleNear(40.0, 1e-9));
  }
  write_import(folder_ / "set", "sheet.csv", again);
  EXPECT_EQ(again.known, 3);
  EXPECT_TRUE(again.warnings.empty()) << "rows without a curve are no twins: " << again.warnings.front();
}

TEST_F(Sweeps, ProvenanceTellsColumnsAndUnits) {
  Import import = this->import(sweep_table(
      "Frequency (Hz),Angular frequency (rad/s),Temperature (K),E' (MPa),Strain (%)\n", "{0},{1},313.15,{3},0.1\n"));
  write_import(folder_ / "set", "sheet.csv", import);
  const std::string text = read_file_up_to(folder_ / "set/provenance.csv", 1 << 20);
  CsvReader reader(text, "provenance.csv");
  CsvRow heading, row;
  ASSERT_TRUE(reader.next(heading) && reader.next(row));
  std::map<std::string, std::string> cells;
  for (std::size_t i = 0; i < heading.cells.size(); ++i) cells[heading.cells[i].text] = row.cells.at(i).text;
  EXPECT_EQ(cells["specimen"], "s-1");
  EXPECT_EQ(cells["first_line"], "2");
  EXPECT_EQ(cells["frequency_column"], "Frequency (Hz)");
  EXPECT_EQ(cells["frequency_not_taken"], "Angular frequency (rad/s)");
  EXPECT_EQ(cells["storage_modulus_column"], "E' (MPa)");
  EXPECT_EQ(cells["storage_modulus_unit"], "MPa");
  EXPECT_EQ(cells["amplitude_unit"], "%");
  EXPECT_EQ(cells["temperature_unit"], "K");
}

TEST_F(Sweeps, ProvenanceUnderAnEarlierHeadingIsKept) {
  Import import = this->import(sweep_table("Frequency (Hz),E' (MPa),Strain (%)\n", "{0},{3},0.1\n"));
  fs::create_directories(folder_ / "set");
  std::ofstream(folder_ / "set/provenance.csv") << "specimen,test,file\nold,toughness,b.csv\n";
  write_import(folder_ / "set", "sheet.csv", import);
  const std::string text = read_file_up_to(folder_ / "set/provenance.csv", 1 << 20);
  EXPECT_THAT(text, HasSubstr("\nold,toughness,b.csv,,"));
  EXPECT_THAT(text, HasSubstr("\ns-1,modulus,a.csv,1,"));
}

TEST_F(Sweeps, TheListNamesTheColumnsThatAreTaken) {
  ColumnChoice choice;
  choice.unit = "C";
  const auto held =
      list_export(sweep_table("Temp,Frequency / Hz,Tan(delta),E' (MPa)\n", "a,{0},{5},{3}\n"), "a.csv", choice);
  ASSERT_TRUE(held) << held.error().reason;
  ASSERT_EQ(held->parts.size(), 1U);
  EXPECT_EQ(held->parts[0].rows, 3U);
  EXPECT_TRUE(held->parts[0].fault.empty()) << held->parts[0].fault;
  ASSERT_EQ(held->parts[0].columns.size(), 4U);
  EXPECT_EQ(held->parts[0].columns[1].quantity, "frequency");
  EXPECT_EQ(held->parts[0].columns[1].unit, "Hz");
  EXPECT_EQ(held->parts[0].columns[2].quantity, "");
  EXPECT_EQ(held->parts[0].columns[3].quantity, "storage_modulus");
  EXPECT_TRUE(held->parts[0].columns[3].taken);
  EXPECT_DOUBLE_EQ(held->parts[0].columns[3].most, 1440.0);
}

TEST_F(Sweeps, ANameThatTheSheetHasIsRefused) {
  std::ofstream(folder_ / "a.csv") << sweep_table("Frequency (Hz),E' (MPa),Strain (%)\n", "{0},{3},0.1\n");
  std::ofstream(folder_ / "sheet.csv") << "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm\n"
                                          "a.csv,s,rigid,modulus,6,2,20\nb.csv,s-2,rigid,modulus,6,2,20\n";
  const Import import = import_exports({}, folder_ / "sheet.csv");
  EXPECT_TRUE(import.specimens.empty());
  ASSERT_EQ(import.rejected.size(), 2U);
  EXPECT_EQ(import.rejected[0].column, "specimen");
}

}  // namespace
}  // namespace nacre::measurement
