#include "report/report_data.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "report/svg.hpp"
#include "sample_run.hpp"

namespace nacre::report {
namespace {

using optimize::Performance;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Column `name` of a table of the thesis, as numbers.
std::vector<double> column_of(const std::string& file, const std::string& name) {
  const std::string text = read_file(std::string(NACRE_SOURCE_DIR) + "/data/thesis/" + file);
  CsvReader reader(text, file);
  CsvRow row;
  std::size_t column = 0;
  std::vector<double> values;
  for (bool is_header = true; reader.next(row); is_header = false) {
    if (row.blank()) continue;
    if (is_header) {
      while (column < row.cells.size() && row.cells[column].text != name) ++column;
    } else {
      values.push_back(number_from_text(row.cells.at(column).text).value());
    }
  }
  return values;
}

TEST(Baselines, OnTheTablesOfTheThesisAreItsTrivialErrors) {
  const auto fraction = column_of("microstructures_modulus.csv", "rigid_fraction_percent");
  const auto modulus = column_of("microstructures_modulus.csv", "measured_gpa");
  const auto toughness = column_of("microstructures_toughness.csv", "measured_mpa");
  const Baselines trivial = baselines(fraction, modulus, toughness);
  EXPECT_EQ(trivial.count, 42);
  EXPECT_NEAR(trivial.linear_modulus.value(), 0.071, 0.0005);
  EXPECT_NEAR(trivial.constant_toughness.value(), 0.31, 0.005);
  EXPECT_NEAR(trivial.toughness_pa, 0.304, 0.002);
}

TEST(Baselines, NeedEnoughDesigns) {
  const Baselines none = baselines({}, {}, {});
  EXPECT_FALSE(none.linear_modulus);
  EXPECT_FALSE(none.constant_toughness);
  const std::vector<double> same = {0.5, 0.5, 0.5}, values = {1.0, 2.0, 3.0};
  EXPECT_FALSE(baselines(same, values, values).linear_modulus);
}

TEST(Improvement, IsTheRatioToTheLineAtTheSameEOrT) {
  const std::vector<Performance> line = {{1e9, 0.4e6}, {2e9, 0.2e6}};
  const Improvement improvement = improvement_over(line, {1.5e9, 0.375e6});
  EXPECT_DOUBLE_EQ(improvement.toughness.value(), 0.375 / 0.3);
  EXPECT_DOUBLE_EQ(improvement.modulus.value(), 1.5 / 1.125);
}

TEST(Improvement, IsNotGivenOutsideTheLine) {
  const std::vector<Performance> line = {{1e9, 0.4e6}, {2e9, 0.2e6}};
  const Improvement improvement = improvement_over(line, {2.5e9, 0.5e6});
  EXPECT_FALSE(improvement.modulus);
  EXPECT_FALSE(improvement.toughness);
  EXPECT_FALSE(improvement_over({}, {1e9, 1e6}).modulus);
}

TEST(Improvement, ComparesWithTheBestPointOfALineThatFolds) {
  const std::vector<Performance> line = {{0.1e9, 0.1e6}, {1e9, 0.5e6}, {2e9, 0.1e6}};  // T = 0.3 at E = 0.55 and 1.5
  EXPECT_DOUBLE_EQ(improvement_over(line, {3e9, 0.3e6}).modulus.value(), 2.0);
}

TEST(MeasuredPatterns, AreThoseKnownInTheRound) {
  const run::RunRecord run = sample::run(2);
  EXPECT_EQ(measured_patterns(run, 0).size(), 0u);
  EXPECT_EQ(measured_patterns(run, 1).size(), 10u);
  const auto all = measured_patterns(run, 2);
  EXPECT_EQ(all.size(), 14u);
  EXPECT_EQ(all.front().modulus_count, 3);
  EXPECT_GT(all.front().toughness_sd_pa, 0.0);
}

TEST(MeasuredPatterns, NobodyOrderedKeepTheRoundTheyWereMeasuredIn) {
  run::RunRecord run = sample::run(2);
  for (run::MeasuredSpecimen& m : run.specimens) m.round = -1;
  EXPECT_EQ(measured_patterns(run, 1).size(), 10u);
  for (const MeasuredPattern& pattern : measured_patterns(run, 2)) EXPECT_LE(pattern.round, 2);
}

TEST(Thinning, KeepsTheFrontAndBoundsTheRest) {
  std::vector<Performance> points;
  for (int i = 0; i < 10'000; ++i) points.push_back({1e5 * (i % 100 + 1), 1e3 * (i / 100 + 1)});
  const auto kept = thinned(points, 1500);
  EXPECT_LE(kept.size(), 1501u);
  EXPECT_EQ(optimize::pareto_front(kept), optimize::pareto_front(points));
}

TEST(Ticks, AreRoundAndInsideTheRange) {
  EXPECT_THAT(round_ticks({0.0, 1.0}, 5), ElementsAre(0.0, testing::DoubleEq(0.2), testing::DoubleEq(0.4),
                                                      testing::DoubleEq(0.6), testing::DoubleEq(0.8), 1.0));
  EXPECT_THAT(round_ticks({-3.0, 17.0}, 5), ElementsAre(0.0, 5.0, 10.0, 15.0));
  EXPECT_THAT(round_ticks({2.0, 2.0}, 5), ElementsAre());
}

TEST(Plot, LeavesOutWhatIsNotFinite) {
  Plot plot({.title = "t", .x_label = "x", .y_label = "y", .x = {0.0, 1.0}, .y = {0.0, 1.0}});
  const std::vector<PlotPoint> points = {{0.5, 0.5}, {std::nan(""), 0.5}, {0.1, INFINITY}};
  plot.dots(points, Ink::measured, "");
  plot.line(points, Ink::measured, Stroke::solid, "");
  plot.cloud(points, Ink::measured, "");
  EXPECT_THAT(plot.svg(), testing::AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(Plot, StaircaseBoundsTheDominatedArea) {
  Plot plot({.title = "t",
             .x_label = "x",
             .y_label = "y",
             .x = {0.0, 4.0},
             .y = {0.0, 2.0},
             .width = 462,
             .height = 270});  // 100 px a unit
  const std::vector<PlotPoint> front = {{1.0, 2.0}, {3.0, 1.0}};
  plot.staircase(front, Ink::measured, "front");
  EXPECT_THAT(plot.svg(), HasSubstr("d=\"M0.0 0.0L100.0 0.0L100.0 100.0L300.0 100.0L300.0 200.0\""));
}

}  // namespace
}  // namespace nacre::report
