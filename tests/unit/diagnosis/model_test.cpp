#include "diagnosis/model.hpp"

#include <gtest/gtest.h>

#include "diagnosis/data.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

// A coupon of one material does not depend on the constants of another, nor on an effect of another phase: it is not
// pulled again for them, and must show the same as if it were.
TEST(FeatureModel, SlopesAreDifferencesOfPredictions) {
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  const Data data = data_of(synthetic_coupons(synthetic_truth(), {1e-3, 1e-1}, 1, 0.01, 3), settings);
  const std::vector<std::vector<std::string>> models = {{},
                                                        {"rigid_yield", "toe_slack"},
                                                        {"rate_by_phase"},
                                                        {"rate_power_law"},
                                                        {"machine_compliance", "soft_stiffening"}};
  for (const std::vector<std::string>& effects : models) {
    const CoordinateMap map = data.model.map(effects);
    Eigen::VectorXd u = Eigen::VectorXd::Constant(map.size(), 0.4);
    const Eigen::VectorXd predicted = data.model.predict(map, u);
    constexpr double kStep = 1e-3;
    const Eigen::MatrixXd slopes = data.model.slopes(map, u, predicted, kStep);
    for (int i = 0; i < map.size(); ++i) {
      Eigen::VectorXd moved = u;
      moved[i] += kStep;
      const Eigen::VectorXd by_difference = (data.model.predict(map, moved) - predicted) / (moved[i] - u[i]);
      EXPECT_LT((slopes.col(i) - by_difference).norm(), 1e-9 * (1.0 + by_difference.norm())) << i;
    }
  }
}

}  // namespace
}  // namespace nacre::diagnosis
