#include "diagnosis/fracture_surface.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "material/extensions.hpp"
#include "pattern/random_pattern.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

Eigen::VectorXd size(double strength) { return Eigen::VectorXd::Constant(1, strength); }

TEST(EffectCovariance, VanishesWithTheEffect) {
  EXPECT_NEAR(effect_covariance(size(0.0), size(0.4), {}), 0.0, 1e-15);
  EXPECT_NEAR(effect_covariance(size(-0.4), size(0.0), {}), 0.0, 1e-15);
}

TEST(EffectCovariance, IsTheSameForBothSignsAndBothOrders) {
  EXPECT_DOUBLE_EQ(effect_covariance(size(-0.3), size(-0.6), {}), effect_covariance(size(0.3), size(0.6), {}));
  EXPECT_DOUBLE_EQ(effect_covariance(size(0.1), size(0.6), {}), effect_covariance(size(0.6), size(0.1), {}));
}

// With effects of either sign the variance once came out below zero, and every emulated feature as no number.
TEST(EffectCovariance, OfSizesOfEitherSignIsACovariance) {
  const std::vector<double> sizes = {-0.6, -0.3, -0.1, 0.1, 0.3, 0.6};
  Eigen::MatrixXd matrix(6, 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) matrix(i, j) = effect_covariance(size(sizes[i]), size(sizes[j]), {});
  EXPECT_GT(matrix.diagonal().minCoeff(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(), 0.0);
}

constexpr int kLayouts = 24;
constexpr double kScatter = 0.1;

/// A triangle of this area that separates at 5 % strain.
tester::Curve curve_of_area(double toughness_pa) {
  tester::Curve curve;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    curve.strain.push_back(0.05 * share);
    curve.stress_pa.push_back(2.0 * toughness_pa / 0.05 * share);
  }
  curve.strain.push_back(0.0501);
  curve.stress_pa.push_back(0.0);
  return curve;
}

sysid::Prediction broken(double log_toughness) {
  return {.modulus_pa = {}, .toughness_pa = std::exp(log_toughness), .curve = curve_of_area(std::exp(log_toughness))};
}

/// Expected log T of a layout: linear in eta, with slopes of its own.
double expected(int layout, const material::ParameterSet& set) {
  const material::ToughnessVector eta = to_vector(set.toughness),
                                  centre = to_vector(material::default_parameters().toughness);
  double sum = 12.0 + 0.1 * layout;
  for (const std::size_t k : sysid::kSearchedEta)
    sum += 0.2 * std::cos(static_cast<double>(layout) + static_cast<double>(k)) * std::log(eta[k] / centre[k]);
  return sum;
}

material::ParameterSet moved(RandomStream& random, double spread) {
  material::ParameterSet set = material::default_parameters();
  material::ToughnessVector eta = to_vector(set.toughness);
  for (const std::size_t k : sysid::kSearchedEta) eta[k] *= std::exp(spread * random.normal());
  set.toughness = material::toughness_from_vector(eta);
  return set;
}

/// One notched specimen of every layout, and a run of every layout per parameter set, each crack with chance of its
/// own.
struct Broken {
  Observations observations;
  std::vector<int> groups;
  std::vector<FractureRun> runs;
};
using Expected = double (*)(int layout, const material::ParameterSet&);
Broken broken_layouts(Expected log_toughness, int runs) {
  RandomStream drawn(5, "test/patterns"), chance(5, "test/noise");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const pattern::Pattern& layout : pattern::stratified_patterns(kLayouts, drawn)) {
    measurement::SpecimenRecord specimen;
    specimen.design = layout;
    specimen.specimen = specimen.design.name();
    specimen.test = tester::TestKind::toughness;
    specimen.toughness_pa = std::exp(12.0);
    specimen.curve = curve_of_area(*specimen.toughness_pa);
    specimens.push_back(specimen);
  }
  Broken broken_set{observe(specimens, 0.0, {}, {}), {}, {}};
  for (int g = 0; g < kLayouts; ++g) broken_set.groups.push_back(g);
  for (int k = 0; k < runs; ++k) {
    FractureRun run{moved(chance, 0.3), {}};
    for (int g = 0; g < kLayouts; ++g)
      run.predictions.push_back(broken(log_toughness(g, run.parameters) + kScatter * chance.normal()));
    broken_set.runs.push_back(std::move(run));
  }
  return broken_set;
}

