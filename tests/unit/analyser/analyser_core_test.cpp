#include "analyser/analyser_core.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../diagnosis/synthetic_set.hpp"
#include "analyser/diagnosis_work.hpp"
#include "analyser/works.hpp"
#include "diagnosis/possible_tests.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"

namespace nacre::analyser {
namespace {

using runtime::Message;
using runtime::Outputs;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

/// A core with all that it has asked for.
struct Watched {
  AnalyserCore core{game::Scenario{}, material::thesis_ranges(), "[preview]\nlog_modulus_sd = 0.006\n"};
  std::vector<runtime::Compute> computes;
  std::vector<Message> messages;
  std::vector<runtime::LogLine> log;

  void take(Outputs outputs) {
    for (auto& each : outputs.computes) computes.push_back(std::move(each));
    for (auto& each : outputs.messages) messages.push_back(std::move(each));
    for (auto& each : outputs.log) log.push_back(std::move(each));
  }
  void receive(const std::string& channel, const std::string& payload) { take(core.step(Message{channel, payload})); }
  void finish(const std::string& id, const std::string& result = "kept") {
    take(core.step(runtime::WorkDone{id, result}));
  }
  std::vector<std::string> ids(const std::string& kind) const {
    std::vector<std::string> found;
    for (const auto& each : computes) {
      if (each.kind == kind) found.push_back(each.id);
    }
    return found;
  }
  void finish_stores() {
    for (const std::string& id : ids("store")) finish(id);
  }
  std::vector<Message> sent_on(const std::string& channel) const {
    std::vector<Message> found;
    for (const Message& each : messages) {
      if (each.channel == channel) found.push_back(each);
    }
    return found;
  }
};

std::string measurement_of(const std::string& specimen, std::uint64_t bits, int round = 1, double modulus_pa = 1e9,
                           int revision = 0) {
  wire::Measurement m;
  m.revision = revision;
  m.by = m.why = revision > 0 ? "Ada" : "";
  m.fidelity = game::Scenario{}.fidelity;
  m.round = round;
  m.record.specimen = specimen;
  m.record.design = pattern::Pattern(bits);
  m.record.test = tester::TestKind::modulus;
  m.record.modulus_pa = modulus_pa;
  return wire::write(m);
}

/// A coupon of linear material, pulled to 0.1 % strain.
std::string coupon_of(const std::string& specimen, const char* material, double modulus_pa) {
  wire::Measurement m;
  m.fidelity = game::Scenario{}.fidelity;
  m.round = 1;
  m.record.specimen = specimen;
  m.record.design = *pattern::design_from_name(material);
  m.record.test = tester::TestKind::tensile;
  for (int i = 0; i <= 10; ++i) {
    m.record.curve.strain.push_back(1e-4 * i);
    m.record.curve.stress_pa.push_back(1e-4 * i * modulus_pa);
  }
  return wire::write(m);
}

/// Of specimens in the revision that is meant.
std::string request_of_revisions(std::vector<wire::NamedSpecimen> specimens) {
  wire::DiagnoseRequest request;
  request.round = 1;
  request.fidelity = game::Scenario{}.fidelity;
  request.parameters = material::default_parameters();
  request.specimens = std::move(specimens);
  return wire::write(request);
}

/// Of specimens that were never amended.
std::string request_of(const std::vector<std::string>& names) {
  std::vector<wire::NamedSpecimen> specimens;
  for (const std::string& name : names) specimens.push_back({name, 0});
  return request_of_revisions(std::move(specimens));
}

std::string model_of(int round, double factor = 1.0) {
  wire::AdoptedModel model;
  model.round = round;
  model.parameters = material::default_parameters();
  model.parameters.toughness.w_vw_j_per_m3 *= factor;
  return wire::write(model);
}

std::string round_of(int number, bool last) {
  wire::RoundSummary round;
  round.round = number;
  round.last = last;
  return wire::write(round);
}

/// Of a fracture test: pulled to 3 % strain, where it parts.
tester::Curve fracture_curve(double toughness_pa) {
  tester::Curve curve;
  for (int i = 0; i <= 10; ++i) {
    curve.strain.push_back(3e-3 * i);
    curve.stress_pa.push_back(2.0 * toughness_pa / 0.03 * i / 10.0);
  }
  curve.strain.push_back(0.0301);
  curve.stress_pa.push_back(0.0);
  return curve;
}

std::string fracture_of(const std::string& specimen, std::uint64_t bits, double toughness_pa) {
  wire::Measurement m = wire::read<wire::Measurement>(measurement_of(specimen, bits)).value();
  m.fidelity = tester::Fidelity::tiny;
  m.record.test = tester::TestKind::toughness;
  m.record.modulus_pa.reset();
  m.record.toughness_pa = toughness_pa;
  m.record.curve = fracture_curve(toughness_pa);
  return wire::write(m);
}

/// The farm's response to all that a request asks for.
std::vector<std::string> responses_to(const Message& request, const std::string& failure = "") {
  const auto asked = wire::read<wire::SimulateRequest>(request.payload).value();
  std::vector<wire::SimulatedDesign> results;
  for (const pattern::Design& design : asked.designs)
    results.push_back({.design = design,
                       .failure = failure,
                       .modulus_pa = 1e9,
                       .toughness_pa = 1e5,
                       .peak_stress_pa = 1e7,
                       .failure_strain = 0.03,
                       .curve = asked.toughness ? fracture_curve(1e5) : tester::Curve{}});
  std::vector<std::string> payloads;
  for (const auto& part : wire::simulate_response(asked.request_id, results)) payloads.push_back(wire::write(part));
  return payloads;
}

std::string proposal_of(int round, std::vector<std::uint64_t> patterns) {
  wire::Proposal proposal;
  proposal.round = round;
  for (const std::uint64_t bits : patterns)
    proposal.designs.push_back(
        {.design = pattern::Pattern(bits), .modulus_pa = 1e9, .toughness_pa = 1e5, .bin = 0, .reason = "bin"});
  return wire::write(proposal);
}

TEST(Analyser, ProposedDesignsAreFilmedWithTheModelOfTheirRound) {
  Watched analyser;
  analyser.receive("PROPOSAL", proposal_of(1, {5, 6}));
  EXPECT_THAT(analyser.sent_on("SIMULATE"), IsEmpty()) << "the model is still on its way";
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  ASSERT_THAT(analyser.sent_on("SIMULATE"), SizeIs(1));
  const Message request = analyser.sent_on("SIMULATE").front();
  const auto asked = wire::read<wire::SimulateRequest>(request.payload).value();
  EXPECT_TRUE(asked.film && asked.crack && asked.toughness && !asked.modulus);
  EXPECT_THAT(asked.designs, ElementsAre(pattern::Pattern(5), pattern::Pattern(6)));
  analyser.receive("PROPOSAL", proposal_of(1, {5, 6}));
  analyser.receive("ROUND", round_of(1, false));
  EXPECT_THAT(analyser.sent_on("SIMULATE"), SizeIs(1)) << "once";

  for (const std::string& response : responses_to(request)) analyser.receive("SIMULATED", response);
  for (const int index : {1, 0}) {
    analyser.finish_stores();
    EXPECT_THAT(analyser.ids("report"), IsEmpty()) << "how a design breaks has not come";
    wire::Fracture fracture{.request_id = asked.request_id,
                            .design_index = index,
                            .design = asked.designs[index],
                            .crack = {},
                            .broken = 0,
                            .film = "a.film"};
    fracture.crack.columns = fracture.crack.rows = 40;
    fracture.film = "a.film";
    analyser.receive("FRACTURE", wire::write(fracture));
  }
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), SizeIs(1));
}

