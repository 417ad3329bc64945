#include "diagnosis/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "base/parallel.hpp"
#include "diagnosis/test_choice.hpp"
#include "measurement/reduction.hpp"
#include "pattern/coupons.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

constexpr double kSecondRate = 10.0, kSecondThickness = 0.5;
constexpr int kConditionTwins = 3;      // designs of a test that are also tested under other conditions
constexpr double kCouponStrain = 0.02;  // said in the words of possible_tests()

/// Scatter where nothing was measured of a test: a logarithm's, and a strain's.
constexpr double kUsualSd = 0.03, kUsualStrainSd = 5e-4;

double noise_sd(const Observations& observations, TestKind test, Feature feature, int replicates) {
  double sd = observations.has(test) ? observations.replicate_sd(feature, test) : 0.0;
  if (!(sd > 0.0)) sd = feature == Feature::toe_strain ? kUsualStrainSd : kUsualSd;
  double variance = sd * sd / replicates;
  if (test == TestKind::modulus) variance += observations.numerics_sd * observations.numerics_sd;
  if (test == TestKind::toughness)
    variance += observations.fracture_numerics.covariance(feature, feature, 0.0, 0.0, true);
  return std::sqrt(variance);
}

/// Whether E of what a homogeneous coupon consists of is still anybody's guess: none of it has been pulled.
bool is_of_unknown_stiffness(const PossibleTest& test, const Observations& observations) {
  return test.design.mixture() != nullptr &&
         std::ranges::none_of(observations.groups, [&](const Observation& g) { return g.design == test.design; });
}

/// How far apart two models see a test. Where the stiffness is unknown it is fitted to either, and what is left to tell
/// them apart is the shape of the curve.
Separation separation_of(const FeatureValues& one, const FeatureValues& other, const PossibleTest& test,
                         const Observations& observations, int replicates) {
  const auto &own_slope = value_of(one, Feature::log_tangent_30),
             &other_slope = value_of(other, Feature::log_tangent_30);
  const bool fitted = is_of_unknown_stiffness(test, observations) && own_slope && other_slope;
  const double scale = fitted ? *own_slope - *other_slope : 0.0;
  Separation best;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    if (!one[f] || !other[f]) continue;
    const auto feature = static_cast<Feature>(f);
    const double apart = *one[f] - *other[f] - (is_curve_stress(feature) ? scale : 0.0);
    const double errors = std::abs(apart) / noise_sd(observations, test.test, feature, replicates);
    if (errors > best.errors) best = {errors, feature};
  }
  return best;
}

/// Groups of layouts that are not coupons, those of most replicates first.
std::vector<const Observation*> layouts_most_measured_first(const Observations& observations) {
  std::vector<const Observation*> groups;
  for (const Observation& g : observations.groups)
    if (g.design.layout() && g.test != TestKind::tensile) groups.push_back(&g);
  std::ranges::stable_sort(groups, std::greater<>(), &Observation::replicates);
  return groups;
}

/// A pull to 2 % strain, back to 0.5 % and on to 2.2 %: what homogeneous coupons are ordered with.
tester::Loading coupon_loading() { return {{kCouponStrain, 0.005, 0.022}}; }

/// What a model predicts of a test, one value per feature that says something.
FeatureValues predicted_features(const PossibleTest& test, const CoordinateMap& map, const Eigen::VectorXd& u,
                                 tester::Fidelity fidelity) {
  const material::ParameterSet set = test.design.layout() ? map.parameters(u) : map.coupon_parameters(u);
  const tester::Simulation simulation{test.design, set, test.conditions, fidelity};
  FeatureValues values;
  if (test.test == TestKind::modulus) {
    if (const auto result = tester::test_modulus(simulation))
      value_of(values, Feature::log_modulus) =
          std::log(measurement::observe_modulus(result->modulus_pa, set.extensions));
  } else if (test.test == TestKind::tensile) {
    if (const auto curve = coupon_through_machine(simulation, unload_history())) values = tensile_features(*curve);
  } else if (auto result = tester::test_toughness({test.design, simulated_side(set), test.conditions, fidelity})) {
    sysid::Prediction prediction;
    prediction.toughness_pa = result->toughness_pa;
    prediction.curve = tester::resampled(measurement::forward_part(result->curve), 128);
    values = shown_features(prediction, set.extensions);
  }
  return values;
}

/// Turned twins of all layouts; faster and thinner ones of the most measured of each test.
std::vector<PossibleTest> twins(const Observations& observations) {
  std::vector<PossibleTest> possible;
  const std::vector<const Observation*> layouts = layouts_most_measured_first(observations);
  std::map<TestKind, int> twins_of;
  for (const Observation* g : layouts) {
    const auto twin = [&](std::string_view words) -> tester::TestConditions& {
      possible.push_back({AddedTest::twin, g->design, g->test, g->conditions, std::string(words)});
      return possible.back().conditions;
    };
    const double orientation_deg = g->conditions.orientation_deg;
    twin("a twin printed turned by 90 degrees").orientation_deg = orientation_deg == 0.0 ? 90.0 : 0.0;
    if (g->conditions != usual_conditions(observations, g->test) || twins_of[g->test]++ >= kConditionTwins) continue;
    twin("a twin pulled ten times as fast").strain_rate_per_s *= kSecondRate;
    twin("a twin of half the thickness").thickness_mm *= kSecondThickness;
  }
  return possible;
}

