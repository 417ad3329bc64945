#include "laboratory/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/laboratory_file.hpp"
#include "laboratory/measure_set.hpp"
#include "laboratory/temperature.hpp"
#include "measurement/read_set.hpp"
#include "pattern/coupons.hpp"
#include "pattern/layout.hpp"

namespace nacre::laboratory {
namespace {

using tester::TestKind;

Truth plain_truth() {
  Truth truth = draw_truth(21, tester::Fidelity::tiny);
  truth.effects = {};
  return truth;
}

pattern::Design published(const char* key) { return pattern::design_from_name(key).value(); }

/// A triangle-shaped curve, as if simulated.
TrueResponse simple_response() {
  TrueResponse response{.modulus_pa = 1e9, .curve = {}, .remark = {}};
  for (int i = 0; i <= 100; ++i) {
    response.curve.strain.push_back(2e-4 * i);
    response.curve.stress_pa.push_back(1e5 * std::min(i, 100 - i));
  }
  return response;
}

measurement::SpecimenRecord record(const Truth& truth, TestKind test, const std::string& specimen) {
  return record_specimen(
      truth, {.design = published("577fffe9fffdef"), .test = test, .conditions = {}, .fidelity = truth.fidelity},
      simple_response(), {.specimen = specimen, .batch = "b", .print_order = 1});
}

struct Spread {
  double mean = 0.0, sd = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  for (const double value : values)
    spread.sd += (value - spread.mean) * (value - spread.mean) / static_cast<double>(values.size() - 1);
  spread.sd = std::sqrt(spread.sd);
  return spread;
}

TEST(ReplicateScatter, HasTheDeclaredStandardDeviationsAndNoBias) {
  const Truth truth = plain_truth();
  std::vector<double> log_moduli, log_toughnesses, log_strains;
  for (int i = 0; i < 4000; ++i) {
    log_moduli.push_back(std::log(record(truth, TestKind::modulus, "m" + std::to_string(i)).modulus_pa.value() / 1e9));
    const auto torn = record(truth, TestKind::toughness, "t" + std::to_string(i));
    log_toughnesses.push_back(std::log(torn.toughness_pa.value() / tester::area_under(simple_response().curve)));
    log_strains.push_back(std::log(torn.curve.strain.back() / simple_response().curve.strain.back()));
  }
  // Four standard errors: sd / sqrt(2 n) of a standard deviation, sd / sqrt(n) of a mean.
  const auto expect = [](const std::vector<double>& logs, double sd) {
    const Spread spread = spread_of(logs);
    EXPECT_NEAR(spread.sd, sd, 4.0 * sd / std::sqrt(2.0 * 4000));
    EXPECT_NEAR(spread.mean, 0.0, 4.0 * sd / std::sqrt(4000.0));
  };
  expect(log_moduli, truth.noise.modulus);
  expect(log_toughnesses, truth.noise.toughness);
  expect(log_strains, truth.noise.strain);
}

TEST(ReplicateScatter, DependsOnTheSpecimensNameAndTheSeedAlone) {
  const Truth truth = plain_truth();
  const auto early = record(truth, TestKind::toughness, "r1/x/1");
  record(truth, TestKind::toughness, "r1/x/2");
  EXPECT_EQ(record(truth, TestKind::toughness, "r1/x/1"), early);
  EXPECT_NE(record(truth, TestKind::toughness, "r1/x/2").toughness_pa, early.toughness_pa);
  Truth other = truth;
  other.seed = 22;
  EXPECT_NE(record(other, TestKind::toughness, "r1/x/1").toughness_pa, early.toughness_pa);
}

TEST(ReplicateScatter, GivenToughnessIsTheAreaUnderTheRecordedCurve) {
  const auto torn = record(plain_truth(), TestKind::toughness, "a");
  EXPECT_DOUBLE_EQ(torn.toughness_pa.value(), tester::area_under(torn.curve));
  EXPECT_LE(torn.curve.size(), 201u);
}

TEST(Machine, ComplianceAddsToTheReciprocalOfTheModulusAndToTheStrain) {
  Truth truth = plain_truth();
  truth.noise = {.modulus = 0.0, .toughness = 0.0, .strain = 0.0};
  truth.effects.machine_compliance_per_pa = 2e-10;
  EXPECT_NEAR(1.0 / record(truth, TestKind::modulus, "a").modulus_pa.value(), 1e-9 + 2e-10, 1e-18);
  const auto torn = record(truth, TestKind::toughness, "a");
  for (std::size_t i = 0; i < torn.curve.size(); ++i) {
    EXPECT_DOUBLE_EQ(torn.curve.strain[i],
                     simple_response().curve.strain[i] + 2e-10 * simple_response().curve.stress_pa[i]);
  }
}

TEST(Machine, SlackShiftsTheCurveAndLeavesItsArea) {
  Truth truth = plain_truth();
  const auto before = record(truth, TestKind::toughness, "a");
  truth.effects.toe_slack = 0.003;
  const auto after = record(truth, TestKind::toughness, "a");
  EXPECT_DOUBLE_EQ(after.curve.strain.back(), before.curve.strain.back() + 0.003);
  EXPECT_NEAR(after.toughness_pa.value() / before.toughness_pa.value(), 1.0, 1e-12);
}

TEST(Machine, LoadCellGainScalesEveryStress) {
  Truth truth = plain_truth();
  const auto before = record(truth, TestKind::toughness, "a"), stiff = record(truth, TestKind::modulus, "a");
  truth.effects.load_cell_gain = 0.1;
  EXPECT_NEAR(record(truth, TestKind::toughness, "a").toughness_pa.value() / before.toughness_pa.value(), 1.1, 1e-12);
  EXPECT_NEAR(record(truth, TestKind::modulus, "a").modulus_pa.value() / stiff.modulus_pa.value(), 1.1, 1e-12);
}

TEST(Machine, CalipersAreOffByALengthAndThinSpecimensMost) {
  Truth truth = plain_truth();
  const auto modulus = [&](double thickness_mm) {
    const Experiment experiment{.design = published("577fffe9fffdef"),
                                .test = TestKind::modulus,
                                .conditions = {.thickness_mm = thickness_mm},
                                .fidelity = tester::Fidelity::tiny};
    return record_specimen(truth, experiment, respond(truth, experiment), {"s"}).modulus_pa.value();
  };
  const double thick = modulus(3.2), thin = modulus(1.6);
  truth.effects.thickness_error_mm = 0.1;
  EXPECT_NEAR(modulus(3.2) / thick, 3.2 / 3.3, 1e-12);
  EXPECT_NEAR(modulus(1.6) / thin, 1.6 / 1.7, 1e-12);
}

TEST(Effects, MaterialPulledAcrossThePassesIsSofterAndTheRestAsItWas) {
  Truth truth = plain_truth();
  const auto modulus = [&](const pattern::Design& design, double orientation_deg) {
    return respond(truth, {.design = design,
                           .test = TestKind::modulus,
                           .conditions = {.orientation_deg = orientation_deg},
                           .fidelity = tester::Fidelity::tiny})
        ->modulus_pa;
  };
  for (const pattern::Design& design : {published("577fffe9fffdef"), pattern::Design(pattern::Mixture{0.65})}) {
    truth.effects.bulk_anisotropy = 0.0;
    const double along = modulus(design, 0.0), across = modulus(design, 90.0);
    truth.effects.bulk_anisotropy = 0.05;
    EXPECT_EQ(modulus(design, 0.0), along) << design.name();
    EXPECT_NEAR(modulus(design, 90.0) / across, 0.95, 1e-9) << design.name();
  }
}

TEST(Effects, OfZeroInTheFileMeasureExactlyAsWithout) {
  const std::vector<pattern::Design> designs = {published("577fffe9fffdef"), pattern::Mixture{0.65}};
  const auto plain =
      measure(parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 1\n", "a"), {designs, {TestKind::modulus}});
  for (const EffectKind& kind : effect_kinds()) {
    const Truth truth = parse_laboratory(
        fmt::format("seed = 3\nfidelity = \"tiny\"\nreplicates = 1\n[[effect]]\nname = \"{}\"\nvalue = 0\n", kind.name),
        "b");
    EXPECT_EQ(measure(truth, {designs, {TestKind::modulus}}), plain) << kind.name;
    const auto torn = [&](const Truth& laboratory) { return record(laboratory, TestKind::toughness, "s"); };
    EXPECT_EQ(torn(truth), torn(parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 1\n", "a"))) << kind.name;
  }
}

TEST(Respond, AHomogeneousModulusFollowsTheMixtureLaw) {
  const Truth truth = plain_truth();
  const auto modulus = [&](double fraction) {
    return respond(truth,
                   {.design = pattern::Mixture{fraction}, .test = TestKind::modulus, .conditions = {}, .fidelity = {}})
        ->modulus_pa;
  };
  EXPECT_NEAR(modulus(0.0) / truth.modulus.e_tb_pa, 1.0, 1e-12);
  EXPECT_NEAR(modulus(0.5) / truth.modulus.e_if_pa, 1.0, 1e-12);
  EXPECT_NEAR(modulus(1.0) / truth.modulus.e_vw_pa, 1.0, 1e-12);
  EXPECT_NEAR(modulus(0.75) / std::sqrt(truth.modulus.e_if_pa * truth.modulus.e_vw_pa), 1.0, 1e-12);
}

// Voxels in a layout differ from the bulk by what [coupons] says; layouts do not know it.
TEST(Respond, HomogeneousSpecimensHaveConstantsOfTheirOwn) {
  const Truth plain = plain_truth();
  Truth apart = plain;
  apart.coupons = {.soft = 1.2, .rigid = 0.9, .interface = 1.5};
  const auto modulus = [](const Truth& truth, const pattern::Design& design) {
    return respond(truth, {.design = design, .test = TestKind::modulus, .conditions = {}, .fidelity = {}})->modulus_pa;
  };
  EXPECT_NEAR(modulus(apart, pattern::Mixture{0.0}) / modulus(plain, pattern::Mixture{0.0}), 1.2, 1e-12);
  EXPECT_NEAR(modulus(apart, pattern::Mixture{0.5}) / modulus(plain, pattern::Mixture{0.5}), 1.5, 1e-12);
  EXPECT_NEAR(modulus(apart, pattern::Mixture{1.0}) / modulus(plain, pattern::Mixture{1.0}), 0.9, 1e-12);
  EXPECT_EQ(modulus(apart, pattern::checkerboard(5)), modulus(plain, pattern::checkerboard(5)));
  const Experiment pull{.design = pattern::Mixture{1.0}, .test = TestKind::tensile, .conditions = {}, .fidelity = {}};
  EXPECT_LT(respond(apart, pull)->curve.stress_pa.at(10), respond(plain, pull)->curve.stress_pa.at(10));
}

TEST(Respond, RefusesWhatMakesNoSense) {
  const Truth truth = plain_truth();
  EXPECT_FALSE(respond(
      truth, {.design = published("577fffe9fffdef"), .test = TestKind::tensile, .conditions = {}, .fidelity = {}}));
  EXPECT_FALSE(respond(truth, {.design = pattern::Mixture{0.5},
                               .test = TestKind::modulus,
                               .conditions = {.orientation_deg = 45.0},
                               .fidelity = {}}));
}

TEST(Respond, ATornTinySpecimenSeparatesWithAPlausibleToughness) {
  const Truth truth = plain_truth();
  const auto response = respond(truth, {.design = published("577fffe9fffdef"),
                                        .test = TestKind::toughness,
                                        .conditions = {},
                                        .fidelity = tester::Fidelity::tiny});
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->remark, "");
  const double toughness_mpa = tester::area_under(response->curve) / 1e6;
  EXPECT_GT(toughness_mpa, 0.03);
  EXPECT_LT(toughness_mpa, 3.0);
}

TEST(RecordSpecimen, AFailedSimulationIsAnInvalidSpecimenWithANoteAndNoNumber) {
  const auto failed = record_specimen(
      plain_truth(),
      {.design = published("577fffe9fffdef"), .test = TestKind::toughness, .conditions = {}, .fidelity = {}},
      fail("fracture bench: step 7"), {.specimen = "s", .batch = "b", .print_order = 2});
  EXPECT_FALSE(failed.valid);
  EXPECT_EQ(failed.note, "fracture bench: step 7");
  EXPECT_FALSE(failed.modulus_pa || failed.toughness_pa || !failed.curve.empty());
}

// A testing machine knows what it records, not what the piece is strained.
TEST(RecordSpecimen, ACouponIsTurnedAtTheStrainThatIsRecorded) {
  const Truth truth = plain_truth();
  for (const tester::Loading& loading :
       {tester::Loading{{0.02, 0.005, 0.022}}, tester::Loading{{0.02}, {60.0}, 60.0}}) {
    const Experiment experiment{.design = pattern::Mixture{1.0},
                                .test = TestKind::tensile,
                                .conditions = {},
                                .fidelity = truth.fidelity,
                                .loading = loading};
    const auto response = respond(truth, experiment);
    const double highest = *std::ranges::max_element(loading.turns);
    std::set<double> stresses;
    for (const char* name : {"a", "b", "c"}) {
      const auto coupon = record_specimen(truth, experiment, response, {.specimen = name});
      ASSERT_TRUE(coupon.valid) << coupon.note;
      EXPECT_NEAR(*std::ranges::max_element(coupon.curve.strain), highest, 1e-12) << name;
      stresses.insert(*std::ranges::max_element(coupon.curve.stress_pa));
    }
    EXPECT_EQ(stresses.size(), 3u) << "pieces still differ";
  }
}

TEST(MeasureSet, WritesASetThatReadsBackAndSealsItsTruthBesideIt) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "virtual_lab_set";
  std::filesystem::remove_all(folder);
  std::filesystem::remove(folder.string() + ".truth.toml");
  write_file_atomically(
      folder.string() + ".lab.toml",
      "seed = 3\nfidelity = \"tiny\"\nreplicates = 3\n[[effect]]\nname = \"droplet_mixing\"\nvalue = 0.5\n");
  const std::vector<pattern::Design> designs = {published("577fffe9fffdef"), published("3ffc9b4ad4d2d9"),
                                                pattern::Mixture{0.65}, published("577fffe9fffdef")};
  const auto records = measure_set(folder.string() + ".lab.toml", folder / "", {designs, {TestKind::modulus}});
  const measurement::MeasurementSet set = measurement::read_measurement_set(folder);
  EXPECT_EQ(records.size(), 3u * 3u);  // the repeated design once
  EXPECT_EQ(set.specimens.size() + set.rejected.size(), records.size());
  EXPECT_TRUE(set.rejected.empty());
  std::map<std::string, std::set<int>> positions;
  for (const auto& specimen : records) positions[specimen.batch].insert(specimen.print_order);
  EXPECT_EQ(positions.size(), 3u);
  for (const auto& [batch, numbers] : positions)
    EXPECT_EQ(*numbers.rbegin(), static_cast<int>(numbers.size())) << batch;
  EXPECT_EQ(read_laboratory(folder.string() + ".truth.toml").effects.droplet_mixing_pixels, 0.5);
  EXPECT_FALSE(std::filesystem::exists(folder / "truth.toml"));
}

TEST(MeasureSet, RefusesAFolderThatHoldsASetBeforeAnythingIsSimulated) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "virtual_lab_known_set";
  std::filesystem::create_directories(folder);
  const std::string laboratory = folder.string() + ".lab.toml",
                    table = "specimen,pattern,test,modulus_pa\na,soft,x,1\n";
  write_file_atomically(laboratory, "seed = 3\nfidelity = \"tiny\"\n");
  write_file_atomically(folder / "measurements.csv", table);
  int simulated = 0;
  try {
    measure_set(laboratory, folder, {{pattern::Mixture{0.65}}, {TestKind::modulus}},
                [&](double, int, int) { ++simulated; });
    ADD_FAILURE() << "was measured over";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("holds 1 specimens; expected a new folder"));
  }
  EXPECT_EQ(simulated, 0);
  EXPECT_EQ(read_file(folder / "measurements.csv"), table);
}

TEST(MeasureSet, KeepsTheTruthOfASetThatWasMovedAway) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "virtual_lab_moved_set";
  const std::string laboratory = folder.string() + ".lab.toml", truth = folder.string() + ".truth.toml";
  write_file_atomically(laboratory, "seed = 3\nfidelity = \"tiny\"\n");
  write_file_atomically(truth, "seed = 7\n");
  EXPECT_THROW(measure_set(laboratory, folder, {{pattern::Mixture{0.65}}, {TestKind::modulus}}), InputError);
  EXPECT_EQ(read_file(truth), "seed = 7\n");
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Campaign, TurnedTwinsAreThoseOfLayoutsAndHomogeneousCouponsAreMeasuredOnce) {
  const Truth truth = parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n", "a");
  std::string text;
  for (int row = 0; row < 20; ++row) text += "11111000001111100000\n";
  const pattern::Layout stripes = pattern::layout_from_text(text, "stripes").value();
  const std::vector<pattern::Design> designs = {stripes, pattern::Mixture{0.65}};
  const auto straight = measure(truth, {designs, {TestKind::modulus}});
  const auto both = measure(truth, {designs, {TestKind::modulus}, {0.0, 90.0}});
  ASSERT_EQ(straight.size(), 4u);
  ASSERT_EQ(both.size(), 6u);
  std::map<double, double> modulus_pa;
  for (const auto& record : both) {
    if (record.design == designs[0]) modulus_pa[record.conditions.orientation_deg] = record.modulus_pa.value();
  }
  EXPECT_NEAR(modulus_pa.at(90.0) / modulus_pa.at(0.0), 1.0, 0.2) << "stripes lie along the load either way";
  for (auto record : straight) {
    const auto same = std::ranges::find(both, record.specimen, &measurement::SpecimenRecord::specimen);
    ASSERT_NE(same, both.end());
    record.print_order = same->print_order;
    EXPECT_EQ(record, *same) << "a twin changes nothing but the order of printing";
  }
}

