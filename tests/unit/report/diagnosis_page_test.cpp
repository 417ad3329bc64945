#include "report/diagnosis_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/gain_words.hpp"
#include "diagnosis/words.hpp"

namespace nacre::report {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Feature;
using diagnosis::Gain;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Diagnosis named_with(const Gain& gain) {
  Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  d.effects = {{"machine_compliance", "measurement", 2e-10, 1e-10, 3e-10, "1/Pa"}};
  d.gain = gain;
  return d;
}

std::string gain_section(const Gain& gain) {
  const std::string page = render_diagnosis_page(named_with(gain), "a-set", tester::Fidelity::full);
  const auto begin = page.find("<section id=\"gain\">");
  return begin == std::string::npos ? "" : page.substr(begin, page.find("</section>", begin) - begin);
}

TEST(DiagnosisPage, AnErrorThatGrowsIsNotCalledAGain) {
  EXPECT_THAT(gain_section({0.03, 0.05, -0.67, -0.9, -0.4, {}}), AllOf(HasSubstr("grows"), Not(HasSubstr("falls"))));
  EXPECT_THAT(gain_section({0.03, 0.028, 0.07, -0.2, 0.3, {}}),
              AllOf(HasSubstr("not established"), Not(HasSubstr("falls"))));
  EXPECT_THAT(gain_section({0.05, 0.03, 0.4, 0.2, 0.6, {}}), HasSubstr("falls"));
}

TEST(DiagnosisPage, WhatTheNearestCauseGainsIsSaidAsSurelyAsItIsKnown) {
  Diagnosis d;
  d.verdict = diagnosis::Verdict::unexplained;
  d.partial_gain = Gain{0.03, 0.028, 0.07, -0.2, 0.3, {}};
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full), HasSubstr("not established"));
}

TEST(DiagnosisPage, SaysFromWhichSizeOnACauseWouldHaveShown) {
  Diagnosis d;
  d.candidates.resize(2);
  d.candidates[0].name = "droplet_mixing";
  d.candidates[0].smallest_seen = 0.31;
  d.candidates[1].name = "machine_compliance";
  const std::string page = render_diagnosis_page(d, "a-set", tester::Fidelity::full);
  EXPECT_THAT(page, HasSubstr("<td>0.310 pixels</td>"));
}

TEST(DiagnosisPage, GainIsTheSentenceOfTheSummary) {
  const Gain gain{0.2, 0.1, 0.5, 0.3, 0.7, {}};
  EXPECT_THAT(gain_section(gain), HasSubstr(gain_in_words(gain)));
  // e^0.2 - 1 and e^0.1 - 1: errors are of logarithms.
  EXPECT_THAT(gain_section(gain), HasSubstr("from 22.1 to 10.5 %"));
}

TEST(DiagnosisPage, SaysWhetherTheChoiceOfDesignsChanges) {
  Gain gain{0.2, 0.1, 0.5, 0.3, 0.7, {{Feature::log_modulus, 0.2, 0.1, 0.05, {120, 96, 119}}}};
  EXPECT_THAT(gain_section(gain), HasSubstr("the extended model ranks 119 as measured, the base model 96"));
  gain.features[0].ranking.before = 119;
  EXPECT_THAT(gain_section(gain), HasSubstr("both models rank 119 as measured"));
  gain.of_coupons = true;
  EXPECT_THAT(gain_section(gain), Not(HasSubstr("as measured")));
}