TEST(Analyser, DesignsOfAFamilyAreFilmedOnceWithTheFamilysOwnModel) {
  Watched analyser;
  wire::CalibratedFamily family;
  family.number = 2;
  family.count = 3;
  family.name = "family-3";
  family.parameters = material::default_parameters();
  family.parameters.toughness.w_vw_j_per_m3 *= 1.5;
  family.designs = {
      {.pattern = pattern::Pattern(5), .is_seed = true, .measured = {}, .global_model = {}, .family_model = {}},
      {.pattern = pattern::Pattern(6), .is_seed = false, .measured = {}, .global_model = {}, .family_model = {}}};
  analyser.receive("FAMILY", wire::write(family));
  family.is_validated = true;
  analyser.receive("FAMILY", wire::write(family));
  ASSERT_THAT(analyser.sent_on("SIMULATE"), SizeIs(1));
  const auto asked = wire::read<wire::SimulateRequest>(analyser.sent_on("SIMULATE").front().payload).value();
  EXPECT_THAT(asked.request_id, StartsWith("analyser/family2/films#"));
  EXPECT_TRUE(asked.film && asked.crack && asked.toughness && !asked.modulus);
  EXPECT_EQ(asked.parameters, family.parameters);
  EXPECT_THAT(asked.designs, ElementsAre(pattern::Pattern(5), pattern::Pattern(6)));
}

