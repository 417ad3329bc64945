#include "report/paper.hpp"

#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "report/standalone.hpp"
#include "sample_run.hpp"

namespace nacre::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kThesis = std::filesystem::path(NACRE_SOURCE_DIR) / "data" / "thesis";

run::FamilyRecord family(int number, bool over_fits) {
  run::FamilyRecord family;
  family.stated.name = "family-" + std::to_string(number + 1);
  family.stated.number = number;
  family.stated.count = 2;
  family.stated.is_validated = true;
  RandomStream random(static_cast<std::uint64_t>(number + 1), "family");
  const auto patterns = pattern::stratified_patterns(6, random);
  for (int i = 0; i < 5; ++i) {
    const bool is_seed = i < 2;
    const double own = is_seed ? 1.01 : over_fits ? 1.6 : 1.1;  // the global model is off by a third everywhere
    family.stated.designs.push_back({patterns[i], is_seed, {1.5e9, 4e5}, {1.6e9, 4e5 * 1.33}, {1.5e9, 4e5 * own}});
  }
  run::Gamut gamut;
  for (const pattern::Pattern& p : patterns) {
    gamut.patterns.push_back(p.bits());
    gamut.performances.push_back(sample::true_performance(p));
  }
  family.gamut = std::make_shared<const run::Gamut>(std::move(gamut));
  return family;
}

PaperSource source(bool stage = true) {
  PaperSource source;
  source.run_id = "a-run";
  source.run = sample::run();
  source.thesis = game::read_thesis_tables(kThesis);
  for (const auto& [number, round] : source.run.rounds) {
    source.searches.push_back({number, 0, gamut_of(round).performances});
    for (const auto& [design, simulation] : round.simulated)
      source.predictions[number][design] = {simulation.modulus_pa, simulation.toughness_pa};
  }
  source.predictions[0]["rigid"] = {2.66e9, 7.5e4};
  if (!stage) return source;
  source.run.families = {family(0, true), family(1, false)};
  for (const run::FamilyRecord& each : source.run.families)
    source.groups.push_back({each.stated.name, {each.stated.designs[0].pattern, each.stated.designs[1].pattern}});
  SubfamilyMap map{.family = "family-1", .seed = source.groups[0].seeds[0].key(), .points = {}};
  for (int i = 0; i < 12; ++i) {
    MapPoint& point = map.points.emplace_back();
    point.pattern = pattern::Pattern(source.run.families[0].gamut->patterns[i % 6]);
    point.source = i == 0 ? "seed" : i < 10 ? "sampled" : "interpolated";
    point.x = i % 4;
    point.y = 0.3 * i;
    if (i < 10) point.x_sampled = point.x, point.y_sampled = point.y;
    point.performance = sample::true_performance(point.pattern);
  }
  source.maps.push_back(map);
  return source;
}

const std::vector<std::string> kIds = {"figure-3-2", "figure-3-3",  "figure-3-4",  "table-3-4",   "figure-3-7",
                                       "figure-3-9", "figure-3-12", "figure-3-13", "figure-3-14", "figure-3-15",
                                       "table-3-7",  "figure-3-16", "figure-3-17", "figure-3-18", "table-a-3",
                                       "table-a-4",  "table-a-5",   "table-a-6",   "table-a-7"};

const Exhibit& exhibit(const std::vector<Exhibit>& all, const std::string& id) {
  return *std::ranges::find(all, id, &Exhibit::id);
}

TEST(Paper, HoldsEveryFigureAndTableInTheOrderOfTheThesis) {
  std::vector<std::string> ids;
  for (const Exhibit& each : exhibits_of(source())) ids.push_back(each.id);
  EXPECT_EQ(ids, kIds);
}

TEST(Paper, WhatIsMissingIsSaidInItsPlaceAndNothingIsInvented) {
  PaperSource nothing;
  nothing.run_id = "an-empty-run";
  for (const Exhibit& each : exhibits_of(nothing)) {
    EXPECT_FALSE(each.notes.empty()) << each.id;
    EXPECT_TRUE(each.figures.empty()) << each.id;
    for (const ExhibitTable& table : each.tables) EXPECT_TRUE(table.rows.empty()) << each.id << ' ' << table.name;
  }
  const auto without_stage = exhibits_of(source(false));
  for (const char* id : {"figure-3-14", "figure-3-15", "table-3-7", "table-a-5", "table-a-6"})
    EXPECT_THAT(exhibit(without_stage, id).notes.front(), HasSubstr("played no family stage")) << id;
}