TEST(DiagnosisPage, ShowsTheStrongestTrendsFirst) {
  Diagnosis d = named_with({});
  d.descriptors = {"rigid fraction"};
  for (const double x : {0.5, 0.6, 0.7}) {
    diagnosis::ResidualRow row;
    row.measured = 20.0 + x;
    row.base = 20.0;
    row.standard_error = 0.01;
    row.descriptors = {x};
    d.residuals.push_back(row);
  }
  const diagnosis::ContrastView whole{Feature::log_modulus, tester::TestKind::modulus, ""};
  auto level = whole, fraction = whole;
  level.against = diagnosis::kPredictedLevel;
  fraction.against = "rigid fraction";
  d.contrasts = {{"whole", whole, 9.0, 0.0}, {"level", level, 8.0, 0.0}, {"fraction", fraction, 7.0, 0.0}};
  const std::string page = render_diagnosis_page(d, "a-set", tester::Fidelity::full);
  const auto first = page.find("8 σ"), second = page.find("7 σ");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_EQ(page.find("9 σ"), std::string::npos) << "a whole feature has nothing to be drawn against";
  EXPECT_THAT(page, HasSubstr("modulus predicted, MPa"));
}

TEST(DiagnosisPage, OrientationHasTicksAtUprightAndTurned) {
  Diagnosis d = named_with({});
  d.descriptors = {"orientation"};
  for (const double x : {0.0, 90.0, 90.0}) {
    diagnosis::ResidualRow row;
    row.measured = 20.0 + 0.01 * x;
    row.base = row.extended = 20.0;
    row.standard_error = 0.01;
    row.descriptors = {x};
    d.residuals.push_back(row);
  }
  d.contrasts = {{"orientation", {Feature::log_modulus, tester::TestKind::modulus, "orientation"}, 7.0, 0.0}};
  const std::string page = render_diagnosis_page(d, "a-set", tester::Fidelity::full);
  EXPECT_THAT(page, AllOf(HasSubstr("class=\"tick middle\">0</text>"), HasSubstr("class=\"tick middle\">90</text>"),
                          Not(HasSubstr("class=\"tick middle\">50</text>"))));
}

TEST(DiagnosisPage, BarsEndAtOneStandardErrorOfTheLogarithm) {
  Diagnosis d = named_with({});
  d.descriptors = {"rigid fraction"};
  for (const double x : {0.5, 0.6, 0.7}) {
    diagnosis::ResidualRow row;
    row.measured = 20.0 + std::log(3.0);
    row.base = row.extended = 20.0;
    row.standard_error = std::log(1.5);
    row.descriptors = {x};
    d.residuals.push_back(row);
  }
  diagnosis::ContrastView fraction{Feature::log_modulus, tester::TestKind::modulus, ""};
  fraction.against = "rigid fraction";
  d.contrasts = {{"fraction", fraction, 7.0, 0.0}};
  const std::string page = render_diagnosis_page(d, "a-set", tester::Fidelity::full);
  // +200 %, from 3 / 1.5 - 1 = 100 % to 3 x 1.5 - 1 = 350 %: the bar reaches 1.5 times as far up as down.
  const auto number_after = [&](std::string_view mark, std::size_t from) {
    return std::stod(page.substr(page.find(mark, from) + mark.size()));
  };
  const std::size_t bar = page.find("meas bar\""), dot = page.find("class=\"meas dot\"");
  ASSERT_NE(bar, std::string::npos);
  ASSERT_NE(dot, std::string::npos);
  const double middle = number_after("cy=\"", dot), from = number_after(" ", page.find("d=\"M", bar)),
               to = number_after("V", bar);
  EXPECT_NEAR((middle - to) / (from - middle), 1.5, 0.02);
}

TEST(DiagnosisPage, TooFewDataClaimNothing) {
  const std::string page = render_diagnosis_page(diagnosis::insufficient("three groups of layouts have a valid test"),
                                                 "a-set", tester::Fidelity::full);
  EXPECT_THAT(page, AllOf(HasSubstr("<h1>Too little was measured to tell</h1>"), HasSubstr("three groups of layouts")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("Something is wrong")), Not(HasSubstr("<section")), Not(HasSubstr("<ul>")),
                          Not(HasSubstr("scatter by")), Not(HasSubstr("Procedure"))));
}

