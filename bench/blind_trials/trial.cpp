#include "trial.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "base/random.hpp"
#include "broken_trials.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/laboratory_file.hpp"
#include "measurement/read_set.hpp"
#include "measurement/write_set.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"
#include "sealing.hpp"

namespace nacre::blind_trials {
namespace {

namespace fs = std::filesystem;
namespace lab = laboratory;
using tester::TestKind;

constexpr int kDesigns = 3, kLayouts = 16, kTwins = 5, kReplicates = 4;
/// Of kind `power`: effects that moduli and coupons show, and the signal-to-noise ratios at which they are hidden.
constexpr std::array kSeenOnModuli = {"machine_compliance", "droplet_mixing", "interface_anisotropy", "toe_slack",
                                      "rigid_overprint",    "rigid_yield",    "soft_stiffening",      "rate_dependence",
                                      "plane_strain",       "batch_drift"};
constexpr std::array kPowerSignals = {3.0, 4.5, 6.5, 8.0, 12.0};
constexpr int kNullsOfTruth = 10;  ///< trials of kind `fracture` that share a truth in which nothing is hidden
constexpr double kSecondRate = 10.0, kSecondThickness = 0.5;
constexpr double kCouponFractions[] = {0.0, 0.25, 0.5, 0.75, 1.0};
/// Of pairs: as slow as creep and as fast as an impact, so that a relaxation in between has no signature in the shape
/// of either curve.
constexpr double kSlow = 1e-6, kFast = 10.0, kPairRates[] = {kSlow, kFast};
constexpr double kPairLeast = 0.03, kPairMost = 0.1;  ///< sizes that either cause of a pair may have
constexpr double kPairFractions[] = {0.0, 0.25, 0.5, 0.65, 0.8, 0.9, 1.0};

/// Whether rate and batch change together: all fast coupons are of the second batch, all slow ones of the first.
/// Layouts that are neither turned nor accompanied by coupons.
bool is_upright(const BlindTrial& trial) { return trial.kind == "alike" || trial.kind == "distorted"; }
bool is_broken(const BlindTrial& trial) { return trial.kind == "fracture"; }
bool is_pair(const BlindTrial& trial) { return trial.kind == "pair" || trial.kind == "resolved"; }

lab::ReplicateNoise noise_of(const BlindTrial& trial) {
  const double factor = trial.noisy ? 2.0 : 1.0;
  if (is_broken(trial)) return {};  // specimens differ by themselves
  return {.modulus = 0.01 * factor, .toughness = 0.04 * factor, .strain = 0.01 * factor};
}

/// The size that a trial hides: in the lower or upper third of the logarithm of what the laboratory draws.
double hidden_value(const BlindTrial& trial, const lab::EffectKind& kind) {
  const std::string whose = trial.truth_seed > 0 ? "shared" : trial.name;
  RandomStream random(seed_of_truth(trial), fmt::format("trial/{}/{}", whose, kind.name));
  if (is_pair(trial)) return std::exp(random.uniform(std::log(kPairLeast), std::log(kPairMost)));
  const bool drawn = kind.drawn_maximum > 0.0;
  const double low = std::log(drawn ? kind.drawn_minimum : 0.02 * kind.maximum),
               high = std::log(drawn ? kind.drawn_maximum : 0.2 * kind.maximum);
  const double third = (high - low) / 3.0;
  const double value = std::exp(trial.large ? random.uniform(high - third, high) : random.uniform(low, low + third));
  return kind.either_sign && random.index(2) == 1 ? -value : value;
}

/// Replicates come from batches of their own.
std::string batch_of(const BlindTrial& trial, const lab::Experiment& experiment, int replicate) {
  return fmt::format("batch-{}",
                     is_pair(trial) ? (experiment.conditions.strain_rate_per_s == kFast ? 2 : 1) : replicate);
}

/// Homogeneous coupons, each pulled with a curve at every rate.
std::vector<lab::Experiment> pulled_coupons(std::span<const double> fractions, std::span<const double> rates_per_s,
                                            tester::Fidelity fidelity) {
  std::vector<lab::Experiment> experiments;
  for (const double fraction : fractions) {
    for (const double rate_per_s : rates_per_s) {
      lab::Experiment coupon{
          .design = pattern::Mixture{fraction}, .test = TestKind::tensile, .conditions = {}, .fidelity = fidelity};
      coupon.conditions.strain_rate_per_s = rate_per_s;
      experiments.push_back(coupon);
    }
  }
  return experiments;
}

/// Coupons of five mixtures at three rates, each unloaded on its way.
std::vector<lab::Experiment> unloaded_coupons(tester::Fidelity fidelity) {
  constexpr std::array kRates = {1e-4, 1e-2, 1.0};
  std::vector<lab::Experiment> experiments = pulled_coupons(kCouponFractions, kRates, fidelity);
  for (lab::Experiment& each : experiments) each.loading = {{0.02, 0.005, 0.022}};
  return experiments;
}

/// The specimens of a trial without values; coupons with the strains at which the laboratory reads them.
std::vector<measurement::SpecimenRecord> planned(const BlindTrial& trial,
                                                 const std::vector<lab::Experiment>& experiments,
                                                 const std::vector<Result<lab::TrueResponse>>& responses) {
  std::vector<measurement::SpecimenRecord> records;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const lab::Experiment& q = experiments[i];
    for (int r = 0; r < kReplicates; ++r) {
      measurement::SpecimenRecord record;
      const std::string warm = q.temperature_c ? fmt::format("-{:g}C", *q.temperature_c) : "";
      record.specimen = fmt::format("{}-{}-{:.0f}-{:.2g}-{:.2g}{}-{}", q.design.name(), tester::to_string(q.test),
                                    q.conditions.orientation_deg, q.conditions.strain_rate_per_s,
                                    q.conditions.thickness_mm, warm, r + 1);
      record.design = q.design;
      record.test = q.test;
      record.conditions = q.conditions;
      if (q.test == TestKind::tensile && responses[i]) record.curve = responses[i]->curve;
      record.batch = batch_of(trial, q, r + 1);
      record.print_order = static_cast<int>(records.size()) + 1;
      records.push_back(record);
    }
  }
  return records;
}

/// Replicate i of a trial. Of two machines every second replicate is tested on each, and every batch on both.
lab::Replicate replicate_of(const BlindTrial& trial, const measurement::SpecimenRecord& planned, std::size_t i) {
  lab::Replicate replicate{.specimen = planned.specimen, .batch = planned.batch, .print_order = planned.print_order};
  replicate.number = static_cast<int>(i % kReplicates) + 1;
  if (trial.kind != "machines") return replicate;
  replicate.on_second_machine = (i % kReplicates + i / kReplicates) % 2 == 1;
  replicate.machine = replicate.on_second_machine ? "second" : "first";
  return replicate;
}

/// Shown modulus over true one, of a modulus that is this share of the largest: powers 1/2 to 3 of either sign, or one
/// that saturates. A factor linear in E would be a machine's compliance to first order.
double distortion(const BlindTrial& trial, double share) {
  constexpr std::array kPowers = {0.5, 1.5, 2.0, 3.0};
  RandomStream random(trial.seed, "trial/distortion");
  const int form = random.index(static_cast<int>(kPowers.size()) + 1);
  const double size = (trial.large ? 0.25 : 0.12) * (random.index(2) == 0 ? -1.0 : 1.0);
  const bool saturates = form == static_cast<int>(kPowers.size());
  return 1.0 + size * (saturates ? std::tanh(5.0 * share) : std::pow(share, kPowers[form]));
}

void distort(const BlindTrial& trial, std::vector<measurement::SpecimenRecord>& records) {
  double largest_pa = 0.0;
  for (const auto& record : records) largest_pa = std::max(largest_pa, record.modulus_pa.value_or(0.0));
  for (auto& record : records)
    if (record.modulus_pa) *record.modulus_pa *= distortion(trial, *record.modulus_pa / largest_pa);
}

bool is_tabulated(const BlindTrial& trial) {
  static const std::set<std::string, std::less<>> kinds = {"homogeneous", "machines", "spectrum", "warm"};
  return kinds.contains(trial.kind);
}

/// Moduli of five blends at four rates, or of three at three, in trials of kind `warm` each at three temperatures, of
/// kind `spectrum` of two at seven rates: no layout, no curve.
std::vector<lab::Experiment> tabulated_moduli(const BlindTrial& trial, tester::Fidelity fidelity) {
  const bool many = trial.seed % 2 == 0, sweeps = trial.kind == "spectrum";
  std::vector<double> blends = many ? std::vector{0.0, 0.25, 0.5, 0.75, 1.0} : std::vector{0.5, 0.75, 1.0},
                      rates_per_s = many ? std::vector{1e-4, 1e-3, 1e-2, 1e-1} : std::vector{1e-3, 1e-2, 1e-1};
  if (sweeps) blends = {0.0, 1.0};
  if (sweeps) rates_per_s = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0};
  std::vector<lab::Experiment> experiments;
  using Temperatures = std::vector<std::optional<double>>;
  const Temperatures temperatures_c =
      trial.kind == "warm" ? Temperatures{10.0, 25.0, 45.0} : Temperatures{std::nullopt};
  for (const double blend : blends)
    for (const double rate_per_s : rates_per_s)
      for (const std::optional<double>& temperature_c : temperatures_c)
        experiments.push_back({.design = pattern::Mixture{blend},
                               .test = TestKind::modulus,
                               .conditions = {.strain_rate_per_s = rate_per_s},
                               .fidelity = fidelity,
                               .temperature_c = temperature_c});
  return experiments;
}

}  // namespace