// Closed form of Williams, Landel, Ferry (1955), and equal stiffness at the shifted rate.
TEST(Temperature, ShiftsTheRate) {
  EXPECT_DOUBLE_EQ(rate_shift(kReferenceC), 1.0);
  EXPECT_NEAR(std::log10(rate_shift(kReferenceC + 40.0)), -8.86 * 40.0 / 141.6, 1e-12);
  EXPECT_GT(rate_shift(0.0), 100.0) << "cold is fast";
  Truth truth = plain_truth();
  Experiment warm{.design = pattern::Mixture{0.3}, .fidelity = truth.fidelity};
  const auto modulus = [&](double rate_per_s, std::optional<double> temperature_c) {
    warm.conditions.strain_rate_per_s = rate_per_s;
    warm.temperature_c = temperature_c;
    return respond(truth, warm)->modulus_pa;
  };
  EXPECT_EQ(modulus(1e-3, 40.0), modulus(1e-3, {})) << "nothing depends on the rate";
  truth.effects.rate_exponent = 0.2;
  truth.effects.rate_exponent_ratio = 0.3;
  EXPECT_EQ(modulus(1e-3, 23.0), modulus(1e-3, {}));
  EXPECT_LT(modulus(1e-3, 40.0), 0.9 * modulus(1e-3, 23.0));
  EXPECT_NEAR(modulus(1e-3, 40.0) / modulus(1e-3 * rate_shift(40.0), 23.0), 1.0, 1e-12);
}