// What the emulator promises of its error is that of the expectation, which it averages from many cracks, and not the
// scatter of a crack.
TEST(FractureSurface, KnowsTheErrorOfTheMeanOverCracks) {
  const Broken layouts = broken_layouts(expected, 40);
  const FractureSurface surface(layouts.observations, layouts.groups, layouts.runs,
                                material::default_parameters().toughness, {});
  double of_mean = 0.0, of_run = 0.0, error = 0.0;
  int count = 0;
  RandomStream random(6, "test/points");
  for (std::size_t r = 0; r < surface.rows().size(); ++r) {
    if (surface.rows()[r].feature != Feature::log_toughness) continue;
    of_run += surface.run_variance()[static_cast<Eigen::Index>(r)] / kLayouts;
  }
  for (int point = 0; point < 10; ++point) {
    const material::ParameterSet set = moved(random, 0.2);
    const Eigen::VectorXd predicted = surface.predict(set), variance = surface.error_of_mean(set).variance();
    for (std::size_t r = 0; r < surface.rows().size(); ++r) {
      if (surface.rows()[r].feature != Feature::log_toughness) continue;
      error += std::pow(predicted[static_cast<Eigen::Index>(r)] - expected(surface.rows()[r].group, set), 2);
      of_mean += variance[static_cast<Eigen::Index>(r)];
      ++count;
    }
  }
  error /= count;
  of_mean /= count;
  ASSERT_EQ(count, 10 * kLayouts);
  EXPECT_NEAR(std::sqrt(of_run), std::sqrt(kScatter * kScatter + error), 0.03) << "a crack scatters about the mean";
  EXPECT_LT(of_mean, 0.5 * of_run);
  EXPECT_GT(of_mean / error, 0.5) << "promised " << of_mean << ", true " << error;
  EXPECT_LT(of_mean / error, 2.5) << "promised " << of_mean << ", true " << error;
}

constexpr double kBend = 0.6;

/// The same, and every layout bends alike.
double bent(int layout, const material::ParameterSet& set) {
  const double damping = std::log(set.toughness.gamma_per_s / material::default_parameters().toughness.gamma_per_s);
  return expected(layout, set) + kBend * damping * damping;
}

/// Of the mean over layouts: mean square error, and the variance that the emulator promises.
struct MeanOverLayouts {
  double error = 0.0, promised = 0.0;
};
MeanOverLayouts mean_over_layouts(const Broken& layouts, const EmulatorRules& rules) {
  const FractureSurface surface(layouts.observations, layouts.groups, layouts.runs,
                                material::default_parameters().toughness, rules);
  RandomStream random(7, "test/points");
  MeanOverLayouts all;
  constexpr int kPoints = 20;
  for (int point = 0; point < kPoints; ++point) {
    const material::ParameterSet set = moved(random, 0.25);
    const Eigen::VectorXd predicted = surface.predict(set);
    const ErrorOfMean error = surface.error_of_mean(set);
    double mean = 0.0, own = 0.0;
    Eigen::RowVectorXd shared = Eigen::RowVectorXd::Zero(error.shared.cols());
    for (std::size_t r = 0; r < surface.rows().size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      if (surface.rows()[r].feature != Feature::log_toughness) continue;
      mean += (predicted[row] - bent(surface.rows()[r].group, set)) / kLayouts;
      own += error.own[row] / (kLayouts * kLayouts);
      shared += error.shared.row(row) / kLayouts;
    }
    all.error += mean * mean / kPoints;
    all.promised += (own + shared.squaredNorm()) / kPoints;
  }
  return all;
}

