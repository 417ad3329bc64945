#include "diagnosis/discrepancy_model.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

std::vector<measurement::SpecimenRecord> specimens() {
  SyntheticSet set;
  set.patterns = 8;
  set.twins = 2;
  return synthetic_specimens(set, synthetic_truth());
}

TEST(DiscrepancyTest, ItsVarianceIsThatOfTheNoiseOnAverage) {
  const Observations observations = observe(specimens(), 0.003, {}, {});
  const Eigen::MatrixXd noise = observations.covariance();
  const auto directions = contrast_directions(observations, observations.values);
  ASSERT_GT(directions.size(), 5u);
  const Eigen::MatrixXd unit = discrepancy_covariance(observations, directions, noise, 0.5);
  double own = 0.0, wanted = 0.0;
  for (int i = 0; i < observations.size(); ++i)
    if (observations.rows[i].kind == RowKind::mean) own += unit(i, i), wanted += noise(i, i);
  EXPECT_NEAR(own, wanted, 1e-9 * wanted);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(unit);
  EXPECT_GT(parts.eigenvalues().minCoeff(), -1e-12);
}

// A layout and its turned twin are one design: an unmodelled cause that acts on the design acts on both.
TEST(DiscrepancyTest, TwinsShareWhatADesignHasOfItsOwn) {
  const Observations observations = observe(specimens(), 0.003, {}, {});
  const Eigen::MatrixXd unit = discrepancy_covariance(observations, {}, observations.covariance(), 0.5);
  int twins = 0;
  for (int i = 0; i < observations.size(); ++i) {
    for (int j = 0; j < i; ++j) {
      const DataRow &a = observations.rows[i], &b = observations.rows[j];
      if (a.kind != RowKind::mean || b.kind != RowKind::mean) continue;
      const bool same = observations.group_of(i).design == observations.group_of(j).design;
      twins += same;
      if (same)
        EXPECT_NEAR(unit(i, j), unit(i, i), 1e-12);
      else
        EXPECT_EQ(unit(i, j), 0.0);
    }
  }
  EXPECT_EQ(twins, 2);
}

// The rest of a signature of collinearity 0.8 is just visible where names begin.
TEST(DiscrepancyTest, ANameBeginsWhereACollinearEffectIsSeen) {
  const NameRules rules;
  EXPECT_NEAR(rules.nameable_signal() * std::sqrt(1.0 - 0.8 * 0.8), rules.visible_signal, 1e-12);
}

}  // namespace
}  // namespace nacre::diagnosis