// Boltzmann: what is held for long after a short ramp averages to the chord of a pull over its times.
TEST(HeldStrain, RelaxesByTheLawOfThePull) {
  constexpr int kIntervals = 2000;
  for (const int law : {0, 1, 2}) {
    Truth truth = plain_truth();
    if (law == 0) truth.effects.rate_exponent = 0.3, truth.effects.rate_exponent_ratio = 0.5;
    if (law == 1) truth.effects.rate_overstress = 0.6, truth.effects.rate_relaxation_s = 40.0;
    if (law == 2) truth.effects.two_overstresses = 0.5, truth.effects.shorter_relaxation_s = 20.0;
    Experiment experiment{.design = pattern::Mixture{1.0}, .fidelity = truth.fidelity};
    experiment.conditions.strain_rate_per_s = 1e-5;
    const double pulled = respond(truth, experiment)->modulus_pa;
    double mean = 0.0;
    for (int i = 0; i < kIntervals; ++i) {
      experiment.hold_s = (0.0005 + 0.002 * (i + 0.5) / kIntervals) / 1e-5;
      mean += respond(truth, experiment)->modulus_pa / kIntervals;
    }
    EXPECT_NEAR(mean / pulled, 1.0, 1e-4) << law;
  }
}

TEST(HeldStrain, WarmIsShort) {
  Truth truth = plain_truth();
  truth.effects.rate_overstress = 0.6;
  truth.effects.rate_relaxation_s = 40.0;
  const auto modulus = [&](double hold_s, double temperature_c) {
    Experiment experiment{.design = pattern::Mixture{0.3}, .fidelity = truth.fidelity};
    experiment.hold_s = hold_s;
    experiment.temperature_c = temperature_c;
    return respond(truth, experiment)->modulus_pa;
  };
  EXPECT_NEAR(modulus(30.0, 40.0) / modulus(30.0 / rate_shift(40.0), kReferenceC), 1.0, 1e-4);
  EXPECT_LT(modulus(30.0, 40.0), modulus(30.0, kReferenceC));
}

