// The diagnosis on data of the tester's own discretisation. (tests/blind does the same against the virtual laboratory.)

#include "diagnosis/diagnose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/result.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/json.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/procedure.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

/// From the built-in parameters, on the specimens of synthetic_set.hpp.
DiagnosisSettings tiny_settings() {
  DiagnosisSettings settings;
  settings.start = material::thesis_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  return settings;
}

/// At size 0 an effect is the base: no fit of one may end with a larger chi squared.
Diagnosis with_levels_checked(Diagnosis diagnosis) {
  for (const CandidateEffect& candidate : diagnosis.candidates) EXPECT_GE(candidate.statistic, -0.02) << candidate.name;
  return diagnosis;
}

Diagnosis diagnose_truth(const material::ParameterSet& truth, std::uint64_t seed = 1) {
  SyntheticSet set;
  set.seed = seed;
  DiagnosisSettings settings = tiny_settings();
  settings.seed = seed;
  return with_levels_checked(diagnose(synthetic_specimens(set, truth), settings));
}

Diagnosis diagnose_effect(const std::string& name, double value) {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions[name] = {value};
  return diagnose_truth(truth);
}

void expect_named(const Diagnosis& diagnosis, const std::string& name, double value, double tolerance) {
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, name);
  EXPECT_NEAR(diagnosis.effects[0].parameter, value, tolerance);
  ASSERT_TRUE(diagnosis.gain);
  EXPECT_LT(diagnosis.gain->held_out_error_after, diagnosis.gain->held_out_error_before);
}

TEST(Diagnosis, DataOfTheBaseModelAreBaseSufficient) {
  const Diagnosis diagnosis = diagnose_truth(synthetic_truth(), 2);
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_FALSE(diagnosis.gain);
  // An effect that is not found is smaller than its smallest visible size.
  for (const CandidateEffect& candidate : diagnosis.candidates) {
    if (candidate.status == CandidateStatus::not_applicable) continue;
    const material::EffectParameter& parameter = material::find_effect(candidate.name)->parameters.front();
    const double typical = material::value_at_strength(parameter, 0.3);
    const bool shows_when_typical =
        candidate.smallest_seen &&
        material::strength_of(parameter, *candidate.smallest_seen) <= material::strength_of(parameter, typical) + 1e-9;
    EXPECT_EQ(candidate.status == CandidateStatus::excluded, shows_when_typical) << candidate.name;
  }
}

TEST(Diagnosis, AnotherInkIsNoMisfitInRangesOfItsOwn) {
  material::ParameterSet truth = synthetic_truth();
  truth.modulus.e_vw_pa = 9e8;  // Table A.2 begins at 2.08 GPa, three-fold widened at 1.4
  truth.modulus.e_if_pa = 2e8;
  const auto specimens = synthetic_specimens({.patterns = 9, .twins = 0}, truth);
  DiagnosisSettings settings = tiny_settings();
  settings.bootstraps = 700;
  const Diagnosis misled = diagnose(specimens, settings);
  EXPECT_EQ(to_string(misled.verdict), "ambiguous") << "the thesis' inks cannot be so soft";
  EXPECT_EQ(misled.finding.reason, Reason::other_material) << misled.summary;
  EXPECT_EQ(misled.untold.size(), 2u) << misled.summary;
  ASSERT_EQ(misled.next_experiments.size(), 2u) << "specimens of either material would tell";
  const std::string hash = procedure_hash(settings);
  settings.ranges.microstructure_modulus[1] = {"e_vw_pa", 7e8, 1.2e9};
  settings.ranges.microstructure_modulus[2] = {"e_if_pa", 1.5e8, 3e8};
  const Diagnosis diagnosis = diagnose(specimens, settings);
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.cautions.at_bounds.empty()) << diagnosis.summary;
  EXPECT_NE(procedure_hash(settings), hash) << "another procedure";
}

/// Layouts of these constants beside homogeneous specimens of those.
Diagnosis diagnose_beside(const material::ParameterSet& layouts, const material::ParameterSet& specimens) {
  std::vector<measurement::SpecimenRecord> all = synthetic_specimens({.patterns = 12, .twins = 3}, layouts);
  const auto homogeneous = synthetic_base_materials(specimens);
  all.insert(all.end(), homogeneous.begin(), homogeneous.end());
  DiagnosisSettings settings = tiny_settings();
  settings.bootstraps = 700;
  settings.check_discretisation = false;
  return with_levels_checked(diagnose(all, settings));
}

