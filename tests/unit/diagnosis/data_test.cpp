#include "diagnosis/data.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

/// A straight curve to failure, as stiff and as tough as the rigid material's constants say.
tester::Curve straight_curve(const material::ToughnessParameters& constants) {
  const double peak = std::sqrt(constants.w_vw_j_per_m3 * constants.e_vw_pa), failure = peak / constants.e_vw_pa;
  return {{0.0, 0.25 * failure, 0.5 * failure, 0.75 * failure, failure, 1.01 * failure},
          {0.0, 0.25 * peak, 0.5 * peak, 0.75 * peak, peak, 0.0}};
}

measurement::SpecimenRecord notched(const pattern::Design& design, const tester::Curve& curve) {
  measurement::SpecimenRecord specimen;
  specimen.design = design;
  specimen.specimen = design.name();
  specimen.test = tester::TestKind::toughness;
  specimen.curve = curve;
  specimen.toughness_pa = tester::area_under(curve);
  return specimen;
}

/// Of specimens that all break as the rigid material does.
Data data_of_designs(const std::vector<pattern::Design>& designs) {
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  std::vector<measurement::SpecimenRecord> specimens;
  for (const pattern::Design& design : designs)
    specimens.push_back(notched(design, straight_curve(settings.start.toughness)));
  settings.fractures.emplace();
  RandomStream chance(3, "test/noise");
  for (int k = 0; k < 30; ++k) {
    FractureRun run{settings.start, {}};
    material::ToughnessVector eta = to_vector(run.parameters.toughness);
    for (const std::size_t i : sysid::kSearchedEta) eta[i] *= std::exp(0.2 * chance.normal());
    run.parameters.toughness = material::toughness_from_vector(eta);
    const tester::Curve curve = straight_curve(run.parameters.toughness);
    run.predictions.assign(designs.size(),
                           {.modulus_pa = {}, .toughness_pa = tester::area_under(curve), .curve = curve});
    settings.fractures->runs.push_back(std::move(run));
  }
  return data_of(specimens, settings);
}

std::vector<pattern::Design> some_layouts() {
  RandomStream drawn(3, "test/patterns");
  std::vector<pattern::Design> designs;
  for (const pattern::Pattern& layout : pattern::stratified_patterns(6, drawn)) designs.emplace_back(layout);
  return designs;
}

// The constants of layouts are effective ones (thesis 3.2.4): a homogeneous specimen that differs from them as its kind
// does contradicts nothing.
TEST(NotchedHomogeneousSpecimens, BesideLayoutsMayHaveConstantsOfTheirOwn) {
  std::vector<pattern::Design> designs = some_layouts();
  designs.emplace_back(pattern::Mixture{1.0});
  const Data data = data_of_designs(designs);
  const Observations& all = data.observations;
  ASSERT_EQ(all.bulk_constants.rows(), all.size());
  for (int i = 0; i < all.size(); ++i) {
    const bool homogeneous = is_notched_bulk(all.group_of(i));
    if (!homogeneous) EXPECT_TRUE(all.bulk_constants.row(i).isZero()) << i;
    if (!homogeneous || all.rows[i].feature != Feature::log_tangent_30) continue;
    EXPECT_NEAR(all.bulk_constants.row(i).norm(), all.constant_sd, 0.2 * all.constant_sd) << "E of the rigid material";
  }
}

TEST(NotchedHomogeneousSpecimens, AloneTellTheConstants) {
  const Data data = data_of_designs({pattern::Mixture{0.0}, pattern::Mixture{0.5}, pattern::Mixture{1.0}});
  EXPECT_EQ(data.observations.bulk_constants.size(), 0);
  EXPECT_EQ(data.fracture_groups.size(), 3u);
}

}  // namespace
}  // namespace nacre::diagnosis