std::vector<PossibleTest> layout_coupons(TestKind test, const tester::TestConditions& conditions) {
  std::vector<PossibleTest> possible;
  const auto laminate = [&](pattern::LayerDirection direction, int period, std::string_view way) {
    possible.push_back({AddedTest::laminate, pattern::laminate(direction, period, period), test, conditions,
                        fmt::format("a laminate of period {} {} the pull", period, way)});
  };
  for (const int period : {1, 2, 5}) {
    possible.push_back({AddedTest::checkerboard, pattern::checkerboard(period), test, conditions,
                        fmt::format("a checkerboard of period {}", period)});
    laminate(pattern::LayerDirection::along_x, period, "across");
    laminate(pattern::LayerDirection::along_y, period, "along");
  }
  return possible;
}

std::vector<PossibleTest> homogeneous_coupons(const tester::TestConditions& conditions) {
  std::vector<PossibleTest> possible;
  for (const double fraction : {1.0, 0.5, 0.0}) {
    for (const double factor : {1.0, kSecondRate}) {
      const std::string speed = factor > 1.0 ? "ten times as fast " : "";
      possible.push_back({AddedTest::homogeneous, pattern::Mixture{fraction}, TestKind::tensile, conditions,
                          "a homogeneous coupon pulled " + speed + "to 2 % strain, back to 0.5 % and on"});
      possible.back().conditions.strain_rate_per_s *= factor;
    }
  }
  return possible;
}

}  // namespace

std::vector<double> unload_history() {
  constexpr double kStep = kCouponStrain / 40.0;
  return tester::strain_path(coupon_loading(), kStep);
}

bool answers(const PossibleTest& test, const Observation& group) {
  return test.design == group.design && test.test == group.test && test.conditions == group.conditions &&
         (test.test != TestKind::tensile || group.unloaded);
}

std::vector<PossibleTest> possible_tests(const Observations& observations) {
  std::set<std::string> taken;
  const auto name_of = [](const PossibleTest& t) {
    return fmt::format("{}/{}/{}/{:.2g}/{:.2g}", t.design.name(), tester::to_string(t.test),
                       t.conditions.orientation_deg, t.conditions.strain_rate_per_s, t.conditions.thickness_mm);
  };
  for (const Observation& g : observations.groups) {
    const PossibleTest measured{{}, g.design, g.test, g.conditions, ""};
    if (answers(measured, g)) taken.insert(name_of(measured));
  }
  std::vector<PossibleTest> possible = twins(observations);
  for (const TestKind test : {TestKind::modulus, TestKind::toughness})
    if (std::ranges::any_of(observations.groups,
                            [&](const Observation& g) { return g.test == test && g.design.layout(); }))
      std::ranges::move(layout_coupons(test, usual_conditions(observations, test)), std::back_inserter(possible));
  std::ranges::move(homogeneous_coupons(usual_conditions(observations, TestKind::tensile)),
                    std::back_inserter(possible));
  std::erase_if(possible, [&](const PossibleTest& test) { return !taken.insert(name_of(test)).second; });
  return possible;
}

std::vector<NextExperiment> next_experiments(const std::vector<Fit>& models, const FeatureModel& model,
                                             const Observations& observations, tester::Fidelity fidelity, int count,
                                             int replicates) {
  if (models.size() < 2) return {};
  std::vector<PossibleTest> tests = possible_tests(observations);
  // Where moduli are measured too, only turned, faster and thinner twins are worth a fracture test: the others say the
  // same for less.
  if (observations.has(TestKind::modulus))
    std::erase_if(tests,
                  [](const PossibleTest& t) { return t.test == TestKind::toughness && t.kind != AddedTest::twin; });
  std::vector<std::vector<FeatureValues>> predicted(tests.size(), std::vector<FeatureValues>(models.size()));
  parallel_for(static_cast<int>(tests.size() * models.size()), [&](int job) {
    const std::size_t t = static_cast<std::size_t>(job) / models.size(),
                      m = static_cast<std::size_t>(job) % models.size();
    predicted[t][m] = predicted_features(tests[t], model.map(models[m].effects), models[m].u, fidelity);
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t b = 1; b < models.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  std::vector<TestValue> values;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    values.push_back({tests[t].words, {}});
    for (const auto& [a, b] : pairs)
      values.back().pairs.push_back(
          separation_of(predicted[t][a], predicted[t][b], tests[t], observations, replicates));
  }
  std::vector<NextExperiment> experiments;
  for (const TestChoice& choice : choose_tests(values, count)) {
    const PossibleTest& test = tests[choice.test];
    const Separation& separation = values[choice.test].pairs[choice.pair];
    const auto& [a, b] = pairs[choice.pair];
    const tester::Loading loading = test.test == TestKind::tensile ? coupon_loading() : tester::Loading{};
    experiments.push_back({test.design, test.test, test.conditions, replicates, loading,
                           fmt::format("{}: its {} separates {} from {} by {:.1f} standard errors", test.words,
                                       in_words(separation.feature), in_words(models[a].effects),
                                       in_words(models[b].effects), separation.errors)});
  }
  return experiments;
}

}  // namespace nacre::diagnosis