// A base that fits only by moving a constant far from what its own specimens show is not sufficient.
TEST(Diagnosis, LayoutsThatWantAnotherConstantThanItsOwnSpecimensMisfit) {
  material::ParameterSet layouts = synthetic_truth();
  layouts.modulus.e_if_pa *= 0.5;
  const Diagnosis diagnosis = diagnose_beside(layouts, synthetic_truth());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  ASSERT_FALSE(diagnosis.contrasts.empty());
  EXPECT_EQ(diagnosis.contrasts.front().view.material, 2) << diagnosis.contrasts.front().name;
  ASSERT_TRUE(diagnosis.base_fit.modulus && diagnosis.base_fit.coupon);
  EXPECT_LT(diagnosis.base_fit.modulus->e_if_pa, 0.8 * diagnosis.base_fit.coupon->e_if_pa);
}

// Voxels differ a little from the bulk (thesis 3.2.4): that is no misfit.
TEST(Diagnosis, ConstantsOfLayoutsMayDifferFromThoseOfTheirSpecimensByAFewPerCent) {
  material::ParameterSet layouts = synthetic_truth();
  layouts.modulus.e_if_pa *= 0.92;
  layouts.modulus.e_vw_pa *= 1.08;
  const Diagnosis diagnosis = diagnose_beside(layouts, synthetic_truth());
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
}

TEST(Diagnosis, AnotherMaterialIsSaidAndNoMisfitWhereItsOwnSpecimensShowIt) {
  material::ParameterSet truth = synthetic_truth();
  truth.modulus.e_tb_pa *= 6.0;
  const Diagnosis diagnosis = diagnose_beside(truth, truth);
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  ASSERT_EQ(diagnosis.cautions.other_materials.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(kConstantMaterials[diagnosis.cautions.other_materials[0].material], "soft");
  ASSERT_TRUE(diagnosis.base_fit.modulus);
  EXPECT_NEAR(diagnosis.base_fit.modulus->e_tb_pa, truth.modulus.e_tb_pa, 0.1 * truth.modulus.e_tb_pa);
}

// Layouts alone cannot tell another material from an effect that the model lacks: its own specimens would.
TEST(Diagnosis, ABaseThatFitsAtTheBoundOfTheInksAsksForSpecimensOfThatMaterial) {
  material::ParameterSet truth = synthetic_truth();
  truth.modulus.e_vw_pa = 1.3e9;  // the bound of the search is 1.387 GPa
  DiagnosisSettings settings = tiny_settings();
  settings.bootstraps = 700;
  const Diagnosis diagnosis = diagnose(synthetic_specimens({.patterns = 12, .twins = 0}, truth), settings);
  EXPECT_EQ(to_string(diagnosis.verdict), "ambiguous") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.possible.empty());
  ASSERT_FALSE(diagnosis.next_experiments.empty()) << diagnosis.summary;
  EXPECT_EQ(diagnosis.next_experiments.front().design, pattern::Design(pattern::Mixture{1.0}));
}

// An effect that explains them only with such a constant may make up for another one.
TEST(Diagnosis, AnEffectIsNotNamedOverConstantsThatNoInkHas) {
  material::ParameterSet truth = synthetic_truth();
  truth.modulus.e_tb_pa = 5.0e5;  // the bound of the search is 0.533 MPa
  truth.extensions = {{"interface_anisotropy", {0.3}}};
  const Diagnosis diagnosis = diagnose(synthetic_specimens({.patterns = 12, .twins = 5}, truth), tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "ambiguous") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::other_material);
  EXPECT_EQ(diagnosis.finding.nearest, std::vector<std::string>{"interface_anisotropy"});
  ASSERT_EQ(diagnosis.untold.size(), 1u) << diagnosis.summary;
  EXPECT_NEAR(diagnosis.untold.front().modulus_pa, 5.0e5, 0.4e5);
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  EXPECT_EQ(diagnosis.next_experiments.front().design, pattern::Design(pattern::Mixture{0.0}));
}