TEST(Paper, TheThesisErrorsComeOutOfItsAppendixAsItsTableSays) {
  const auto all = exhibits_of(source());
  const ExhibitTable& table = exhibit(all, "figure-3-7").tables.front();
  ASSERT_EQ(table.rows.size(), 8U) << "four rounds here, four of the thesis";
  const auto& last = table.rows.back();  // Table 3.5, round 4: E 18.95 and 6.50 %, T 82.38 and 27.10 %
  EXPECT_NEAR(std::stod(last[2].kept), 0.1895, 0.001);
  EXPECT_NEAR(std::stod(last[4].kept), 0.0650, 0.001);
  EXPECT_NEAR(std::stod(last[6].kept), 0.8238, 0.003);
  EXPECT_NEAR(std::stod(last[8].kept), 0.2710, 0.002);
  EXPECT_EQ(table.kinds.back(), TableRowKind::thesis);
}

TEST(Paper, ErrorsOfAPropertyThatWasNotMeasuredAreNoPoints) {
  const auto figure = [](const PaperSource& run, const std::string& property) {
    const auto all = exhibits_of(run);
    for (const ExhibitFigure& each : exhibit(all, "figure-3-7").figures)
      if (each.name == "figure-3-7-" + property) return each.svg;
    return std::string();
  };
  PaperSource run = source();
  for (auto& [number, round] : run.run.rounds) round.summary->held_out.modulus_count = 0;
  EXPECT_THAT(figure(run, "modulus"), Not(HasSubstr("out-of-sample")));
  EXPECT_THAT(figure(run, "toughness"), HasSubstr("out-of-sample"));
  for (auto& [number, round] : run.run.rounds)
    round.summary->before.toughness_count = round.summary->after.toughness_count =
        round.summary->held_out.toughness_count = 0;
  EXPECT_EQ(figure(run, "toughness"), "");
}

TEST(Paper, EveryPictureHoldsItsColoursItself) {
  std::size_t pictures = 0;
  for (const Exhibit& each : exhibits_of(source()))
    for (const ExhibitFigure& figure : each.figures) {
      if (figure.svg.empty()) continue;
      const std::string file = standalone(figure.svg);
      EXPECT_THAT(file, AllOf(Not(HasSubstr("var(")), HasSubstr(".line.sim { stroke: #2a66a8;"))) << figure.name;
      ++pictures;
    }
  EXPECT_GT(pictures, 5U);
}

TEST(Paper, ATwinPulledFasterIsNoMeasurementOfTheBaseMaterial) {
  PaperSource run = source();
  const auto base_note = [&] {
    const auto all = exhibits_of(run);
    for (const std::string& note : exhibit(all, "figure-3-4").notes)
      if (note.starts_with("The tougher ink alone")) return note;
    return std::string();
  };
  run.run.specimens.push_back(sample::specimen(pattern::Mixture{1.0}, {2.6e9, 2e5}, tester::TestKind::toughness, 1, 1));
  const std::string before = base_note();
  ASSERT_THAT(before, HasSubstr("MPa"));
  run.run.specimens.push_back(sample::specimen(pattern::Mixture{1.0}, {2.6e9, 2e6}, tester::TestKind::toughness, 1, 2));
  run.run.specimens.back().record.conditions.strain_rate_per_s *= 100.0;
  EXPECT_EQ(base_note(), before);
}

TEST(Paper, TheThesisHypervolumesComeOutOfItsAppendix) {
  const auto all = exhibits_of(source());
  const ExhibitTable& table = exhibit(all, "figure-3-3").tables.front();
  const double expected[] = {0.655, 0.698, 0.911, 0.911, 0.911};
  ASSERT_EQ(table.rows.size(), 9U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(std::stod(table.rows[4 + i][1].kept), expected[i], 0.001);
    EXPECT_EQ(table.rows[4 + i][2].kept, "") << "what the thesis does not say is no text in a column of numbers";
  }
}

TEST(Paper, FamilyTablesOfTheThesisComeOutOfItsAppendix) {
  const auto all = exhibits_of(source());
  const auto seed_row = exhibit(all, "figure-3-14").tables.front().rows.at(2);  // thesis, family 1: Table 3.6
  EXPECT_NEAR(std::stod(seed_row[2].kept), 0.1077, 0.001);
  EXPECT_NEAR(std::stod(seed_row[8].kept), 0.0455, 0.001);
  const auto validation_row = exhibit(all, "table-3-7").tables.front().rows.at(2);
  EXPECT_NEAR(std::stod(validation_row[6].kept), 0.1424, 0.001);
  EXPECT_NEAR(std::stod(validation_row[9].kept), 1.0279, 0.002);
}

TEST(Paper, AnOverFittedFamilyIsNamedAndASoundOneNot) {
  const std::string note = exhibit(exhibits_of(source()), "table-3-7").notes.front();
  EXPECT_THAT(note, HasSubstr("Over-fitted: family-1 (T)"));
  EXPECT_THAT(note, Not(HasSubstr("family-2")));
}