std::vector<BlindTrial> all_trials(const TrialOptions& options) {
  std::vector<BlindTrial> trials;
  std::uint64_t seed = options.first_seed;
  const auto add = [&](const std::string& kind, const std::string& what, std::vector<std::string> hidden, bool large,
                       bool noisy) {
    trials.push_back({fmt::format("{}-{}-{}{}-{}", kind, what, large ? "large" : "small", noisy ? "-noisy" : "", seed),
                      kind, seed, large, noisy, std::move(hidden)});
    ++seed;
  };
  for (int i = 0; i < options.nulls; ++i) add("null", "nothing", {}, true, i % 2 == 1);
  std::vector<std::string> inside, outside, forms, even;
  for (const lab::EffectKind& kind : lab::effect_kinds())
    if (!kind.bulk)
      (kind.even ? even : kind.in_library ? inside : kind.family.empty() ? outside : forms).emplace_back(kind.name);
  const auto add_all_sizes = [&](const std::string& kind, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      for (const bool large : {true, false})
        for (const bool noisy : {false, true})
          for (int i = 0; i < options.seeds_per_effect; ++i) add(kind, name, {name}, large, noisy);
  };
  add_all_sizes("effect", inside);
  const auto add_in_turn = [&](const std::string& kind, const std::vector<std::string>& names, int count) {
    for (int i = 0; i < count && !names.empty(); ++i) {
      // Round by round: every cause with the plain scatter and with twice that.
      const std::size_t which = static_cast<std::size_t>(i) % names.size(),
                        turn = static_cast<std::size_t>(i) / names.size();
      const bool hides = !names[which].empty();
      add(kind, hides ? names[which] : "nothing", hides ? std::vector{names[which]} : std::vector<std::string>{}, true,
          turn % 2 == 1);
    }
  };
  add_in_turn("outside", outside, options.outside);
  RandomStream random(options.first_seed, "trials/doubles");
  for (int i = 0; i < options.doubles; ++i) {
    const int a = random.index(static_cast<int>(inside.size()));
    const int b = (a + 1 + random.index(static_cast<int>(inside.size()) - 1)) % static_cast<int>(inside.size());
    const std::string &first = inside[a], &second = inside[b];
    add("double", first + "+" + second, {first, second}, true, false);
  }
  const auto add_turns = [&](const std::string& kind, int count, const std::string& one, const std::string& other) {
    for (int i = 0; i < count; ++i) add(kind, i % 2 == 0 ? one : other, {i % 2 == 0 ? one : other}, true, false);
  };
  add_turns("alike", options.alike, "droplet_mixing", "rigid_overprint");
  for (const char* kind : {"pair", "resolved"}) add_turns(kind, options.pairs, "batch_drift", "rate_dependence");
  add_in_turn("form", forms, options.forms);
  add_all_sizes("even", even);
  for (int i = 0; i < options.distorted; ++i) add("distorted", "moduli", {}, i % 2 == 0, i / 2 % 2 == 1);
  add_in_turn("homogeneous", {"", "rate_power_law", "rate_dependence", "blend_law", "soft_rate_dependence"},
              options.homogeneous);
  add_in_turn("machines", {"", "compliance_of_one_machine", "gain_of_one_machine"}, options.machines);
  add_in_turn("loops", {"", "rigid_yield", "rate_dependence", "soft_rate_dependence"}, options.loops);
  add_in_turn("spectrum", {"", "rate_prony", "rate_power_law", "rate_dependence"}, options.spectra);
  add_in_turn("warm", {"", "rate_power_law", "rate_dependence"}, options.warm);
  std::uint64_t truth_seed = options.first_seed;
  const auto add_shared = [&](const std::string& what, std::vector<std::string> hidden, bool large) {
    add("fracture", what, std::move(hidden), large, false);
    trials.back().truth_seed = truth_seed;
  };
  for (int i = 0; i < options.fracture_nulls; ++i) {
    if (i > 0 && i % kNullsOfTruth == 0) ++truth_seed;
    add_shared("nothing", {}, true);
  }
  const std::vector<std::string> of_fracture = {"progressive_damage", "tension_only_failure", "strength_scatter",
                                                "blunt_notch",        "residual_strain",      "interface_anisotropy",
                                                "rigid_yield",        "soft_stiffening"};
  truth_seed = options.first_seed + 1000;
  for (const std::string& name : of_fracture)
    for (const bool large : {true, false}) {
      ++truth_seed;
      for (int i = 0; i < options.fracture_seeds; ++i) add_shared(name, {name}, large);
    }
  // The last, so that their number changes no other trial.
  for (const char* name : kSeenOnModuli)
    for (const double signal : kPowerSignals)
      for (int i = 0; i < options.power; ++i) {
        add("power", fmt::format("{}-{:g}", name, signal), {name}, true, false);
        trials.back().signal = signal;
      }
  return trials;
}