TEST(Diagnosis, InterfaceAnisotropyIsNamedAndTheJsonHasTheFieldsOfTheFormat) {
  const Diagnosis diagnosis = diagnose_effect("interface_anisotropy", 0.25);
  expect_named(diagnosis, "interface_anisotropy", 0.25, 0.08);
  const auto document = nlohmann::json::parse(to_json(diagnosis));
  for (const char* field :
       {"verdict", "effects", "candidates", "contrasts", "gain", "next_experiments", "p_outside_library"})
    EXPECT_TRUE(document.contains(field)) << field;
  EXPECT_EQ(document["candidates"].size(), material::effect_library().size());
  for (const char* field : {"name", "status", "statistic", "p_family_wise", "absorption"})
    EXPECT_TRUE(document["candidates"][0].contains(field)) << field;
}

TEST(Diagnosis, DropletMixingIsNamed) {
  expect_named(diagnose_effect("droplet_mixing", 1.0), "droplet_mixing", 1.0, 0.3);
}

TEST(Diagnosis, MachineComplianceIsNamed) {
  const Diagnosis diagnosis = diagnose_effect("machine_compliance", 2e-10);
  expect_named(diagnosis, "machine_compliance", 2e-10, 0.6e-10);
  // The stiffness of materials without coupons is unknown: a coupon of them does not determine the spring.
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  for (const NextExperiment& next : diagnosis.next_experiments) EXPECT_TRUE(next.design.layout()) << next.reason;
}

TEST(Diagnosis, ADriftFromBatchToBatchIsNamed) {
  expect_named(diagnose_effect("batch_drift", 0.05), "batch_drift", 0.05, 0.02);
}

// Of three batches the last, or the one in the middle, is off: no slope over batches explains that.
TEST(Diagnosis, ABatchThatIsOffByItselfIsNoDrift) {
  for (const char* batch : {"batch-2", "batch-3"}) {
    std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({}, synthetic_truth());
    for (measurement::SpecimenRecord& specimen : specimens)
      if (specimen.batch == batch) *specimen.modulus_pa *= 1.1;
    const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
    EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
    ASSERT_FALSE(diagnosis.contrasts.empty());
    EXPECT_NE(diagnosis.contrasts.front().name.find(batch), std::string::npos) << diagnosis.summary;
  }
}

// One value that is wrong must not pass as scatter without a word.
TEST(Diagnosis, ReplicatesThatDoNotAgreeAreCautionedOfAlsoWhereNothingIsFound) {
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({.twins = 0}, synthetic_truth());
  *specimens.front().modulus_pa *= 3.0;
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  EXPECT_EQ(diagnosis.cautions.out_of_line.size(), 1u) << diagnosis.summary;
}

// Alone, rigid_overprint explains more of these data than droplet_mixing does; with the machine it is the other way.
TEST(Diagnosis, TwoEffectsAreNamedAlsoWhereACollinearEffectLeadsAlone) {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions["droplet_mixing"] = {0.8};
  truth.extensions["machine_compliance"] = {3e-10};
  const Diagnosis diagnosis = diagnose_truth(truth);
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  std::vector<std::string> names;
  for (const NamedEffect& effect : diagnosis.effects) names.push_back(effect.name);
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"droplet_mixing", "machine_compliance"}));
}

// A bulk phase that is softer across its layers changes every turned specimen by the same factor. Interfaces that
// differ come near to that and are not the cause.
TEST(Diagnosis, ACauseThatActsEvenlyAlongAConditionGetsNoName) {
  for (const double factor : {0.985, 1.02}) {
    for (const std::uint64_t seed : {1, 2}) {
      SyntheticSet set;
      set.seed = seed;
      std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens(set, synthetic_truth());
      for (measurement::SpecimenRecord& specimen : specimens)
        if (specimen.conditions.orientation_deg == 90.0) *specimen.modulus_pa *= factor;
      DiagnosisSettings settings = tiny_settings();
      settings.seed = seed;
      const Diagnosis diagnosis = diagnose(specimens, settings);
      EXPECT_NE(to_string(diagnosis.verdict), "named") << factor << ", seed " << seed << ": " << diagnosis.summary;
    }
  }
}

// Other constants of the materials explain a factor on force exactly.
TEST(Diagnosis, AnErrorOfTheLoadCellIsInvisibleAndNothingIsNamed) {
  const Diagnosis diagnosis = diagnose_effect("load_cell_gain", 0.05);
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
  const auto gain = std::find_if(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                                 [](const CandidateEffect& c) { return c.name == "load_cell_gain"; });
  ASSERT_NE(gain, diagnosis.candidates.end());
  EXPECT_EQ(gain->status, CandidateStatus::invisible);
  EXPECT_GT(gain->absorption, 0.95);
}