TEST(Analyser, MoreDesignsThanARequestHoldsAreFilmedByTwo) {
  Watched analyser;
  std::vector<std::uint64_t> patterns(wire::kMaximumDesigns + 2);
  for (std::size_t i = 0; i < patterns.size(); ++i) patterns[i] = i + 1;
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  analyser.receive("PROPOSAL", proposal_of(1, patterns));
  const std::vector<Message> requests = analyser.sent_on("SIMULATE");
  ASSERT_THAT(requests, SizeIs(2));
  for (const Message& request : requests)
    EXPECT_TRUE(wire::find_channel("SIMULATE")->validate(request.payload)) << "every receiver would drop it";
  const auto first = wire::read<wire::SimulateRequest>(requests[0].payload).value();
  const auto second = wire::read<wire::SimulateRequest>(requests[1].payload).value();
  EXPECT_NE(first.request_id, second.request_id);
  EXPECT_EQ(first.designs.front(), pattern::Design(pattern::Pattern(1)));
  EXPECT_THAT(second.designs,
              ElementsAre(pattern::Pattern(wire::kMaximumDesigns + 1), pattern::Pattern(wire::kMaximumDesigns + 2)));
}

TEST(Analyser, TinySpecimensAreNotFilmed) {
  game::Scenario scenario;
  scenario.fidelity = tester::Fidelity::tiny;
  AnalyserCore core(scenario, material::thesis_ranges(), "");
  (void)core.step(Message{"PARAMETERS", model_of(1)});
  EXPECT_THAT(core.step(Message{"PROPOSAL", proposal_of(1, {5, 6})}).messages, IsEmpty());
}

TEST(Analyser, DiagnosisWaitsForEveryMeasurementMeant) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  analyser.receive("DIAGNOSE", request_of({"a", "b"}));
  EXPECT_THAT(analyser.ids("diagnose"), IsEmpty());
  analyser.receive("MEASUREMENT", measurement_of("c", 6));
  EXPECT_THAT(analyser.ids("diagnose"), IsEmpty());
  EXPECT_EQ(analyser.core.status().phase, "waiting for measurements of 1 of 2 specimens: b");
  analyser.receive("MEASUREMENT", measurement_of("b", 7));
  EXPECT_THAT(analyser.ids("diagnose"), ElementsAre("diagnose/r1"));
  EXPECT_EQ(analyser.core.status().phase, "diagnosing");
  EXPECT_EQ(analyser.core.status().round, 1);
}

TEST(Analyser, ADiagnosisRestsOnTheRevisionThatWasMeant) {
  const auto diagnosed = [](const std::vector<wire::NamedSpecimen>& meant) {
    Watched analyser;
    analyser.receive("MEASUREMENT", measurement_of("a", 5));
    analyser.receive("DIAGNOSE", request_of_revisions(meant));
    analyser.receive("MEASUREMENT", measurement_of("a", 5, 1, 2e9, 1));
    for (const auto& compute : analyser.computes)
      if (compute.kind == "diagnose") return compute.spec;
    return std::string();
  };
  const std::string before = diagnosed({{"a", 0}}), after = diagnosed({{"a", 1}});
  const std::string old_report = measurement_of("a", 5), amended = measurement_of("a", 5, 1, 2e9, 1);
  EXPECT_THAT(before, AllOf(HasSubstr(old_report), Not(HasSubstr(amended)))) << "the amendment came later";
  EXPECT_THAT(after, AllOf(HasSubstr(amended), Not(HasSubstr(old_report)))) << "it was waited for";
}