diagnosis::MeasuredMean mean_at(double rate_per_s, double mean_pa) {
  diagnosis::MeasuredMean mean;
  mean.design = "rigid";
  mean.pieces = 3;
  mean.mean_pa = mean_pa;
  mean.conditions.strain_rate_per_s = rate_per_s;
  mean.low_pa = 0.9 * mean_pa;
  mean.high_pa = 1.1 * mean_pa;
  mean.scatter = 0.06;
  return mean;
}

TEST(DiagnosisPage, DataOfHomogeneousSpecimensComeFirst) {
  Diagnosis d = named_with({});
  d.data.means = {mean_at(1e-3, 2.0e9), mean_at(1e-1, 2.6e9)};
  d.data.trends = {{.of = "rigid",
                    .condition = "strain_rate_per_s",
                    .from = "0.001",
                    .to = "0.1",
                    .pieces = 6,
                    .ratio = 1.3,
                    .low = 1.2,
                    .high = 1.4,
                    .chance = 0.0004,
                    .exponent = 0.057,
                    .exponent_low = 0.04,
                    .exponent_high = 0.07}};
  const std::string page = render_diagnosis_page(d, "a-set", tester::Fidelity::full);
  const std::size_t data = page.find("<section id=\"data\">");
  ASSERT_NE(data, std::string::npos);
  EXPECT_LT(data, page.find("<section id=\"where\">"));
  EXPECT_THAT(page, AllOf(HasSubstr("Modulus against strain rate"), HasSubstr("1800 … 2200"), HasSubstr("6.0 %"),
                          HasSubstr("1.30"), HasSubstr("&lt; 0.001")));
  d.finding.reason = diagnosis::Reason::free_form;
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full), HasSubstr("The cause is the strain rate"));
  d.data.means = {};
  d.data.trends = {};
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full), Not(HasSubstr("id=\"data\"")));
}

TEST(DiagnosisPage, WhatAnEffectTakesBesideItsSizeHasItsInterval) {
  Diagnosis d = named_with({});
  d.effects = {{"rate_dependence", "rate", 0.5, 0.45, 0.55, "1", {{11.9, 9.7, 14.6}}}};
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full),
              HasSubstr("<strong>11.9 s</strong>, with 90 % certainty between 9.70 and 14.6"));
}

TEST(DiagnosisPage, AnAssumedScatterIsNotSaidToBeThatOfReplicates) {
  Diagnosis d;
  d.replicate_sd = 0.02;
  d.noise_known = false;
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full),
              AllOf(HasSubstr("A scatter of 2.0 % is assumed"), Not(HasSubstr("Replicates scatter"))));
  d.noise_known = true;
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full),
              AllOf(HasSubstr("Replicates scatter by 2.0 %"), Not(HasSubstr("is assumed"))));
}

TEST(DiagnosisPage, SeveralCausesAreListed) {
  Diagnosis d;
  d.verdict = diagnosis::Verdict::ambiguous;
  d.possible = {{"machine_compliance"}, {"droplet_mixing"}};
  d.procedure = "abc";
  EXPECT_THAT(render_diagnosis_page(d, "a-set", tester::Fidelity::full),
              AllOf(HasSubstr("these data leave several causes"), HasSubstr("<li>"), HasSubstr("Procedure abc.")));
}

TEST(DiagnosisPage, EveryFeatureHasItsOwnUnit) {
  const std::string gain = gain_section({0.2,
                                         0.1,
                                         0.5,
                                         0.3,
                                         0.7,
                                         {{Feature::log_peak, 0.2, 0.1, 0.05},
                                          {Feature::toe_strain, 0.004, 0.002, 0.001},
                                          {Feature::knee, 0.2, 0.1, 0.05}}});
  EXPECT_THAT(gain, HasSubstr("<td>%</td><td>22.1</td><td>10.5</td><td>5.13</td>"));
  EXPECT_THAT(gain, HasSubstr("<td>% strain</td><td>0.400</td><td>0.200</td><td>0.100</td>"));
  EXPECT_THAT(gain, HasSubstr("<td>x 100</td><td>20.0</td><td>10.0</td><td>5.00</td>"));
}

}  // namespace
}  // namespace nacre::report