/// The designs of a family of the run, seeds or chosen, without what was measured of them in a property.
void forget(PaperSource& run, std::size_t family, bool seeds, std::optional<double> game::DesignValues::*property) {
  for (game::FamilyDesign& design : run.run.families[family].stated.designs)
    if (design.is_seed == seeds) (design.measured.*property).reset();
}

TEST(Paper, AnErrorOfDesignsThatWereNotMeasuredIsADash) {
  PaperSource run = source();
  forget(run, 1, false, &game::DesignValues::modulus_pa);
  const auto row = exhibit(exhibits_of(run), "table-3-7").tables.front().rows.at(1);
  for (std::size_t i = 2; i < 6; ++i) {
    EXPECT_EQ(row[i].shown, "–") << i;
    EXPECT_EQ(row[i].kept, "") << i;
  }
  EXPECT_EQ(row[1].kept, "3");
  EXPECT_NEAR(std::stod(row[8].kept), 0.1, 1e-3);

  run = source();
  forget(run, 1, false, &game::DesignValues::toughness_pa);
  const auto moduli_alone = exhibit(exhibits_of(run), "table-3-7").tables.front().rows.at(1);
  EXPECT_EQ(moduli_alone[1].kept, "3");
  EXPECT_EQ(moduli_alone[6].kept, "");
}

TEST(Paper, FamiliesWhoseDesignsWereNotMeasuredHaveNoVerdict) {
  PaperSource run = source();
  for (const std::size_t family : {0, 1}) {
    forget(run, family, false, &game::DesignValues::modulus_pa);
    forget(run, family, false, &game::DesignValues::toughness_pa);
  }
  const std::vector<Exhibit> all = exhibits_of(run);
  const std::vector<std::string>& notes = exhibit(all, "table-3-7").notes;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("No verdict: family-1 (T not measured), family-1 (E not measured), family-2"));
  EXPECT_THAT(notes[0], Not(HasSubstr("over-fits")));
}

TEST(Paper, AVerdictSaysWhatItIsOf) {
  PaperSource run = source();
  forget(run, 0, false, &game::DesignValues::toughness_pa);  // the over-fitted property
  for (game::FamilyDesign& design : run.run.families[1].stated.designs) design.family_model.modulus_pa.reset();
  const std::vector<Exhibit> all = exhibits_of(run);
  const std::vector<std::string>& notes = exhibit(all, "table-3-7").notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_THAT(notes[0], HasSubstr("No verdict: family-1 (T not measured), family-2 (E not simulated)"));
  EXPECT_THAT(notes[1], HasSubstr("Of what could be compared, no family's model over-fits"));
}

TEST(Paper, SeedErrorsOfAPropertyThatWasNotMeasuredAreNoPoints) {
  PaperSource run = source();
  for (const std::size_t family : {0, 1}) forget(run, family, true, &game::DesignValues::modulus_pa);
  const std::vector<Exhibit> all = exhibits_of(run);
  const std::vector<ExhibitFigure>& figures = exhibit(all, "figure-3-14").figures;
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].name, "figure-3-14-toughness");
  forget(run, 0, true, &game::DesignValues::toughness_pa);
  const auto dots = [](const std::string& svg) {
    std::size_t found = 0;
    for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++found;
    return found;
  };
  EXPECT_LT(dots(exhibit(exhibits_of(run), "figure-3-14").figures[0].svg), dots(figures[0].svg));
}

TEST(Paper, ThePageStandsByItself) {
  const PaperSource run = source();
  const std::string page = render_paper(run, exhibits_of(run));
  for (const char* outside : {"http:", "https:", "<script", "<link", "@import", "src="})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const std::string& id : kIds) EXPECT_THAT(page, HasSubstr("<section id=\"" + id + "\">"));
}

TEST(Paper, FilesAreWholeTablesAndPicturesThatStandAlone) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "paper_files";
  std::filesystem::remove_all(folder);
  write_paper(folder, source());
  int pictures = 0, tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string text = read_file(entry.path());
    if (entry.path().extension() == ".svg") {
      ++pictures;
      EXPECT_THAT(text, HasSubstr("xmlns=\"http://www.w3.org/2000/svg\"")) << entry.path();
      EXPECT_THAT(text, HasSubstr("<style>")) << entry.path();
    } else if (entry.path().extension() == ".csv") {
      ++tables;
      CsvReader reader(text, entry.path().string());
      std::size_t columns = 0;
      for (CsvRow row; reader.next(row);) {
        EXPECT_EQ(row.fault, "");
        if (columns == 0) columns = row.cells.size();
        EXPECT_EQ(row.cells.size(), columns) << entry.path();
      }
    }
  }
  EXPECT_GE(pictures, 20);
  EXPECT_GE(tables, 17);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace nacre::report
