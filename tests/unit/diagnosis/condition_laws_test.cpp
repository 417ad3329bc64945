#include "diagnosis/condition_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "made_specimens.hpp"
#include "material/rate_laws.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

bool is_on_second(const Made& made) { return made.columns.at("machine") == "B"; }

/// Rigid and soft specimens at two rates on two machines, without a batch.
std::vector<Made> on_two_machines(const std::vector<double>& rigid_shares) {
  std::vector<Made> all;
  for (const double share : rigid_shares)
    for (const double rate : {1e-3, 1e-2})
      for (const char* machine : {"A", "B"}) all.push_back({share, rate, {{"machine", machine}}});
  return all;
}

/// Every third specimen of a condition is of the same batch.
std::vector<measurement::SpecimenRecord> in_batches(std::vector<measurement::SpecimenRecord> specimens) {
  for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].batch = "batch-" + std::to_string(1 + i % 3);
  return specimens;
}

/// E over 2 GPa, of soft material 2 MPa.
double stiffness_of(const Made& made) { return std::pow(1e-3, 1.0 - made.rigid_share); }

double reads_higher(const Made& made) { return stiffness_of(made) * (is_on_second(made) ? 1.2 : 1.0); }

/// A spring of 1e-10 strain per pascal in series with the specimens of one machine.
double with_a_spring(const Made& made, bool has_spring) {
  return has_spring ? 1.0 / (1.0 / stiffness_of(made) + 2e9 * 1e-10) : stiffness_of(made);
}

TEST(ConditionLaws, AMachineThatReadsHigherIsAGain) {
  const Diagnosis diagnosis =
      diagnose(in_batches(specimens_of(on_two_machines({1.0, 0.0}), reads_higher)), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects.front().name, "gain_of_one_machine");
  EXPECT_NEAR(diagnosis.effects.front().parameter, 0.2, 0.03);
  // Twelve specimens on each machine.
  const double width = diagnosis.effects.front().interval_high - diagnosis.effects.front().interval_low;
  EXPECT_NEAR(width / (2.0 * 1.645 * 1.2 * diagnosis.replicate_sd * std::sqrt(2.0 / 12.0)), 1.0, 0.15);
  EXPECT_EQ(diagnosis.candidates.back().name, "gain_of_one_machine");
  EXPECT_EQ(diagnosis.candidates.back().status, CandidateStatus::in_set);
  ASSERT_TRUE(diagnosis.gain);
  EXPECT_LT(diagnosis.gain->held_out_error_after, 0.5 * diagnosis.gain->held_out_error_before);
}

// The sign says on which machine.
TEST(ConditionLaws, ASpringSoftensWhatIsStiff) {
  for (const bool on_second : {true, false}) {
    const auto law = [&](const Made& made) { return with_a_spring(made, is_on_second(made) == on_second); };
    const Diagnosis diagnosis = diagnose(in_batches(specimens_of(on_two_machines({1.0, 0.0}), law)), quick_settings());
    ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
    EXPECT_EQ(diagnosis.effects.front().name, "compliance_of_one_machine");
    EXPECT_NEAR(diagnosis.effects.front().parameter, on_second ? 1e-10 : -1e-10, 2e-11);
  }
}

TEST(ConditionLaws, OneStiffnessCannotPartThem) {
  const Diagnosis diagnosis =
      diagnose(in_batches(specimens_of(on_two_machines({1.0}), reads_higher)), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::factor);
  EXPECT_EQ(diagnosis.cautions.rival_laws.size(), 2u);
  EXPECT_FALSE(diagnosis.cautions.machines_not_compared);
}