lab::Truth truth_of(const BlindTrial& trial, const TrialOptions& options) {
  const std::uint64_t seed = seed_of_truth(trial);
  lab::Truth truth{.seed = seed,
                   .fidelity = options.fidelity,
                   .replicates = kReplicates,
                   .noise = noise_of(trial),
                   .modulus = lab::draw_modulus_parameters(seed),
                   .coupons = lab::draw_coupon_ratios(seed),
                   .toughness = lab::draw_toughness_parameters(seed),
                   .effects = {}};
  if (is_broken(trial)) {
    const lab::Truth drawn = lab::draw_truth(seed, options.fidelity);
    truth.toughness = drawn.toughness, truth.criterion = drawn.criterion, truth.strength_cv = drawn.strength_cv;
  }
  for (const lab::EffectKind& kind : lab::effect_kinds()) {
    if (std::find(trial.hidden.begin(), trial.hidden.end(), kind.name) == trial.hidden.end()) continue;
    truth.effects.*kind.value = hidden_value(trial, kind);
    if (kind.second.value) truth.effects.*kind.second.value = lab::draw_second_value(seed, kind);
  }
  return truth;
}

std::vector<lab::Experiment> experiments_of(const BlindTrial& trial, const TrialOptions& options) {
  if (is_pair(trial)) return pulled_coupons(kPairFractions, kPairRates, options.fidelity);
  if (trial.kind == "loops") return unloaded_coupons(options.fidelity);
  if (is_tabulated(trial)) return tabulated_moduli(trial, options.fidelity);
  if (is_broken(trial)) return broken_designs(trial, options.fidelity);
  const std::uint64_t design = trial.seed % kDesigns;
  RandomStream random(design, "blind trials/design");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(kLayouts - 2, random);
  std::vector<lab::Experiment> experiments;
  std::vector<TestKind> tests = {TestKind::modulus};
  if (options.fracture) tests.push_back(TestKind::toughness);
  for (const TestKind test : tests) {
    const auto add = [&](const pattern::Design& layout, const tester::TestConditions& conditions) {
      experiments.push_back({.design = layout, .test = test, .conditions = conditions, .fidelity = options.fidelity});
    };
    for (const pattern::Pattern& each : patterns) add(each, {});
    if (is_upright(trial)) continue;
    for (int i = 0; i < kTwins; ++i) add(patterns[i], {.orientation_deg = 90.0});
    for (int i = kTwins; i < kTwins + 2; ++i) {
      tester::TestConditions faster, thinner;
      faster.strain_rate_per_s *= kSecondRate;
      thinner.thickness_mm *= kSecondThickness;
      add(patterns[i], faster);
      add(patterns[i + 2], thinner);
    }
    for (const int period : {2, 5}) add(pattern::checkerboard(period), {});
  }
  if (is_upright(trial)) return experiments;
  const double rate_per_s = tester::TestConditions{}.strain_rate_per_s,
               rates_per_s[] = {rate_per_s, kSecondRate * rate_per_s};
  const std::vector<lab::Experiment> coupons = pulled_coupons(kCouponFractions, rates_per_s, options.fidelity);
  experiments.insert(experiments.end(), coupons.begin(), coupons.end());
  return experiments;
}