// Moduli that fall with the share of mixed corners beyond the prediction of any known effect: a misfit, and not given
// the name of the effect that comes nearest.
TEST(Diagnosis, AnUnmodelledCauseIsSeenAndNotNamed) {
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({}, synthetic_truth());
  const std::vector<Descriptor> described = descriptors();
  const auto corners = std::find_if(described.begin(), described.end(),
                                    [](const Descriptor& d) { return d.name == "mixed pixel corners"; });
  ASSERT_NE(corners, described.end());
  for (measurement::SpecimenRecord& specimen : specimens) {
    Observation group;
    group.design = specimen.design;
    *specimen.modulus_pa *= std::exp(-6.0 * std::pow(corners->of(group) - 0.5, 2));
  }
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_TRUE(diagnosis.partial_gain) << "of the effect that comes nearest";
}

// Every design printed in a batch of its own, batches 4 % apart: no effect is named, and a caution gives the reason.
TEST(Diagnosis, BatchesThatShareNoDesignAreCautionedOf) {
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({}, synthetic_truth());
  RandomStream batches(1, "test/batches");
  for (std::size_t i = 0; i < specimens.size(); i += 3) {
    const double offset = 0.04 * batches.normal();
    for (std::size_t j = i; j < i + 3; ++j) {
      specimens[j].batch = std::to_string(i / 3);
      *specimens[j].modulus_pa *= std::exp(offset);
    }
  }
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.cautions.disconnected_batches, 17);
}

Diagnosis diagnose_coupons(const std::string& effect, std::vector<double> values,
                           const std::vector<double>& strains = pulled_to_two_percent()) {
  material::ParameterSet truth = synthetic_truth();
  if (!effect.empty()) truth.extensions[effect] = std::move(values);
  return with_levels_checked(diagnose(synthetic_coupons(truth, {1e-3, 1e-2}, 3, 0.01, 5, strains), tiny_settings()));
}

TEST(CouponDiagnosis, CouponsOfTheBaseModelAreBaseSufficient) {
  const Diagnosis diagnosis = diagnose_coupons("", {});
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
}

TEST(CouponDiagnosis, SlackOfTheGripsIsNamedFromCurvesAlone) {
  const Diagnosis diagnosis = diagnose_coupons("toe_slack", {0.002});
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "toe_slack");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 0.002, 0.0002);
}

TEST(CouponDiagnosis, MuchSlackIsFoundToo) {
  const Diagnosis diagnosis = diagnose_coupons("toe_slack", {0.015});
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "toe_slack");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 0.015, 0.0005);
}

// The range ends at 2e-9 /Pa: an effect at its bound whose residuals are noise comes nearest, and no second effect
// makes up for the bound.
TEST(CouponDiagnosis, ASpringBeyondItsBoundComesNearest) {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions["machine_compliance"] = {2e-9};
  std::vector<measurement::SpecimenRecord> specimens = synthetic_coupons(truth, {1e-3, 1e-2}, 3, 0.01, 5);
  for (measurement::SpecimenRecord& specimen : specimens)
    for (std::size_t i = 0; i < specimen.curve.size(); ++i)
      specimen.curve.strain[i] += 2e-10 * specimen.curve.stress_pa[i];
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::at_bound);
  EXPECT_EQ(diagnosis.finding.nearest, std::vector<std::string>{"machine_compliance"});
  EXPECT_NEAR(diagnosis.finding.value, 2e-9, 1e-12);
}

// One material that responds to faster pulls: no contrast and no law of the library stands for that, but the rate does.
TEST(CouponDiagnosis, ARateThatOneMaterialAloneFeelsIsNamedWithoutALaw) {
  std::vector<measurement::SpecimenRecord> specimens = synthetic_coupons(synthetic_truth(), {1e-3, 1e-2}, 3, 0.01, 5);
  for (measurement::SpecimenRecord& specimen : specimens)
    if (specimen.design.name() == "soft" && specimen.conditions.strain_rate_per_s > 5e-3)
      for (double& stress : specimen.curve.stress_pa) stress *= 1.1;
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().family, "rate");
  EXPECT_EQ(diagnosis.finding.reason, Reason::free_form);
  EXPECT_EQ(diagnosis.loudest, (RowsOf{RowsOf::Kind::coupons, "soft"})) << diagnosis.summary;
}

