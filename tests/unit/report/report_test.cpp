#include "report/report.hpp"

#include <regex>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/report_text.hpp"
#include "sample_run.hpp"

namespace nacre::report {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// The section with this id.
std::string section_of(const std::string& page, const std::string& id) {
  const auto begin = page.find("<section id=\"" + id + "\">");
  return begin == std::string::npos ? "" : page.substr(begin, page.find("</section>", begin) - begin);
}

/// The first element that is closed wrongly or never; empty for a page in order.
std::string fault_of_markup(const std::string& page) {
  static const std::regex kTag("<(/?)([a-zA-Z0-9]+)[^<>]*?(/?)>");
  static const std::set<std::string> kVoid = {"meta"};
  std::vector<std::string> open;
  for (std::sregex_iterator tag(page.begin(), page.end(), kTag), end; tag != end; ++tag) {
    const std::string name = (*tag)[2];
    if (kVoid.contains(name) || (*tag)[3] == "/") continue;
    if ((*tag)[1] != "/") {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

TEST(Report, EmptyRunSaysWhatIsAwaited) {
  const std::string page = render_report({}, "a-run");
  for (const char* id : {"gamuts", "rounds", "errors", "best", "proposals", "curves", "diagnosis", "specimens"}) {
    EXPECT_THAT(section_of(page, id), HasSubstr("Still awaited")) << id;
  }
  EXPECT_EQ(fault_of_markup(page), "");
}

TEST(Report, RunningGameLeavesNothingAwaited) {
  const std::string page = render_report(sample::run(), "a-run");
  EXPECT_THAT(page, Not(HasSubstr("Still awaited")));
  EXPECT_EQ(fault_of_markup(page), "");
}

TEST(Report, SaysWhatAnotherRoundIsExpectedToBring) {
  EXPECT_THAT(render_report(sample::run(), "a-run"),
              ContainsRegex("Another round: round 2 brought [0-9.]+ ± [0-9.]+ GPa MPa of measured hypervolume, round 3 "
                            "[0-9.]+ ± [0-9.]+; round 4 "));
  EXPECT_THAT(render_report(sample::run(0), "a-run"), Not(HasSubstr("Another round")));
}

std::string head_of(const std::string& page) {
  return page.substr(page.find("<header>"), page.find("</header>") - page.find("<header>"));
}

TEST(Report, BeginsWithTheBestDesignAndItsGainOverMixtures) {
  const std::string head = head_of(render_report(sample::run(), "a-run"));
  EXPECT_THAT(head, AllOf(HasSubstr("Best of 18 measured patterns"), HasSubstr("<svg class=\"unit\""),
                          ContainsRegex("[0-9]\\.[0-9][0-9] times the toughness of a mixture of equal stiffness"),
                          ContainsRegex("E = [0-9.]+ ± [0-9.]+ GPa, T = [0-9.]+ ± [0-9.]+ MPa")));
  EXPECT_LT(head.find("times the toughness"), head.find("Round 3 is closed"));
  EXPECT_THAT(head_of(render_report(sample::run(0), "a-run")), Not(HasSubstr("Best of")));
}

TEST(Report, WithoutMixturesTheToughestPatternIsCalledThat) {
  run::RunRecord run = sample::run();
  for (auto& [number, round] : run.rounds) round.model->benchmark.clear();
  const std::string head = head_of(render_report(run, "a-run"));
  EXPECT_THAT(head, AllOf(HasSubstr("The toughest pattern; no mixture of equal stiffness has been measured"),
                          Not(HasSubstr("times the toughness of a mixture of equal"))));
}

TEST(Report, AGameWithoutAGainSaysSo) {
  run::RunRecord run = sample::run();
  for (auto& [number, round] : run.rounds)
    for (optimize::Performance& mixture : round.model->benchmark) mixture.toughness_pa *= 10.0;
  EXPECT_THAT(head_of(render_report(run, "a-run")), HasSubstr("No pattern beats a mixture yet: the best has 0."));
}

TEST(Report, HeadingsOfTablesAreWordsWithAHint) {
  const std::string page = render_report(sample::run(), "a-run");
  EXPECT_THAT(section_of(page, "errors"),
              ContainsRegex("<th scope=\"col\" title=\"Spearman [^\"]*\">rank correlation of T</th>"));
  EXPECT_THAT(section_of(page, "diagnosis"),
              AllOf(ContainsRegex("title=\"[^\"]+\">improvement of fit \\(chi squared\\)</th>"),
                    HasSubstr("<strong>explains it</strong>"), HasSubstr("these tests cannot say")));
}

TEST(Report, WhatTheLaboratoryHadHiddenStandsBesideTheAnswers) {
  run::RunRecord run = sample::run();
  EXPECT_THAT(section_of(render_report(run, "r"), "diagnosis"), Not(HasSubstr("had hidden")));
  wire::Reveal& reveal = run.revealed.emplace();
  EXPECT_THAT(section_of(render_report(run, "r"), "diagnosis"), HasSubstr("noise alone"));
  reveal.causes.push_back({"corner_debonding", "strength lost at corners, 1", false, {0.88}});
  reveal.causes.push_back({"rate_dependence", "overstress", true, {0.5, 8.0}});
  const std::string section = section_of(render_report(run, "r"), "diagnosis");
  EXPECT_THAT(section, AllOf(HasSubstr("corner debonding"), HasSubstr("0.88"), HasSubstr("0.500, 8.00"),
                             HasSubstr("the honest answer is that something is unexplained")));
}

TEST(Report, SoftAndRigidHaveALegend) {
  const std::string page = render_report(sample::run(), "a-run");
  for (const std::string& part : {head_of(page), section_of(page, "proposals")})
    EXPECT_THAT(part, ContainsRegex("class=\"rigid\"[^<]*/></svg> rigid</span>.*class=\"soft\"[^<]*/></svg> soft<"));
}

TEST(Report, RoundZeroHasAGamutAndNoMeasurementsYet) {
  const std::string page = render_report(sample::run(0), "a-run");
  EXPECT_THAT(section_of(page, "gamuts"), Not(HasSubstr("Still awaited")));
  EXPECT_THAT(section_of(page, "curves"), HasSubstr("Still awaited"));
  EXPECT_THAT(page, HasSubstr("no pattern has been measured yet"));
  EXPECT_EQ(fault_of_markup(page), "");
}

TEST(Report, HeadSaysWhereTheGameStands) {
  const std::string page = render_report(sample::run(), "a-run");
  const std::string head = head_of(page);
  EXPECT_THAT(
      head, AllOf(HasSubstr("a-run"), HasSubstr("Round 3"), HasSubstr("0.900 ± 0.030"), HasSubstr("the game is over")));
  EXPECT_THAT(head, AllOf(HasSubstr("Equilibrium is not reached"),
                          ContainsRegex("Why the game ended</strong>: [^.]*0.150 GPa MPa is more than twice the error"),
                          HasSubstr("a cause is named")));
}

TEST(Report, TinyRunSaysThatItsFiguresMeanNothing) {
  run::RunRecord run = sample::run(1);
  EXPECT_THAT(render_report(run, "r"), Not(HasSubstr("mean nothing")));
  for (auto& [number, round] : run.rounds) round.summary->fidelity = tester::Fidelity::tiny;
  const std::string page = render_report(run, "r");
  EXPECT_LT(page.find("nothing.</strong>"), page.find("</header>"));
}

TEST(Report, ASpecimenThatNamesNoOrderHasNoRound) {
  run::RunRecord run = sample::run(1);
  for (run::MeasuredSpecimen& m : run.specimens) m.round = -1;
  EXPECT_THAT(section_of(render_report(run, "r"), "specimens"),
              AllOf(HasSubstr("<td>–</td>"), Not(HasSubstr("not ordered"))));
}

TEST(Report, HostileTextsDoNotBecomeMarkup) {
  const std::string evil = "</style><script>alert(1)</script>\"'><img src=x onerror=alert(1)>&amp;\x01";
  run::RunRecord run = sample::run(1);
  for (auto& [number, round] : run.rounds) {
    round.summary->decided_by = evil;
    wire::Diagnosis& diagnosis = round.diagnosis.emplace();
    diagnosis.verdict = diagnosis.summary = evil;
    wire::DiagnosedEffect& effect = diagnosis.effects.emplace_back();
    effect.name = effect.unit = evil;
    wire::DiagnosedCandidate& candidate = diagnosis.candidates.emplace_back();
    candidate.name = candidate.status = evil;
    round.proposals.push_back({.design = pattern::Mixture{0.65}, .reason = evil});
    round.simulated[evil] =
        round.simulated.begin() == round.simulated.end() ? wire::SimulatedDesign{} : round.simulated.begin()->second;
  }
  for (run::MeasuredSpecimen& m : run.specimens) m.record.note = m.record.batch = evil;
  run.specimens.front().record.specimen = evil;
  const std::string page = render_report(run, evil);
  EXPECT_THAT(page, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<img")), Not(HasSubstr("\x01")),
                          HasSubstr("&lt;script&gt;")));
  EXPECT_EQ(count_of(page, "</style>"), 1);
  EXPECT_EQ(fault_of_markup(page), "");
}

TEST(Report, NoDiagnosisIsAwaitedWhereTheScenarioTurnsItOff) {
  run::RunRecord run = sample::run(1);
  for (auto& [number, round] : run.rounds) round.diagnosis.reset();
  EXPECT_THAT(head_of(render_report(run, "r")), HasSubstr("no diagnosis yet"));
  run.is_diagnosed = false;
  const std::string page = render_report(run, "r");
  EXPECT_THAT(head_of(page), AllOf(Not(HasSubstr("no diagnosis yet")), HasSubstr("turns the diagnosis off")));
  EXPECT_THAT(section_of(page, "diagnosis"), Not(HasSubstr("Still awaited")));
}

TEST(Report, PageReachesForNothingOutsideItself) {
  const std::string page = render_report(sample::run(), "a-run");
  for (const char* reach : {"http:", "https:", "src=", "url(", "@import", "<script", "<link", "javascript:"}) {
    EXPECT_THAT(page, Not(HasSubstr(reach)));
  }
}

TEST(Report, SameRecordGivesTheSamePage) {
  EXPECT_EQ(render_report(sample::run(), "r"), render_report(sample::run(), "r"));
}

TEST(Report, ErrorsStandBesideTheThesisFigures) {
  const std::string errors = section_of(render_report(sample::run(), "r"), "errors");
  for (const char* own : {"<td>14</td>", "<strong>9.1 %</strong>", "<strong>53.0 %</strong>", "<td>0.40</td>"})
    EXPECT_THAT(errors, HasSubstr(own));
  for (const char* thesis : {"12.2 %", "9.1 %", "6.9 %", "97.0 %", "84.0 %", "76.0 %", "27.1 %", "7.1 %", "31.0 %"}) {
    EXPECT_THAT(errors, HasSubstr(thesis));
  }
}

// Errors of logarithms, printed raw, are other numbers than the summary's.
TEST(Report, GainOfADiagnosisIsSaidByItsSummaryAlone) {
  const std::string diagnosis = section_of(render_report(sample::run(), "r"), "diagnosis");
  EXPECT_THAT(diagnosis, AllOf(Not(HasSubstr("8.3 %")), Not(HasSubstr("3.4 %"))));
}

TEST(Report, AMisfitOfTheCalibrationStandsBesideAVerdictThatFindsNothing) {
  run::RunRecord run = sample::run();
  run::RoundRecord& newest = run.rounds.rbegin()->second;
  newest.diagnosis->verdict = "base_sufficient";
  EXPECT_THAT(render_report(run, "r"), Not(HasSubstr("own fit does not explain")));
  newest.model->provenance.modulus_fit = {.count = 12, .freedom = 8, .chi_squared = 1223.4, .p_value = 1e-9};
  const std::string page = render_report(run, "r"), head = page.substr(0, page.find("</header>"));
  EXPECT_THAT(head, HasSubstr("does not explain E (chi squared 1223 at 8 degrees of freedom)"));
  EXPECT_THAT(section_of(page, "diagnosis"), HasSubstr("does not explain E"));
}

TEST(Report, InvalidSpecimensAreShownButCountNowhere) {
  run::RunRecord run = sample::run(1);
  measurement::SpecimenRecord& record = run.specimens.front().record;
  ASSERT_TRUE(record.modulus_pa);
  record.modulus_pa = 77.7e9;
  EXPECT_THAT(section_of(render_report(run, "r"), "best") + section_of(render_report(run, "r"), "proposals"),
              HasSubstr(" ± "));
  const std::string misled = section_of(render_report(run, "r"), "best");
  record.valid = false;
  record.note = "slipped in the grip";
  const std::string page = render_report(run, "r");
  EXPECT_THAT(section_of(page, "specimens"), AllOf(HasSubstr("77.7"), HasSubstr("invalid</strong>"),
                                                   HasSubstr("slipped in the grip"), HasSubstr("1 of them invalid")));
  EXPECT_NE(section_of(page, "best"), misled);
}

TEST(Report, ProposalsShowTheirPictureReasonAndMeasurement) {
  run::RunRecord run = sample::run(1);
  run.rounds.at(1).summary->last = false;
  const std::string proposals = section_of(render_report(run, "r"), "proposals");
  EXPECT_EQ(count_of(proposals, "<svg class=\"unit\" viewBox=\"0 0 20 20\""), 8);
  EXPECT_EQ(count_of(proposals, "<td>awaited</td>"), 2 * 4);  // those of round 1 are not measured yet
  EXPECT_EQ(count_of(proposals, "prediction error"), 4);
  EXPECT_EQ(count_of(proposals, "radial bin 2"), 2);
}

TEST(Report, NoMeasurementIsAwaitedAfterTheLastRound) {
  const std::string proposals = section_of(render_report(sample::run(1), "r"), "proposals");
  EXPECT_THAT(proposals, Not(HasSubstr("awaited")));
  EXPECT_EQ(count_of(proposals, "<td>not measured</td>"), 2 * 4);
}

TEST(Report, NewestDesignsComeFirstAmongTheCurves) {
  const std::string curves = section_of(render_report(sample::run(2), "r"), "curves");
  EXPECT_EQ(count_of(curves, "<svg class=\"plot\""), 6 + 4 + 4);
  EXPECT_LT(curves.rfind(", round 2</text>"), curves.find(", round 1</text>"));
  EXPECT_EQ(count_of(curves, ">model of round 2</text>"), 14);
}

TEST(ReportText, NumbersCarrySensibleDigits) {
  EXPECT_EQ(figure(0.07416), "0.0742");
  EXPECT_EQ(figure(1.8104), "1.81");
  EXPECT_EQ(figure(564.4), "564");
  EXPECT_EQ(figure(-0.5), "−0.500");
  EXPECT_EQ(figure(std::nan("")), "–");
  EXPECT_EQ(percent(0.0653), "6.5 %");
  EXPECT_EQ(percent(1.3559), "136 %");
  EXPECT_EQ(with_error(0.9112, 0.0312), "0.911 ± 0.031");
  EXPECT_EQ(with_error(1.5, 0.0), "1.50");
  EXPECT_EQ(quantity(4.2e-11), "4.20 × 10⁻¹¹");
}

}  // namespace
}  // namespace nacre::report