namespace {

/// What a trial prints, in an order drawn from its seed.
Printed printed_by(const BlindTrial& trial, const TrialOptions& options, const lab::Truth& truth) {
  Printed printed{.experiments = experiments_of(trial, options), .responses = {}, .specimens = {}, .replicates = {}};
  printed.responses = is_broken(trial) ? responses_of_pool(trial, options, truth, printed.experiments)
                                       : lab::responses_to(truth, printed.experiments);
  printed.specimens = planned(trial, printed.experiments, printed.responses);
  std::vector<int> order(printed.specimens.size());
  std::iota(order.begin(), order.end(), 1);
  RandomStream random(trial.seed, "trial/print order");
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(static_cast<int>(i))]);
  for (std::size_t i = 0; i < order.size(); ++i) {
    printed.specimens[i].print_order = order[i];
    printed.replicates.push_back(replicate_of(trial, printed.specimens[i], i));
    if (is_broken(trial)) printed.replicates[i].number = drawn_from_pool(trial, i / kReplicates)[i % kReplicates];
  }
  return printed;
}

}  // namespace

void generate(const BlindTrial& trial, const TrialOptions& options, const fs::path& folder) {
  lab::Truth truth = truth_of(trial, options);
  Printed printed = printed_by(trial, options, truth);
  if (trial.signal > 0.0) {
    truth = sized_to(trial.signal, trial, options, truth, printed);
    printed = printed_by(trial, options, truth);
  }
  const std::string signals = fmt::format("\n[trial]\nname = \"{}\"\nkind = \"{}\"\n{}", trial.name, trial.kind,
                                          is_broken(trial) ? "" : signals_of(trial, options, truth, printed));
  lab::Truth scattering = truth;
  scattering.seed = trial.seed;
  std::vector<measurement::SpecimenRecord> records;
  for (std::size_t i = 0; i < printed.specimens.size(); ++i) {
    const std::size_t q = i / kReplicates;
    records.push_back(
        lab::record_specimen(scattering, printed.experiments[q], printed.responses[q], printed.replicates[i]));
  }
  if (trial.kind == "distorted") distort(trial, records);
  fs::create_directories(folder);
  measurement::write_measurement_set(folder / "set", records);
  write_file_atomically(folder / "set.truth.toml", lab::to_toml(truth) + signals);
}