// The machine stands between what was ordered and what the coupon felt, on the way back too.
TEST(CouponDiagnosis, SlackIsNamedFromCouponsThatWereUnloadedOnTheWay) {
  const Diagnosis diagnosis = diagnose_coupons("toe_slack", {0.002}, unload_history());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "toe_slack");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 0.002, 0.0002);
}

// Mixtures have no stiffness of their own: coupons of many of them tell a spring from the constants of the materials.
TEST(CouponDiagnosis, ASpringIsNamedFromCouponsThatWereUnloadedOnTheWay) {
  const Diagnosis diagnosis = diagnose_coupons("machine_compliance", {2e-10}, unload_history());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "machine_compliance");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 2e-10, 3e-11);
}

// The curve is flat behind the yield point: reading it as far as its largest stress would leave the flow out.
TEST(CouponDiagnosis, AYieldPointIsNamedFromCurvesAlone) {
  const Diagnosis diagnosis = diagnose_coupons("rigid_yield", {2.5e7});
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "rigid_yield");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 2.5e7, 2e6);
}

// Coupons have constants of their own; those of layouts and of fracture tests were not fitted, and are not reported.
TEST(CouponDiagnosis, TheConstantsThatAreReportedAreThoseThatWereFitted) {
  material::ParameterSet truth = synthetic_truth();
  truth.modulus.e_vw_pa = 3.3e9;
  DiagnosisSettings settings = tiny_settings();
  settings.bootstraps = 700;
  const Diagnosis diagnosis = diagnose(synthetic_coupons(truth, {1e-3}, 3, 0.01, 5), settings);
  ASSERT_TRUE(diagnosis.base_fit.coupon) << diagnosis.summary;
  EXPECT_NEAR(diagnosis.base_fit.coupon->e_vw_pa, 3.3e9, 0.1e9);
  const auto fit = nlohmann::json::parse(to_json(diagnosis))["base_fit"];
  EXPECT_NEAR(fit["coupon"]["e_vw_pa"].get<double>(), 3.3e9, 0.1e9);
  EXPECT_FALSE(fit.contains("modulus"));
  EXPECT_FALSE(fit.contains("toughness"));
}

// A relaxation has a time besides its size.
TEST(CouponDiagnosis, EveryNumberOfANamedEffectHasItsInterval) {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions["rate_dependence"] = {0.5, 12.0};
  const Diagnosis diagnosis =
      diagnose(synthetic_coupons(truth, {1e-3, 1e-2, 1e-1}, 3, 0.01, 5, unload_history()), tiny_settings());
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects[0].name, "rate_dependence");
  ASSERT_EQ(diagnosis.effects[0].further.size(), 1u);
  const FittedNumber time_s = diagnosis.effects[0].further[0];
  EXPECT_LT(time_s.interval_low, time_s.value);
  EXPECT_GT(time_s.interval_high, time_s.value);
  EXPECT_LT(time_s.interval_low, 12.0);
  EXPECT_GT(time_s.interval_high, 12.0);
  EXPECT_LT(time_s.interval_high / time_s.interval_low, 4.0);
  const auto effect = nlohmann::json::parse(to_json(diagnosis))["effects"][0];
  EXPECT_EQ(effect["further"], std::vector{time_s.value});
  EXPECT_EQ(effect["further_interval90"][0], (std::vector{time_s.interval_low, time_s.interval_high}));
}

// Coupons carry no information on the elements of layouts, nor on the scatter of moduli.
TEST(Diagnosis, CouponsDoNotChangeTheReportedNoiseOfModuli) {
  DiagnosisSettings settings = tiny_settings();
  settings.bootstraps = 700;
  settings.check_discretisation = false;
  settings.floor = {.log_modulus_sd = 0.01, .mesh_amplitude = 1.0, .mesh_remainder_sd = 0.002};
  auto specimens = synthetic_specimens({.patterns = 12, .twins = 0, .replicates = 1, .noise = 0.01}, synthetic_truth());
  const double alone = diagnose(specimens, settings).discretisation_shared_sd;
  const auto coupons = synthetic_coupons(synthetic_truth(), {1e-3}, 3, 0.01, 5);
  specimens.insert(specimens.end(), coupons.begin(), coupons.end());
  const Diagnosis diagnosis = diagnose(specimens, settings);
  EXPECT_NEAR(diagnosis.discretisation_shared_sd, alone, 0.1 * alone);
  EXPECT_FALSE(diagnosis.noise_known) << "two per cent are assumed of moduli";
  EXPECT_DOUBLE_EQ(diagnosis.replicate_sd, 0.02);
}