TEST(HeldStrain, IsRefusedWhereItIsNotModelled) {
  Truth truth = plain_truth();
  Experiment experiment{.design = pattern::Mixture{0.3}, .test = TestKind::tensile, .fidelity = truth.fidelity};
  experiment.hold_s = 10.0;
  EXPECT_THAT(respond(truth, experiment).error().message, testing::HasSubstr("modulus tests of homogeneous"));
  experiment.test = TestKind::modulus;
  EXPECT_TRUE(respond(truth, experiment));
  experiment.hold_s = 0.1;
  EXPECT_THAT(respond(truth, experiment).error().message, testing::HasSubstr("expected at least 0.4"));
}

// The times of one piece: rows that share its scatter but for their readings, its place in the printer and its batch.
TEST(Campaign, OnePieceIsHeldAndReadAtAllTimes) {
  const Truth truth = parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n[noise]\nmodulus = 0.1\n", "a");
  Campaign campaign{{pattern::Mixture{1.0}, pattern::Mixture{0.0}}, {TestKind::modulus}};
  campaign.holds_s = {1.0, 10.0, 100.0};
  std::map<std::string, std::vector<measurement::SpecimenRecord>> pieces;
  for (const auto& each : measure(truth, campaign)) pieces[each.other_columns.at("sample")].push_back(each);
  ASSERT_EQ(pieces.size(), 4u);
  for (const auto& [piece, rows] : pieces) {
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].specimen, piece + "-10s");
    EXPECT_EQ(rows[1].other_columns.at("hold_s"), "10");
    EXPECT_DOUBLE_EQ(rows[1].conditions.strain_rate_per_s, 1.375e-4);
    EXPECT_EQ(rows[0].print_order, rows[2].print_order);
    const double first = std::log(rows[0].modulus_pa.value()), last = std::log(rows[2].modulus_pa.value());
    EXPECT_NE(first, last);
    EXPECT_NEAR(first, last, 0.1) << "five deviations of a fifth of the scatter";
  }
  const auto of = [&](int k) {
    return std::log(pieces.at("rigid-modulus-held-" + std::to_string(k))[0].modulus_pa.value());
  };
  EXPECT_GT(std::abs(of(1) - of(2)), 0.02) << "pieces differ";
}