TEST(Analyser, NamesAFewOfTheSpecimensThatItWaitsFor) {
  Watched analyser;
  analyser.receive("DIAGNOSE", request_of({"a", "b", "c", "d", "e"}));
  EXPECT_EQ(analyser.core.status().phase, "waiting for measurements of 5 of 5 specimens: a, b, c, ...");
}

TEST(Analyser, OrderOfArrivalDoesNotChangeTheDiagnosis) {
  wire::Review review;
  review.specimen = "b";
  review.revision = 1;
  std::vector<Message> messages = {{"MEASUREMENT", measurement_of("a", 5)},
                                   {"MEASUREMENT", measurement_of("b", 6)},
                                   {"MEASUREMENT", measurement_of("c", 7)},
                                   {"DIAGNOSE", request_of({"a", "b", "c"})},
                                   {"REVIEW", wire::write(review)}};
  std::set<std::string> specs;
  std::mt19937 shuffling(1);
  for (int order = 0; order < 20; ++order) {
    std::shuffle(messages.begin(), messages.end(), shuffling);
    Watched analyser;
    for (const Message& message : messages) analyser.receive(message.channel, message.payload);
    ASSERT_THAT(analyser.ids("diagnose"), SizeIs(1));
    for (const auto& compute : analyser.computes) {
      if (compute.kind == "diagnose") specs.insert(compute.spec);
    }
  }
  EXPECT_THAT(specs, SizeIs(1));
}

/// For a game of fracture tests, whose diagnoses have this budget.
game::Scenario with_simulations(int simulations) {
  game::Scenario scenario;
  scenario.fidelity = tester::Fidelity::tiny;
  scenario.diagnosis.simulations = simulations;
  return scenario;
}

/// Fracture tests of three designs, and the request to diagnose them after a calibration of nine evaluations.
std::vector<Message> fractures_to_diagnose() {
  std::vector<Message> messages;
  wire::DiagnoseRequest request;
  request.round = 1;
  request.fidelity = tester::Fidelity::tiny;
  request.parameters = material::default_parameters();
  for (int k = 0; k < 9; ++k) {
    request.evaluated.push_back({request.parameters, tester::kFirstCalibrationSpecimen + k});
    request.evaluated.back().parameters.toughness.w_vw_j_per_m3 *= 1.0 + 0.1 * k;
  }
  for (const std::uint64_t bits : {5U, 6U, 7U})
    for (const char* replicate : {"/1", "/2"}) {
      request.specimens.push_back({std::to_string(bits) + replicate, 0});
      messages.push_back({"MEASUREMENT", fracture_of(request.specimens.back().name, bits, 1e5 * (1.0 + 0.01 * bits))});
    }
  messages.push_back({"DIAGNOSE", wire::write(request)});
  return messages;
}

/// Plans and responses in turn until the diagnosis is asked for; its spec.
std::string spec_of_diagnosis(int simulations, bool in_order = true, const std::string& failure = "") {
  Watched analyser{.core = AnalyserCore(with_simulations(simulations), material::thesis_ranges(), "")};
  for (const Message& message : fractures_to_diagnose()) analyser.receive(message.channel, message.payload);
  std::size_t answered = 0;
  while (analyser.computes.back().kind == "plan") {
    const runtime::Compute plan = analyser.computes.back();
    analyser.finish(plan.id, plan_work(plan.spec));
    std::vector<Message> requests = analyser.sent_on("SIMULATE");
    requests.erase(requests.begin(), requests.begin() + static_cast<std::ptrdiff_t>(answered));
    answered += requests.size();
    if (!in_order) std::reverse(requests.begin(), requests.end());
    for (const Message& request : requests) {
      EXPECT_TRUE(wire::find_channel("SIMULATE")->validate(request.payload)) << "every receiver would drop it";
      EXPECT_EQ(analyser.core.status().phase, "waiting for fracture tests to diagnose with");
      for (const std::string& response : responses_to(request, failure))
        for (int twice = 0; twice < 2; ++twice) analyser.receive("SIMULATED", response);
    }
  }
  EXPECT_THAT(analyser.ids("diagnose"), ElementsAre("diagnose/r1"));
  return analyser.computes.back().spec;
}

