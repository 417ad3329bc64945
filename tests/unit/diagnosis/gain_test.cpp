#include "diagnosis/gain.hpp"

#include <gtest/gtest.h>

#include "pattern/coupons.hpp"

namespace nacre::diagnosis {
namespace {

/// Two replicates of a design, 1 % apart.
void print_twice(std::vector<measurement::SpecimenRecord>& specimens, const pattern::Design& design, double modulus_pa,
                 double orientation_deg = 0.0) {
  for (const double factor : {0.995, 1.005}) {
    measurement::SpecimenRecord record;
    record.specimen = std::to_string(specimens.size());
    record.design = design;
    record.conditions.orientation_deg = orientation_deg;
    record.modulus_pa = factor * modulus_pa;
    specimens.push_back(record);
  }
}

/// Four checkerboards and a laminate, two of them as stiff as each other, and a turned twin of the stiffest.
Observations five_designs() {
  std::vector<measurement::SpecimenRecord> specimens;
  print_twice(specimens, pattern::checkerboard(1), 1e8);
  print_twice(specimens, pattern::checkerboard(2), 1.002e8);
  print_twice(specimens, pattern::laminate(pattern::LayerDirection::along_y, 2, 2), 2e8);
  print_twice(specimens, pattern::checkerboard(5), 3e8);
  print_twice(specimens, pattern::checkerboard(10), 4e8);
  print_twice(specimens, pattern::checkerboard(10), 5e8, 90.0);
  return observe(specimens, 0.0, {}, {});
}

/// A model without constants.
FittedModel predicting(const Eigen::VectorXd& values) {
  FittedModel fit;
  fit.predicted = values;
  fit.jacobian.resize(values.size(), 0);
  return fit;
}

TEST(Gain, RanksDesignsThatTheMeasurementsSetApart) {
  const Observations observations = five_designs();
  const double mean = observations.values.mean();
  const FittedModel upside_down = predicting((2.0 * mean - observations.values.array()).matrix()),
                    right = predicting(observations.values);
  const Gain gain = held_out_gain(observations, upside_down, {.models = {right}, .least_drop = 1.0}, {}, {}, 1);
  ASSERT_EQ(gain.features.size(), 1u);
  const Ranking& ranking = gain.features[0].ranking;
  EXPECT_EQ(ranking.pairs, 9);  // ten of five upright designs, but for the two of equal stiffness
  EXPECT_EQ(ranking.before, 0);
  EXPECT_EQ(ranking.after, 9);
}

}  // namespace
}  // namespace nacre::diagnosis