measurement::SpecimenRecord homogeneous(const std::string& name, double rigid_share, double modulus_pa) {
  measurement::SpecimenRecord record;
  record.specimen = name;
  record.design = pattern::Mixture{rigid_share};
  record.modulus_pa = modulus_pa;
  return record;
}

// Three moduli fit three constants whatever is wrong with them.
TEST(Diagnosis, ThreeModuliTellNothingOfAModel) {
  const Diagnosis diagnosis =
      diagnose({homogeneous("a", 0.0, 1e6), homogeneous("b", 0.5, 4e8), homogeneous("c", 1.0, 2e9)}, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "insufficient") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::nothing_visible);
  EXPECT_FALSE(diagnosis.next_experiments.empty()) << "what would tell";
}

// Six means without replicates whose exponents are -0.01 and 0.08 +- 0.07 tell of no rate, and of none: E of one may
// double over two decades.
TEST(Diagnosis, ABaseIsNotSufficientWhereTheDataLeaveRoomForWhatMatters) {
  const auto verdict_of = [](double scatter) {
    std::vector<measurement::SpecimenRecord> means;
    const std::array off = {0.0, 0.4, -0.2, -1.4, 0.9, 0.5};
    for (int i = 0; i < 6; ++i) {
      means.push_back(
          homogeneous(std::to_string(i), i < 3 ? 0.0 : 1.0, (i < 3 ? 1e6 : 2e9) * std::exp(scatter * off[i])));
      means.back().conditions.strain_rate_per_s = std::array{1e-2, 1e-1, 1.0}[i % 3];
    }
    return diagnose(means, tiny_settings());
  };
  const Diagnosis scattered = verdict_of(0.2), quiet = verdict_of(0.01);
  EXPECT_EQ(to_string(scattered.verdict), "insufficient") << scattered.summary;
  EXPECT_EQ(scattered.finding.reason, Reason::room_is_left);
  EXPECT_EQ(scattered.finding.along, kStrainRate);
  EXPECT_GT(scattered.finding.value, 0.5);
  EXPECT_EQ(to_string(quiet.verdict), "base_sufficient") << quiet.summary;
}

// One material at three thicknesses: that none matters by a quarter is an answer.
TEST(Diagnosis, ABaseIsSufficientWhereAConditionWasVariedAndNothingChanges) {
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream noise(3, "test/thickness");
  for (const double thickness_mm : {1.6, 3.2, 4.8})
    for (int k = 0; k < 6; ++k) {
      specimens.push_back(homogeneous(std::to_string(specimens.size()), 1.0, 2e9 * std::exp(0.02 * noise.normal())));
      specimens.back().conditions.thickness_mm = thickness_mm;
    }
  EXPECT_EQ(to_string(diagnose(specimens, tiny_settings()).verdict), "base_sufficient");
  for (std::size_t k = 0; k < specimens.size(); ++k) specimens[k].conditions.thickness_mm = 3.2;
  EXPECT_EQ(to_string(diagnose(specimens, tiny_settings()).verdict), "insufficient") << "nothing was varied";
}

// Nobody knows a law of it, but replicates that follow it are no scatter.
TEST(Diagnosis, ATrendAlongAFurtherColumnIsSaidAndNothingIsGreen) {
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream noise(3, "test/layer height");
  for (const double rate : {1e-3, 1e-1})
    for (const double height_mm : {0.05, 0.1, 0.2, 0.3})
      for (int k = 0; k < 3; ++k) {
        specimens.push_back(homogeneous(std::to_string(specimens.size()), 1.0,
                                        2e9 * (1.0 - 0.9 * height_mm) * std::exp(0.02 * noise.normal())));
        specimens.back().conditions.strain_rate_per_s = rate;
        specimens.back().other_columns["layer_height_mm"] = std::to_string(height_mm);
      }
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.along, "layer_height_mm");
}