TEST(Analyser, FractureTestsAreDiagnosedWithWhatTheFarmSimulates) {
  std::set<std::string> specs;
  for (const bool in_order : {true, false}) specs.insert(spec_of_diagnosis(16 * 3, in_order));
  ASSERT_THAT(specs, SizeIs(1)) << "whatever comes first";
  const auto diagnosis = wire::read<wire::Diagnosis>(diagnose_work(*specs.begin())).value();
  const auto weighed = [&](const char* name) {
    const auto found = std::ranges::find(diagnosis.candidates, name, &wire::DiagnosedCandidate::name);
    return found != diagnosis.candidates.end() && found->status != "not_applicable";
  };
  EXPECT_TRUE(weighed("toe_slack")) << "acts on nothing else: " << diagnosis.summary;
}

TEST(Analyser, SimulationsThatAllFailEndNoGame) {
  const std::string spec = spec_of_diagnosis(16 * 3, true, "J <= 0");
  EXPECT_FALSE(wire::read<wire::Diagnosis>(diagnose_work(spec)).value().summary.empty());
}

TEST(Analyser, SaysWhatItsSimulationsDoNotPay) {
  const auto summary_with = [](int simulations) {
    return wire::read<wire::Diagnosis>(diagnose_work(spec_of_diagnosis(simulations))).value().summary;
  };
  for (const int too_few : {0, 3})
    EXPECT_THAT(summary_with(too_few), AllOf(HasSubstr("no valid specimen"), HasSubstr("Fracture tests are left out")));
  EXPECT_THAT(summary_with(8 * 3), HasSubstr("diagnosis.simulations of 24 does not pay for it"));
}

TEST(Analyser, DiagnosisIsPublishedAndKept) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", (std::uint64_t{1} << 55) - 1, 1, 2.6e9));  // all rigid
  analyser.receive("DIAGNOSE", request_of({"a"}));
  const auto compute = std::find_if(analyser.computes.begin(), analyser.computes.end(),
                                    [](const auto& c) { return c.kind == "diagnose"; });
  ASSERT_NE(compute, analyser.computes.end());
  const std::string result = diagnose_work(compute->spec);  // one specimen tells nothing: said, not thrown
  analyser.finish("diagnose/r1", result);
  ASSERT_THAT(analyser.sent_on("DIAGNOSIS"), SizeIs(1));
  const auto diagnosis = wire::read<wire::Diagnosis>(analyser.sent_on("DIAGNOSIS").front().payload).value();
  EXPECT_EQ(diagnosis.verdict, "insufficient");
  EXPECT_EQ(diagnosis.round, 1);
  EXPECT_EQ(analyser.computes.back().spec, store_spec("DIAGNOSIS", result));
}

// A diagnosis orders coupons where they would discriminate; their measurements must be used.
TEST(Analyser, CouponsTakePartInADiagnosis) {
  Watched analyser;
  std::vector<std::string> names;
  for (const auto& [material, modulus_pa] : {std::pair{"rigid", 2.6e9}, {"interface", 5.6e8}, {"soft", 1e6}})
    for (const char* replicate : {"/1", "/2"}) {
      names.push_back(std::string(material) + replicate);
      analyser.receive("MEASUREMENT", coupon_of(names.back(), material, modulus_pa));
    }
  names.push_back("mix/1");
  analyser.receive("MEASUREMENT", coupon_of(names.back(), "mix:0.75", 1.2e9));
  std::sort(names.begin(), names.end());
  analyser.receive("DIAGNOSE", request_of(names));
  const auto compute = std::find_if(analyser.computes.begin(), analyser.computes.end(),
                                    [](const auto& c) { return c.kind == "diagnose"; });
  ASSERT_NE(compute, analyser.computes.end());
  const auto diagnosis = wire::read<wire::Diagnosis>(diagnose_work(compute->spec)).value();
  EXPECT_THAT(diagnosis.summary, Not(HasSubstr("cannot tell yet"))) << "four materials with a curve are enough";
  EXPECT_FALSE(diagnosis.candidates.empty());
}

