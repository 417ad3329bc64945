#include "diagnosis/crack_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "pattern/random_pattern.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

constexpr int kOfEachDesign = 4;
constexpr double kOfCracks = 0.06, kOfSpecimens = 0.03, kGrowth = 0.2;

/// A triangle of this area that separates at 5 % strain.
tester::Curve pulled_until(double toughness_pa) {
  const double peak = 2.0 * toughness_pa / 0.05;
  return {{0.0, 0.0125, 0.025, 0.0375, 0.05, 0.0501}, {0.0, 0.25 * peak, 0.5 * peak, 0.75 * peak, peak, 0.0}};
}

/// Replicates of a design whose cracks scatter by `of_cracks` beside what scales all their stresses.
void add_replicates(std::vector<measurement::SpecimenRecord>& specimens, const pattern::Design& design,
                    double of_cracks, RandomStream& chance) {
  for (int k = 0; k < kOfEachDesign; ++k) {
    measurement::SpecimenRecord specimen;
    specimen.design = design;
    specimen.specimen = design.name() + "-" + std::to_string(k);
    specimen.test = tester::TestKind::toughness;
    const double stresses = std::exp(12.0 + kOfSpecimens * chance.normal());
    specimen.curve = pulled_until(stresses);
    specimen.toughness_pa = stresses * std::exp(of_cracks * chance.normal());
    specimens.push_back(std::move(specimen));
  }
}

std::vector<measurement::SpecimenRecord> broken_layouts(double of_cracks) {
  RandomStream drawn(7, "test/patterns"), chance(7, "test/noise");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const pattern::Pattern& layout : pattern::stratified_patterns(60, drawn))
    add_replicates(specimens, layout, of_cracks, chance);
  return specimens;
}

/// Layouts that the simulator breaks with cracks of this scatter.
std::vector<RefinedLayout> simulated_layouts(const Observations& observations) {
  RandomStream chance(8, "test/noise");
  std::vector<RefinedLayout> layouts;
  for (const Observation& group : observations.groups) {
    layouts.push_back({.design = group.design, .coarse = {}, .fine = {}});
    for (int k = 0; k < kOfEachDesign; ++k) {
      layouts.back().coarse.emplace_back();
      value_of(layouts.back().coarse.back(), Feature::log_toughness) = 12.0 + kOfCracks * chance.normal();
    }
  }
  return layouts;
}