TEST(Temperature, IsRefusedWhereItIsNotModelled) {
  const Truth truth = plain_truth();
  Experiment experiment{.design = pattern::Mixture{0.3}, .test = TestKind::toughness, .fidelity = truth.fidelity};
  experiment.temperature_c = 40.0;
  EXPECT_THAT(respond(truth, experiment).error().message, testing::HasSubstr("fracture test at 40 C"));
  experiment.test = TestKind::modulus;
  experiment.temperature_c = -80.0;
  EXPECT_THAT(respond(truth, experiment).error().message, testing::HasSubstr("expected -20 to 150"));
}

// One piece as two machines record it.
TEST(Machines, OneOfTwoReadsOtherwise) {
  Truth truth = plain_truth();
  truth.noise = {.modulus = 0.0, .toughness = 0.0, .strain = 0.0};
  const Experiment rigid{.design = pattern::Mixture{1.0}, .fidelity = truth.fidelity};
  const auto recorded_pa = [&](bool on_second) {
    Replicate replicate{.specimen = "a"};
    replicate.on_second_machine = on_second;
    return record_specimen(truth, rigid, respond(truth, rigid), replicate).modulus_pa.value();
  };
  const double plain_pa = recorded_pa(false);
  EXPECT_EQ(recorded_pa(true), plain_pa);
  truth.effects.gain_of_one_machine = 0.2;
  EXPECT_EQ(recorded_pa(false), plain_pa);
  EXPECT_NEAR(recorded_pa(true) / plain_pa, 1.2, 1e-12);
  truth.effects.gain_of_one_machine = 0.0;
  for (const double compliance_per_pa : {1e-10, -1e-10}) {
    truth.effects.compliance_of_one_machine_per_pa = compliance_per_pa;
    const bool on_second = compliance_per_pa > 0.0;
    EXPECT_EQ(recorded_pa(!on_second), plain_pa);
    EXPECT_NEAR(1.0 / recorded_pa(on_second) - 1.0 / plain_pa, 1e-10, 1e-15);
  }
}