// What relaxes has a time in addition to its size, and neither is known exactly.
TEST(Analyser, EveryNumberOfANamedEffectIsSentWithItsInterval) {
  DiagnosisTask task;
  task.request.round = 1;
  task.request.fidelity = tester::Fidelity::tiny;
  task.request.parameters = material::default_parameters();
  task.bootstraps = 1000;
  material::ParameterSet truth = task.request.parameters;
  truth.extensions["rate_dependence"] = {0.5, 12.0};
  for (const auto& record :
       diagnosis::synthetic_coupons(truth, {1e-3, 1e-2, 1e-1}, 3, 0.01, 5, diagnosis::unload_history())) {
    task.request.specimens.push_back({record.specimen, 0});
    task.measurements.push_back(wire::write(
        wire::Measurement{.round = 1, .order_id = "", .fidelity = tester::Fidelity::tiny, .record = record}));
  }
  std::ranges::sort(task.request.specimens, {}, &wire::NamedSpecimen::name);
  const auto sent = wire::read<wire::Diagnosis>(diagnose_work(diagnosis_spec(task))).value();
  ASSERT_EQ(sent.effects.size(), 2U) << sent.summary;
  const wire::DiagnosedEffect& time_s = sent.effects[1];
  EXPECT_EQ(time_s.unit, "s");
  EXPECT_LT(time_s.interval_low, std::min(time_s.parameter, 12.0));
  EXPECT_GT(time_s.interval_high, std::max(time_s.parameter, 12.0));
}

TEST(Analyser, ASpecimenOfAnotherFidelityIsRefusedAndNotKept) {
  Watched analyser;
  auto measured = wire::read<wire::Measurement>(measurement_of("a", 5)).value();
  measured.fidelity = tester::Fidelity::tiny;
  Outputs outputs = analyser.core.step(Message{"MEASUREMENT", wire::write(measured)});
  EXPECT_THAT(outputs.refusal, HasSubstr("measured at fidelity tiny"));
  analyser.take(std::move(outputs));
  EXPECT_THAT(analyser.ids("store"), IsEmpty());
}

TEST(Analyser, ARepeatedRequestIsDiagnosedOnce) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  for (int i = 0; i < 3; ++i) analyser.receive("DIAGNOSE", request_of({"a"}));
  EXPECT_THAT(analyser.ids("diagnose"), SizeIs(1));
}

TEST(Analyser, SameMessageTwiceIsStoredOnce) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  analyser.finish_stores();
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  EXPECT_THAT(analyser.ids("store"), SizeIs(1));
  analyser.receive("MEASUREMENT", measurement_of("b", 5));
  EXPECT_THAT(analyser.ids("store"), SizeIs(2));
}

TEST(Analyser, CorruptMessagesAreAWarningAndChangeNothing) {
  Watched analyser;
  analyser.receive("MEASUREMENT", "not a message");
  analyser.receive("ROUND", round_of(0, true).substr(3));
  analyser.receive("NO_SUCH_CHANNEL", "x");
  EXPECT_THAT(analyser.computes, IsEmpty());
  EXPECT_THAT(analyser.messages, IsEmpty());
  EXPECT_THAT(analyser.log, SizeIs(2));
}

TEST(Analyser, ReportWaitsForStoresAndTheModelsWordOnMeasuredDesigns) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  analyser.receive("MEASUREMENT", measurement_of("b", 5));
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  analyser.receive("ROUND", round_of(1, false));
  const auto requests = analyser.sent_on("SIMULATE");
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_THAT(wire::read<wire::SimulateRequest>(requests.front().payload)->designs, SizeIs(1));
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), IsEmpty()) << "the farm has not responded";
  for (const std::string& response : responses_to(requests.front())) analyser.receive("SIMULATED", response);
  EXPECT_THAT(analyser.ids("report"), IsEmpty()) << "the response is not stored";
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), ElementsAre(StartsWith("report/r1")));
}