// Whoever reads the answer has to know which machine to mend.
TEST(ConditionLaws, TheMachineIsCalledByItsName) {
  const auto law = [&](const Made& made) { return with_a_spring(made, !is_on_second(made)); };
  const Diagnosis diagnosis = diagnose(in_batches(specimens_of(on_two_machines({1.0, 0.0}), law)), quick_settings());
  EXPECT_EQ(diagnosis.machines, (std::vector<std::string>{"A", "B"}));
  EXPECT_NE(diagnosis.summary.find("of the machine \"A\""), std::string::npos) << diagnosis.summary;
  EXPECT_EQ(diagnosis.summary.find("interval 0 "), std::string::npos) << diagnosis.summary;
  EXPECT_TRUE(diagnosis.cautions.out_of_line.empty()) << "how machines differ is explained";
}

// Each machine with specimens of its own: they may differ.
TEST(ConditionLaws, MachinesThatShareNoPrintsAreNotBlamed) {
  const Diagnosis diagnosis = diagnose(specimens_of(on_two_machines({1.0, 0.0}), reads_higher), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.cautions.machines_not_compared);
}

TEST(ConditionLaws, MachinesAreBlamedBesideARateLaw) {
  const auto law = [](const Made& made) { return reads_higher(made) * std::pow(made.rate_per_s / 1e-3, 0.1); };
  std::vector<Made> all = on_two_machines({1.0, 0.0});
  for (const Made& made : on_two_machines({1.0, 0.0}))
    all.push_back({made.rigid_share, 1e2 * made.rate_per_s, made.columns});
  const Diagnosis diagnosis = diagnose(in_batches(specimens_of(all, law)), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 2u);
  EXPECT_EQ(diagnosis.effects.front().name, "rate_power_law");
  EXPECT_EQ(diagnosis.effects.back().name, "gain_of_one_machine");
}

/// Rigid, interface and soft specimens on three machines.
std::vector<Made> on_three_machines() {
  std::vector<Made> all;
  for (const double share : {1.0, 0.5, 0.0})
    for (const char* machine : {"A", "B", "C"}) all.push_back({share, 1e-3, {{"machine", machine}}});
  return all;
}