/// Runs about the centre, and some with scattering voxels, whose cracks scatter more.
std::vector<FractureRun> runs_of(const Observations& observations) {
  RandomStream chance(9, "test/noise");
  std::vector<FractureRun> runs;
  for (int k = 0; k < 60; ++k) {
    FractureRun run{material::default_parameters(), {}};
    material::ToughnessVector eta = to_vector(run.parameters.toughness);
    for (const std::size_t i : sysid::kSearchedEta) eta[i] *= std::exp(0.2 * chance.normal());
    run.parameters.toughness = material::toughness_from_vector(eta);
    const double variation = k < 40 ? 0.0 : 0.1 + 0.01 * (k - 40);
    if (variation > 0.0) run.parameters.extensions.emplace(kStrengthScatter, std::vector{variation});
    const double sd = std::sqrt(kOfCracks * kOfCracks + kGrowth * variation * variation);
    for (std::size_t g = 0; g < observations.groups.size(); ++g) {
      const double toughness_pa = std::exp(12.0 + sd * chance.normal());
      run.predictions.push_back({.modulus_pa = {}, .toughness_pa = toughness_pa, .curve = pulled_until(toughness_pa)});
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

struct Scattering {
  Observations observations;
  std::optional<CrackScatter> scatter;
};

Scattering scattering(double of_cracks) {
  Observations observations = observe(broken_layouts(of_cracks), 0.0, {}, {});
  const FractureSurface surface(observations, fracture_groups(observations).groups, runs_of(observations),
                                material::default_parameters().toughness, {});
  const auto scatter = crack_scatter(observations, simulated_layouts(observations), surface, {});
  return {std::move(observations), scatter};
}

TEST(CrackScatter, IsThatOfCracksAndOfSpecimens) {
  const auto [observations, scatter] = scattering(kOfCracks);
  ASSERT_TRUE(scatter);
  EXPECT_NEAR(std::sqrt(scatter->of_cracks), kOfCracks, 0.006);
  EXPECT_NEAR(std::sqrt(scatter->of_specimens), kOfSpecimens, 0.003);
  EXPECT_NEAR(scatter->growth, kGrowth, 0.4 * kGrowth);
  EXPECT_NEAR(std::exp(scatter->log_sd(0.0)), std::hypot(kOfCracks, kOfSpecimens), 0.006);
  EXPECT_NEAR(scatter->log_sd(0.0),
              std::log(observations.replicate_sd(Feature::log_toughness, tester::TestKind::toughness)),
              2.0 * std::sqrt(scatter->error_variance));
}

TEST(CrackScatter, OfVoxelsThatScatterStandsOut) {
  constexpr double kVariation = 0.5;
  Scattering more = scattering(std::sqrt(kOfCracks * kOfCracks + kGrowth * kVariation * kVariation));
  ASSERT_TRUE(more.scatter);
  put_crack_scatter(more.observations, *more.scatter);
  const DataRow& row = more.observations.rows.back();
  EXPECT_EQ(row.kind, RowKind::scatter);
  const Eigen::Index last = more.observations.size() - 1;
  const double sd = std::sqrt(more.observations.covariance()(last, last));
  EXPECT_GT(more.observations.values[last] - more.scatter->log_sd(0.0), 4.0 * sd);
  EXPECT_NEAR(more.observations.values[last], more.scatter->log_sd(kVariation), 2.0 * sd);
}

TEST(CrackScatter, IsNoDatumWithoutReplicates) {
  std::vector<measurement::SpecimenRecord> specimens = broken_layouts(kOfCracks);
  std::erase_if(specimens, [](const auto& specimen) { return !specimen.specimen.ends_with("-0"); });
  const Observations observations = observe(specimens, 0.0, {}, {});
  const FractureSurface surface(observations, fracture_groups(observations).groups, runs_of(observations),
                                material::default_parameters().toughness, {});
  EXPECT_FALSE(crack_scatter(observations, simulated_layouts(observations), surface, {}));
}

// A crack has one way through a homogeneous specimen: its scatter is not that of layouts, whose level it would lower.
TEST(CrackScatter, HomogeneousSpecimensHaveTheirOwn) {
  std::vector<measurement::SpecimenRecord> specimens = broken_layouts(kOfCracks);
  const double alone =
      observe(specimens, 0.0, {}, {}).replicate_sd(Feature::log_toughness, tester::TestKind::toughness);
  RandomStream chance(10, "test/noise");
  for (const double rigid_fraction : {0.0, 0.25, 0.5, 0.75, 1.0})
    add_replicates(specimens, pattern::Mixture{rigid_fraction}, 0.01, chance);
  const Observations both = observe(specimens, 0.0, {}, {});
  EXPECT_EQ(both.replicate_sd(Feature::log_toughness, tester::TestKind::toughness), alone);
  const auto of_homogeneous = std::ranges::find_if(
      both.rows, [&](const DataRow& row) { return row.group >= 0 && is_notched_bulk(both.groups[row.group]); });
  ASSERT_NE(of_homogeneous, both.rows.end());
  const auto f = static_cast<Eigen::Index>(Feature::log_toughness);
  EXPECT_NEAR(std::sqrt(both.scatter[of_homogeneous->scatter].covariance(f, f)), std::hypot(0.01, kOfSpecimens), 0.012);
}

}  // namespace
}  // namespace nacre::diagnosis
