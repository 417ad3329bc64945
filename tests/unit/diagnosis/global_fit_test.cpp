#include "diagnosis/global_fit.hpp"

#include <gtest/gtest.h>

#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

/// Moduli of a few layouts, and the base model of them.
class GlobalFit : public testing::Test {
 protected:
  explicit GlobalFit(double mixing = 0.0) {
    material::ParameterSet truth = synthetic_truth();
    if (mixing > 0.0) truth.extensions["droplet_mixing"] = {mixing};
    observations_ = observe(synthetic_specimens({.patterns = 10, .twins = 2}, truth), 0.003, {}, {});
    const Basis basis = basis_for(observations_, material::thesis_parameters(), material::default_ranges(), {});
    model_.emplace(observations_, basis, tester::Fidelity::tiny);
    middle_ = model_->base_map().coordinates(basis.centre);
  }
  /// A start at the middle that counts how often it is taken.
  Start counted(int& taken, std::optional<double> promise = std::nullopt) const {
    return {StartKind::centre,
            [this, &taken](const FittedModel*) {
              ++taken;
              return middle_;
            },
            promise};
  }
  FittedModel fitted(const std::vector<Start>& starts, std::optional<FittedModel> known = std::nullopt) const {
    return global_fit(*model_, observations_, {}, {}, starts, std::move(known));
  }

  Observations observations_;
  std::optional<FeatureModel> model_;
  Eigen::VectorXd middle_;
};

class GlobalFitOfAMisfit : public GlobalFit {
 protected:
  GlobalFitOfAMisfit() : GlobalFit(1.5) {}
};

TEST_F(GlobalFit, OneDescentIsEnoughWhereNoiseExplainsTheFit) {
  int first = 0, second = 0;
  const FittedModel fit = fitted({counted(first), counted(second)});
  ASSERT_LT(fit.chi2, observations_.size());
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 0);
}

TEST_F(GlobalFit, AStartThatPromisesLessIsTakenAllTheSame) {
  int worse = 0, better = 0;
  const FittedModel fit = fitted({counted(worse)});
  fitted({counted(worse, fit.chi2 + 1.0), counted(better, fit.chi2 - 1.0)}, fit);
  EXPECT_EQ(worse, 1) << "of the first fit";
  EXPECT_EQ(better, 1);
}

TEST_F(GlobalFitOfAMisfit, FurtherDescentsEndWhereOneDoesNotHelp) {
  int first = 0, second = 0, third = 0;
  const FittedModel fit = fitted({counted(first), counted(second), counted(third)});
  ASSERT_GT(fit.chi2, 2.0 * observations_.size());
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(third, 0) << "the second ended where the first did";
}

TEST_F(GlobalFitOfAMisfit, TheBestOfAllDescentsIsKept) {
  int descents = 0;
  const FittedModel middle = fitted({counted(descents)});
  FittedModel bad = linearised(*model_, {}, Eigen::VectorXd::Constant(middle_.size(), 0.9));
  bad.chi2 = 1e9;
  EXPECT_NEAR(fitted({counted(descents)}, bad).chi2, middle.chi2, 1e-6);
}

}  // namespace
}  // namespace nacre::diagnosis