// Its journal lost, it comes to another model of the same round, and the farm still repeats what it said of the first.
TEST(Analyser, ResponsesAboutAnotherModelOfTheRoundAreNotTaken) {
  Watched before, now;
  for (Watched* each : {&before, &now}) {
    each->receive("MEASUREMENT", measurement_of("a", 5));
    each->receive("PROPOSAL", proposal_of(1, {6}));
    each->receive("PARAMETERS", model_of(0, 2.0));
    each->receive("PARAMETERS", model_of(1, each == &now ? 1.5 : 1.0));
    each->receive("ROUND", round_of(1, false));
    ASSERT_THAT(each->sent_on("SIMULATE"), SizeIs(2)) << "films, and the word on the measured design";
  }
  const auto receive_all_responses = [&](const std::vector<Message>& requests) {
    for (const Message& request : requests) {
      for (const std::string& response : responses_to(request)) now.receive("SIMULATED", response);
      const auto asked = wire::read<wire::SimulateRequest>(request.payload).value();
      wire::Fracture fracture;
      fracture.request_id = asked.request_id;
      fracture.design = asked.designs.front();
      fracture.crack.columns = fracture.crack.rows = 40;
      if (asked.film) now.receive("FRACTURE", wire::write(fracture));
    }
    now.finish_stores();
  };
  receive_all_responses(before.sent_on("SIMULATE"));
  EXPECT_THAT(now.ids("report"), IsEmpty()) << "nothing that it requested has come";
  receive_all_responses(now.sent_on("SIMULATE"));
  EXPECT_THAT(now.ids("report"), SizeIs(1));
}

TEST(Analyser, ChunksOfAResponseCountOnceEach) {
  Watched analyser;
  for (std::uint64_t bits = 1; bits <= 60; ++bits)
    analyser.receive("MEASUREMENT", measurement_of(std::to_string(bits), bits));
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  analyser.receive("ROUND", round_of(1, false));
  const auto asked = wire::read<wire::SimulateRequest>(analyser.sent_on("SIMULATE").front().payload).value();
  wire::SimulateResult part{.request_id = asked.request_id, .chunk = 0, .chunks = 2, .first = 0, .results = {}};
  part.results = {{.design = asked.designs.at(0),
                   .failure = "J <= 0",
                   .modulus_pa = 0.0,
                   .toughness_pa = 0.0,
                   .peak_stress_pa = 0.0,
                   .failure_strain = 0.0,
                   .curve = {}}};
  for (int i = 0; i < 3; ++i) analyser.receive("SIMULATED", wire::write(part));
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), IsEmpty());
  part.chunk = 1;
  part.first = 30;
  analyser.receive("SIMULATED", wire::write(part));
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), SizeIs(1));
}

TEST(Analyser, RoundBeforeItsModelWaitsForTheModel) {
  Watched analyser;
  analyser.receive("MEASUREMENT", measurement_of("a", 5));
  analyser.receive("ROUND", round_of(1, false));
  analyser.finish_stores();
  EXPECT_THAT(analyser.ids("report"), IsEmpty());
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  EXPECT_THAT(analyser.sent_on("SIMULATE"), SizeIs(1));
}

/// What is asked of the models of rounds, whatever comes first: "analyser/r1", key of the pattern.
void expect_asked(const std::vector<Message>& models, const std::set<std::pair<std::string, std::string>>& expected) {
  std::vector<Message> messages = {{"MEASUREMENT", measurement_of("a", 5, 1)},
                                   {"MEASUREMENT", measurement_of("b", 6, 2)},
                                   {"ROUND", round_of(1, false)},
                                   {"ROUND", round_of(2, true)}};
  messages.insert(messages.end(), models.begin(), models.end());
  const auto before = [](const Message& a, const Message& b) {
    return std::tie(a.channel, a.payload) < std::tie(b.channel, b.payload);
  };
  std::sort(messages.begin(), messages.end(), before);
  do {
    Watched analyser;
    analyser.receive("PARAMETERS", model_of(0, 2.0));
    for (const Message& message : messages) analyser.receive(message.channel, message.payload);
    std::multiset<std::pair<std::string, std::string>> asked;
    for (const Message& request : analyser.sent_on("SIMULATE")) {
      const auto of = wire::read<wire::SimulateRequest>(request.payload).value();
      for (const pattern::Design& design : of.designs)
        asked.emplace(of.request_id.substr(0, std::string("analyser/r1").size()), design.name());
    }
    ASSERT_THAT(asked, testing::ElementsAreArray(expected));
  } while (std::next_permutation(messages.begin(), messages.end(), before));
}