TEST(ConditionLaws, EachOfThreeMachinesHasItsGain) {
  const auto law = [](const Made& made) {
    const std::string& machine = made.columns.at("machine");
    return stiffness_of(made) * (machine == "B" ? 1.2 : machine == "C" ? 0.85 : 1.0);
  };
  const Diagnosis diagnosis = diagnose(in_batches(specimens_of(on_three_machines(), law)), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  const NamedEffect& gain = diagnosis.effects.front();
  EXPECT_EQ(gain.name, "gain_of_one_machine");
  EXPECT_EQ(gain.each, (std::vector<std::string>{"B", "C"}));
  EXPECT_NEAR(gain.parameter, 0.2, 0.04);
  ASSERT_EQ(gain.further.size(), 1u);
  EXPECT_NEAR(gain.further.front().value, -0.15, 0.04);
  EXPECT_NE(diagnosis.summary.find("of the machine \"C\""), std::string::npos) << diagnosis.summary;
}

// The stiffest machine is the second: the others have springs beyond it.
TEST(ConditionLaws, EachOfThreeMachinesHasItsSpring) {
  const auto law = [](const Made& made) {
    const std::string& machine = made.columns.at("machine");
    const double per_pa = machine == "A" ? 1e-10 : machine == "C" ? 2.5e-10 : 0.0;
    return 1.0 / (1.0 / stiffness_of(made) + 2e9 * per_pa);
  };
  const Diagnosis diagnosis = diagnose(in_batches(specimens_of(on_three_machines(), law)), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  const NamedEffect& spring = diagnosis.effects.front();
  EXPECT_EQ(spring.name, "compliance_of_one_machine");
  EXPECT_NEAR(spring.parameter, -1e-10, 2e-11);
  ASSERT_EQ(spring.further.size(), 1u);
  EXPECT_NEAR(spring.further.front().value, 1.5e-10, 3e-11);
}

// A and B share batches, C has prints of its own.
TEST(ConditionLaws, AThirdMachineThatSharesNoPrintsIsNotBlamed) {
  const auto law = [](const Made& made) { return reads_higher(made); };
  std::vector<measurement::SpecimenRecord> specimens = in_batches(specimens_of(on_three_machines(), law));
  for (measurement::SpecimenRecord& specimen : specimens)
    if (specimen.other_columns.at("machine") == "C") specimen.batch = "of C alone";
  const Diagnosis diagnosis = diagnose(specimens, quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.cautions.machines_not_compared);
}

/// Six layouts and the base materials, every replicate a batch, each on both machines.
std::vector<measurement::SpecimenRecord> layouts_on_two_machines(const material::Extensions& of_second) {
  const material::ParameterSet truth = synthetic_truth();
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({.patterns = 6, .twins = 0}, truth);
  for (measurement::SpecimenRecord& specimen : synthetic_base_materials(truth)) specimens.push_back(specimen);
  const std::size_t count = specimens.size();
  RandomStream noise(5, "test/factors");
  for (std::size_t i = 0; i < count; ++i) {
    specimens[i].batch = "batch-" + std::to_string(1 + i % 3);
    measurement::SpecimenRecord again = specimens[i];
    specimens[i].other_columns["machine"] = "A";
    again.specimen += " again";
    again.other_columns["machine"] = "B";
    again.modulus_pa =
        measurement::observe_modulus(*again.modulus_pa, of_second, {.machine = 1}) * std::exp(0.015 * noise.normal());
    specimens.push_back(again);
  }
  return specimens;
}

// What a machine does to all specimens it does to layouts too.
TEST(ConditionLaws, MachinesAreBlamedAlsoWhereThereAreLayouts) {
  const Diagnosis diagnosis = diagnose(layouts_on_two_machines({{"gain_of_one_machine", {0.2}}}), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects.front().name, "gain_of_one_machine");
  EXPECT_NEAR(diagnosis.effects.front().parameter, 0.2, 0.03);
}

/// Rigid and soft specimens at each of these values.
std::vector<Made> at_values_of(const std::string& column, const std::vector<std::string>& values) {
  std::vector<Made> all;
  for (const double share : {1.0, 0.0})
    for (const std::string& value : values) all.push_back({share, 1e-3, {{column, value}}});
  return all;
}

/// The rigid material takes water up, the soft one hardly.
double moist(const Made& made) {
  const double per_pct = made.rigid_share > 0.5 ? -0.006 : -0.001;
  return stiffness_of(made) * std::exp(per_pct * (std::stod(made.columns.at("humidity_pct")) - 50.0));
}

TEST(ConditionLaws, HumiditySoftensEachMaterialByItsOwnShare) {
  const Diagnosis diagnosis =
      diagnose(specimens_of(at_values_of("humidity_pct", {"10", "30", "50", "70", "90"}), moist), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  const NamedEffect& humidity = diagnosis.effects.front();
  EXPECT_EQ(humidity.name, "humidity_dependence");
  EXPECT_EQ(humidity.each, (std::vector<std::string>{"rigid", "soft"}));
  EXPECT_NEAR(humidity.parameter, -0.006, 0.001);
  EXPECT_NEAR(humidity.further.front().value, -0.001, 0.001);
}

// Two values tell that it acts, and no law. A step is none.
TEST(ConditionLaws, HumidityWithoutALawKeepsItsLevels) {
  const Diagnosis two = diagnose(specimens_of(at_values_of("humidity_pct", {"20", "80"}), moist), quick_settings());
  EXPECT_EQ(to_string(two.verdict), "unexplained") << two.summary;
  EXPECT_EQ(two.finding.reason, Reason::factor);
  const auto step = [](const Made& made) {
    return stiffness_of(made) * (std::stod(made.columns.at("humidity_pct")) < 40.0 ? 1.0 : 0.7);
  };
  const Diagnosis diagnosis =
      diagnose(specimens_of(at_values_of("humidity_pct", {"10", "30", "50", "70", "90"}), step), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
}

double aged(const Made& made) {
  return stiffness_of(made) * std::pow(1.0 + std::stod(made.columns.at("age_days")), 0.04);
}

TEST(ConditionLaws, AMaterialStiffensWithItsAge) {
  const Diagnosis diagnosis =
      diagnose(specimens_of(at_values_of("age_days", {"1", "3", "10", "30", "100"}), aged), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().name, "ageing");
  EXPECT_NEAR(diagnosis.effects.front().parameter, 0.04, 0.01);
}

// Old specimens on one machine, new ones on another.
TEST(ConditionLaws, AnAgeThatGoesWithTheMachineGetsNoName) {
  std::vector<Made> all;
  for (const auto& [age_days, machine] : {std::pair{"1", "A"}, {"10", "B"}, {"100", "C"}})
    for (const double share : {1.0, 0.0}) all.push_back({share, 1e-3, {{"age_days", age_days}, {"machine", machine}}});
  const Diagnosis diagnosis = diagnose(in_batches(specimens_of(all, aged)), quick_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.cautions.alike, std::vector<std::string>{"machine"});
  ASSERT_FALSE(diagnosis.next_experiments.empty()) << "one of both would part them";
}

const material::Phases kPhases = material::phases_of(material::default_parameters().modulus);

// Two relaxation times a thousand times apart: no power, and no one branch.
TEST(ConditionLaws, TwoRelaxationTimesAreASeries) {
  std::vector<Made> all;
  for (double rate = 1e-6; rate < 2.0; rate *= 10.0) all.push_back({1.0, rate});
  const material::Extensions series = {{"rate_prony", {0.8, 0.05, 0.6, 1000.0}}};
  const auto law = [&](const Made& made) {
    return material::phases_at_rate(kPhases, series, made.rate_per_s).rigid.young_pa / kPhases.rigid.young_pa;
  };
  const Diagnosis diagnosis = diagnose(specimens_of(all, law), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  const NamedEffect& found = diagnosis.effects.front();
  EXPECT_EQ(found.name, "rate_prony");
  EXPECT_NEAR(found.parameter, 0.8, 0.25);
  ASSERT_EQ(found.further.size(), 3u);
  EXPECT_NEAR(std::log10(found.further[0].value), std::log10(0.05), 0.5);
  EXPECT_NEAR(std::log10(found.further[2].value), 3.0, 0.7);
}

/// A power of the rate that temperature shifts by the universal constants of Williams, Landel and Ferry.
double warm_is_slow(const Made& made) {
  const double above = std::stod(made.columns.at("temperature_c")) - 23.0;
  return std::pow(made.rate_per_s * std::pow(10.0, -8.86 * above / (101.6 + above)), 0.1);
}

TEST(ConditionLaws, TemperatureShiftsTheRate) {
  std::vector<Made> all;
  for (const char* temperature_c : {"-10", "10", "30", "60", "90"})
    for (const double rate : {1e-3, 1e-2, 1e-1}) all.push_back({1.0, rate, {{"temperature_c", temperature_c}}});
  const Diagnosis diagnosis = diagnose(specimens_of(all, warm_is_slow), quick_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 2u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().name, "rate_power_law");
  EXPECT_NEAR(diagnosis.effects.front().derived.back().value, 0.1, 0.02);
  const NamedEffect& shift = diagnosis.effects.back();
  EXPECT_EQ(shift.name, "temperature_shift");
  EXPECT_NEAR(shift.parameter, 8.86 / 101.6, 0.02);
  ASSERT_EQ(shift.further.size(), 1u);
  EXPECT_LT(shift.further.front().interval_low, 101.6);
  EXPECT_GT(shift.further.front().interval_high, 101.6);
  ASSERT_TRUE(diagnosis.gain);
  EXPECT_LT(diagnosis.gain->held_out_error_after, 0.2 * diagnosis.gain->held_out_error_before);
}

}  // namespace
}  // namespace nacre::diagnosis