TEST(Campaign, EveryMachineTestsSpecimensOfEveryBatch) {
  const Truth truth = parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n", "a");
  Campaign campaign{{pattern::Mixture{1.0}}, {TestKind::modulus}};
  campaign.machines = {"old", "new"};
  std::map<std::string, std::set<std::string>> batches;
  std::set<std::string> names;
  for (const measurement::SpecimenRecord& record : measure(truth, campaign)) {
    batches[record.other_columns.at("machine")].insert(record.batch);
    names.insert(record.specimen);
  }
  EXPECT_EQ(names.size(), 4u);
  EXPECT_EQ(batches["old"], (std::set<std::string>{"batch-1", "batch-2"}));
  EXPECT_EQ(batches["new"], batches["old"]);
}

TEST(Campaign, EveryRateAndTemperatureIsNotedAndHasSpecimensOfItsOwn) {
  const Truth truth = parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n", "a");
  Campaign campaign{{pattern::Mixture{1.0}}, {TestKind::modulus, TestKind::tensile}};
  campaign.rates_per_s = {1e-3, 1e-1};
  campaign.temperatures_c = {20.0, 40.0};
  std::set<std::string> names;
  for (const measurement::SpecimenRecord& record : measure(truth, campaign)) {
    EXPECT_TRUE(record.valid) << record.note;
    names.insert(record.specimen);
    EXPECT_THAT(record.other_columns.at("temperature_c"), testing::AnyOf("20", "40"));
  }
  EXPECT_EQ(names.size(), 16u);
  EXPECT_TRUE(names.contains("rigid-modulus-0.001-40C-2"));
}

TEST(Campaign, TellsHowFarItIs) {
  const Truth truth = parse_laboratory("seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n", "a");
  std::vector<double> shares;
  int last_done = 0;
  measure(truth, {{pattern::Mixture{0.2}, pattern::Mixture{0.4}}, {TestKind::modulus}},
          [&](double share, int done, int all) {
            shares.push_back(share);
            EXPECT_EQ(done, ++last_done);
            EXPECT_EQ(all, 2);
          });
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_LT(shares[0], shares[1]);
  EXPECT_DOUBLE_EQ(shares[1], 1.0);
}

}  // namespace
}  // namespace nacre::laboratory