TEST(Analyser, WhatItAsksOfAModelDoesNotDependOnTheOrderOfArrival) {
  expect_asked({{"PARAMETERS", model_of(1)}, {"PARAMETERS", model_of(2, 3.0)}},
               {{"analyser/r1", pattern::Pattern(5).key()},
                {"analyser/r2", pattern::Pattern(5).key()},
                {"analyser/r2", pattern::Pattern(6).key()}});
}

TEST(Analyser, AModelThatStaysIsAskedForEachDesignOnce) {
  expect_asked({{"PARAMETERS", model_of(1)}, {"PARAMETERS", model_of(2)}},
               {{"analyser/r1", pattern::Pattern(5).key()}, {"analyser/r2", pattern::Pattern(6).key()}});
}

TEST(Analyser, IsFinishedAfterTheReportOfTheLastRound) {
  Watched analyser;
  analyser.receive("PARAMETERS", model_of(0));
  analyser.receive("ROUND", round_of(0, false));
  analyser.finish_stores();
  analyser.finish(analyser.ids("report").at(0));
  EXPECT_FALSE(analyser.core.status().finished);
  analyser.receive("PARAMETERS", model_of(1));
  analyser.receive("ROUND", round_of(1, true));
  analyser.finish_stores();
  EXPECT_FALSE(analyser.core.status().finished);
  analyser.finish(analyser.ids("report").at(1));
  EXPECT_TRUE(analyser.core.status().finished);
}

TEST(Analyser, AFamilyStageKeepsTheGameOpenUntilItsLastRoundIsSaidOnceMore) {
  Watched analyser;
  analyser.receive("PARAMETERS", model_of(0, 2.0));
  analyser.receive("PARAMETERS", model_of(1));
  analyser.receive("ROUND", round_of(1, false));
  analyser.finish_stores();
  analyser.finish(analyser.ids("report").at(0));
  wire::CalibratedFamily family;
  family.name = "family-1";
  family.parameters = material::default_parameters();
  analyser.receive("FAMILY", wire::write(family));
  analyser.receive("FAMILY_GAMUT", wire::write(wire::FamilyGamut{}));
  EXPECT_THAT(analyser.ids("store"), SizeIs(5)) << "kept like everything else";
  analyser.finish_stores();
  EXPECT_FALSE(analyser.core.status().finished);
  analyser.receive("ROUND", round_of(1, true));
  analyser.receive("ROUND", round_of(1, false));  // an old word that comes late
  analyser.finish_stores();
  analyser.finish(analyser.ids("report").at(1));
  EXPECT_TRUE(analyser.core.status().finished);
}

TEST(Analyser, AScenarioMayNameNoDiscretisationFloor) {
  game::Scenario scenario;
  scenario.discretisation_floor_file = "";
  EXPECT_NO_THROW(make_core(scenario));
  scenario.discretisation_floor_file = "no/such/file.toml";
  EXPECT_THROW(make_core(scenario), InputError);
}

TEST(Analyser, LateMessagesAfterTheLastRoundReachTheReport) {
  Watched analyser;
  analyser.receive("PARAMETERS", model_of(0));
  analyser.receive("ROUND", round_of(0, true));
  analyser.finish_stores();
  analyser.finish(analyser.ids("report").at(0));
  analyser.receive("MEASUREMENT", measurement_of("late", 5));
  analyser.finish_stores();
  ASSERT_THAT(analyser.ids("report"), SizeIs(2));
  EXPECT_NE(analyser.ids("report").at(0), analyser.ids("report").at(1));
  analyser.finish(analyser.ids("report").at(1));
  EXPECT_TRUE(analyser.core.status().finished);
}

TEST(Analyser, RoundAnnouncedTwiceIsReportedOnce) {
  Watched analyser;
  analyser.receive("PARAMETERS", model_of(0));
  for (int i = 0; i < 2; ++i) analyser.receive("ROUND", round_of(0, false));
  analyser.finish_stores();
  analyser.finish(analyser.ids("report").at(0));
  analyser.receive("ROUND", round_of(0, false));
  EXPECT_THAT(analyser.ids("report"), SizeIs(1));
}

}  // namespace
}  // namespace nacre::analyser