void diagnose(const BlindTrial& trial, const TrialOptions& options, const fs::path& folder) {
  const std::string result = (folder / "diagnosis.json").string();
  const fs::path store =
      is_broken(trial) ? options.pools / fmt::format("design-{}.store", broken_design(trial)) : folder / "store";
  const std::string kept =
      is_broken(trial) ? fmt::format("--kept-emulator --params '{}/bench/blind_trials/fracture.toml'", NACRE_SOURCE_DIR)
                       : "";
  const std::string command =
      fmt::format("'{}' diagnose '{}' --fidelity {} --store '{}' {} --json > '{}.part' 2> '{}'", options.program,
                  (folder / "set").string(), tester::to_string(options.fidelity), store.string(), kept, result,
                  (folder / "log").string());
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw InputError::format("{}: nacre diagnose failed, see {}", folder.string(), (folder / "log").string());
  fs::rename(result + ".part", result);
}

void print_what_was_ordered(const BlindTrial& trial, const TrialOptions& options, const fs::path& folder) {
  const fs::path kept = folder / "first_diagnosis.json";
  fs::rename(folder / "diagnosis.json", kept);
  const lab::Truth truth = truth_of(trial, options);
  std::vector<measurement::SpecimenRecord> records = measurement::read_measurement_set(folder / "set").specimens;
  const auto diagnosis = nlohmann::json::parse(read_file(kept));
  for (const auto& ordered : diagnosis["next_experiments"]) {
    lab::Experiment experiment{.design = *pattern::design_from_name(ordered["design"].get<std::string>()),
                               .test = *tester::test_kind_from_string(ordered["test"].get<std::string>()),
                               .conditions = {},
                               .fidelity = options.fidelity,
                               .loading = tester::loading_from_string(ordered["loading"].get<std::string>()).value()};
    experiment.conditions = {.orientation_deg = ordered["orientation_deg"],
                             .strain_rate_per_s = ordered["strain_rate_per_s"],
                             .thickness_mm = ordered["thickness_mm"]};
    const Result<lab::TrueResponse> response = lab::respond(truth, experiment);
    for (int i = 0; i < ordered["replicates"]; ++i) {
      const std::string number = std::to_string(records.size() + 1);
      records.push_back(lab::record_specimen(
          truth, experiment, response,
          {.specimen = "ordered-" + number, .batch = "batch-3", .print_order = static_cast<int>(records.size()) + 1}));
    }
  }
  measurement::write_measurement_set(folder / "set", records);
}

}  // namespace nacre::blind_trials