// Two constants that nobody measured fit any two blends: no base is sufficient with an ink that only blends tell.
TEST(Diagnosis, ABaseThatFitsBlendsByAnotherInkIsLeftOpen) {
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream noise(3, "test/blends");
  for (const double share : {0.6, 0.75, 1.0})
    for (int k = 0; k < 4; ++k)
      specimens.push_back(homogeneous(std::to_string(specimens.size()), share,
                                      2e7 * std::pow(100.0, 2.0 * share - 1.0) * std::exp(0.02 * noise.normal())));
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "ambiguous") << diagnosis.summary;
  EXPECT_EQ(diagnosis.finding.reason, Reason::other_material);
  ASSERT_FALSE(diagnosis.next_experiments.empty());
  EXPECT_EQ(diagnosis.next_experiments.front().design, pattern::Design(pattern::Mixture{0.5}));
}

// Blends of an ink that has no specimen of its own: it may be another one, and the rate is what changes.
TEST(Diagnosis, BlendsTellTheRangesOfMaterialsWithoutSpecimens) {
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream noise(3, "test/blends");
  for (const double rate : {1e-3, 1e-2, 1e-1})
    for (const double share : {0.75, 1.0})
      for (int k = 0; k < 4; ++k) {
        const double e_pa = share == 1.0 ? 1.9e9 : 2e8;  // of an interface of 2e7 Pa
        specimens.push_back(homogeneous(std::to_string(specimens.size()), share,
                                        e_pa * std::pow(rate / 1e-3, 0.08) * std::exp(0.02 * noise.normal())));
        specimens.back().conditions.strain_rate_per_s = rate;
      }
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects.front().family, "rate");
  ASSERT_EQ(diagnosis.cautions.other_materials.size(), 1u);
  EXPECT_EQ(kConstantMaterials[diagnosis.cautions.other_materials[0].material], "interface");
}

// Does the rate matter? Two rates with replicates answer that, either way.
TEST(Diagnosis, TwoRatesTellWhetherTheRateMatters) {
  for (const double faster : {1.0, 1.3}) {
    RandomStream noise(11, "test/two rates");
    std::vector<measurement::SpecimenRecord> specimens;
    for (int i = 0; i < 8; ++i) {
      specimens.push_back(
          homogeneous(std::to_string(i), 1.0, 2e9 * (i < 4 ? 1.0 : faster) * std::exp(0.03 * noise.normal())));
      specimens.back().conditions.strain_rate_per_s = i < 4 ? 1e-3 : 1e-1;
    }
    const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
    if (faster == 1.0) {
      EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
      continue;
    }
    ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
    EXPECT_EQ(material::find_effect(diagnosis.effects.front().name)->cause(), "rate_dependence");
    EXPECT_GT(diagnosis.possible.size(), 1u) << "two rates leave its form open";
  }
}

// No effect of the library depends on temperature: it is seen, and said to be unmodelled.
TEST(Diagnosis, AConditionThatTheModelDoesNotKnowIsSeen) {
  RandomStream noise(12, "test/temperature");
  std::vector<measurement::SpecimenRecord> specimens;
  for (int i = 0; i < 12; ++i) {
    const double temperature_c = 20.0 * (i / 4);
    specimens.push_back(
        homogeneous(std::to_string(i), 1.0, 2e9 * (1.0 - 0.005 * temperature_c) * std::exp(0.02 * noise.normal())));
    specimens.back().other_columns["temperature_c"] = std::to_string(temperature_c);
  }
  const Diagnosis diagnosis = diagnose(specimens, tiny_settings());
  EXPECT_EQ(to_string(diagnosis.verdict), "unexplained") << diagnosis.summary;
  ASSERT_FALSE(diagnosis.contrasts.empty());
  EXPECT_EQ(diagnosis.contrasts.front().name, "temperature");
  EXPECT_TRUE(diagnosis.cautions.alike.empty());
  for (int i = 0; i < 12; ++i) specimens[i].other_columns["machine"] = i < 8 ? "old" : "new";
  for (int i = 4; i < 8; ++i) specimens[i].other_columns["temperature_c"] = "0";
  EXPECT_EQ(diagnose(specimens, tiny_settings()).cautions.alike, std::vector<std::string>{"machine"});
}

TEST(Diagnosis, NoSpecimenIsAnErrorWithASentence) {
  EXPECT_THROW(diagnose({}, tiny_settings()), NothingMeasured);
  measurement::SpecimenRecord failed = homogeneous("a", 1.0, 2e9);
  failed.valid = false;
  EXPECT_THROW(diagnose({failed}, tiny_settings()), NothingMeasured);
}

}  // namespace
}  // namespace nacre::diagnosis