// A bend that is lost in the scatter of one layout's cracks is plain in the mean over layouts. An emulator that smooths
// it is wrong by as much in all of them, which a diagnosis then takes for a cause.
TEST(FractureSurface, SeesAndVouchesForWhatAllLayoutsDoAlike) {
  const Broken layouts = broken_layouts(bent, 60);
  EmulatorRules one_by_one;
  one_by_one.components = 0;
  const MeanOverLayouts alike = mean_over_layouts(layouts, {}), apart = mean_over_layouts(layouts, one_by_one);
  EXPECT_LT(alike.error, 0.7 * apart.error);
  EXPECT_GT(alike.promised / alike.error, 0.4) << "promised " << alike.promised << ", true " << alike.error;
  EXPECT_LT(alike.promised / alike.error, 5.0) << "promised " << alike.promised << ", true " << alike.error;
  EXPECT_LT(apart.promised / apart.error, 0.5) << "promised " << apart.promised << ", true " << apart.error;
}

/// Of layouts under one effect, by how much an emulator is wrong about it at a place, and how wrong it says it is.
struct ErrorOfEffect {
  double error = 0.0, promised = 0.0;
};
ErrorOfEffect error_of_effect(Expected log_toughness, const material::ParameterSet& at, bool learns_there) {
  Broken layouts = broken_layouts(log_toughness, 60);
  RandomStream random(8, "test/effect");
  const auto run = [&](const material::ParameterSet& set) {
    FractureRun run{set, {}};
    for (int g = 0; g < kLayouts; ++g)
      run.predictions.push_back(broken(log_toughness(g, set) + kScatter * random.normal()));
    layouts.runs.push_back(std::move(run));
  };
  for (const double size : {0.005, 0.01, 0.0175, 0.025}) {
    material::ParameterSet set = moved(random, 0.3);
    set.extensions["blunt_notch"] = {size};
    run(set);
  }
  if (learns_there) run(at);
  const FractureSurface surface(layouts.observations, layouts.groups, layouts.runs,
                                material::default_parameters().toughness, {});
  const Eigen::VectorXd predicted = surface.predict(at), variance = surface.error_of_mean(at).variance();
  ErrorOfEffect all;
  for (std::size_t r = 0; r < surface.rows().size(); ++r) {
    if (surface.rows()[r].feature != Feature::log_toughness) continue;
    const auto row = static_cast<Eigen::Index>(r);
    all.error += std::pow(predicted[row] - log_toughness(surface.rows()[r].group, at), 2) / kLayouts;
    all.promised += variance[row] / kLayouts;
  }
  return all;
}

/// The centre with the damping changed by this factor and a round notch.
material::ParameterSet blunt_at(double damping) {
  material::ParameterSet set = material::default_parameters();
  set.toughness.gamma_per_s *= damping;
  set.extensions["blunt_notch"] = {0.025};
  return set;
}

/// What the notch does, of either sign between layouts, turns with the damping.
double turning(int layout, const material::ParameterSet& set) {
  const double damping = std::log(set.toughness.gamma_per_s / material::default_parameters().toughness.gamma_per_s);
  return expected(layout, set) +
         20.0 * material::extension_value(set.extensions, "blunt_notch") * std::sin(layout + 3.0 * damping);
}

// An effect that depends on where cracks go is known where it was run, and the error elsewhere is promised.
TEST(FractureSurface, AnEffectThatTurnsWithEtaIsKnownWhereItWasRun) {
  const material::ParameterSet at = blunt_at(1.6);
  const ErrorOfEffect far = error_of_effect(turning, at, false), near = error_of_effect(turning, at, true);
  EXPECT_LT(near.error, 0.3 * far.error);
  EXPECT_LT(std::sqrt(near.error), 1.5 * kScatter);
  for (const ErrorOfEffect& one : {far, near}) {
    EXPECT_GT(one.promised / one.error, 0.3) << "promised " << one.promised << ", true " << one.error;
    EXPECT_LT(one.promised / one.error, 3.0) << "promised " << one.promised << ", true " << one.error;
  }
}

// Four runs scatter: what chance did to single layouts is no effect.
TEST(FractureSurface, AnEffectThatDoesNothingIsLearntAsNone) {
  const ErrorOfEffect none = error_of_effect(expected, blunt_at(1.0), false);
  EXPECT_LT(std::sqrt(none.error), 0.5 * kScatter);
}

}  // namespace
}  // namespace nacre::diagnosis
