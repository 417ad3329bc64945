#include "tester/film_strains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace nacre::tester {
namespace {

/// Linear rise to the peak at strain 0.02, then linear fall to the end at 0.04.
ToughnessResult rise_and_fall() {
  ToughnessResult result;
  result.failure_strain = 0.04;
  for (int i = 0; i <= 400; ++i) {
    const double strain = 1e-4 * i;
    result.curve.strain.push_back(strain);
    result.curve.stress_pa.push_back(1e8 * std::min(strain, 0.04 - strain));
  }
  return result;
}

auto count_between(const std::vector<double>& strains, double low, double high) {
  return std::count_if(strains.begin(), strains.end(), [&](double strain) { return strain >= low && strain < high; });
}

TEST(FilmStrains, IncreaseFromZeroToTheEndOfTheTest) {
  for (const int count : {2, 3, 48, 1000}) {
    const std::vector<double> strains = film_strains(rise_and_fall(), count);
    ASSERT_EQ(strains.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(strains.front(), 0.0);
    EXPECT_EQ(strains.back(), 0.04);
    EXPECT_TRUE(std::is_sorted(strains.begin(), strains.end(), std::less_equal<>())) << "no strain twice";
  }
}

TEST(FilmStrains, StandWhereElementsFail) {
  ToughnessResult result = rise_and_fall();
  for (int i = 0; i < 200; ++i) result.breaks.push_back({i, 0.030 + 1e-5 * i});
  const std::vector<double> strains = film_strains(result, 50);
  EXPECT_GT(count_between(strains, 0.030, 0.032), 15) << "a twentieth of the strain, in which all elements fail";
  EXPECT_LT(count_between(strains, 0.032, 0.034), 8);
}

TEST(FilmStrains, ABurstInOneStepLeavesFramesForTheRest) {
  ToughnessResult result = rise_and_fall();
  for (int i = 0; i < 5000; ++i) result.breaks.push_back({i, 0.01});
  for (int i = 0; i < 20; ++i) result.breaks.push_back({i, 0.030 + 1e-4 * i});
  const std::vector<double> strains = film_strains(result, 50);
  EXPECT_GE(count_between(strains, 0.030, 0.032), 4);
  EXPECT_GE(count_between(strains, 0.0, 0.0095), 2) << "the elastic rise is seen, too";
}

TEST(FilmStrains, AreDenserAroundThePeak) {
  ToughnessResult result = rise_and_fall();
  result.breaks.push_back({0, 0.039});
  const std::vector<double> strains = film_strains(result, 80);
  EXPECT_GT(count_between(strains, 0.0185, 0.0215), 2 * count_between(strains, 0.010, 0.013));
}

TEST(FilmStrains, ASpecimenThatNeitherBreaksNorYieldsIsShownAtEqualSteps) {
  ToughnessResult result;
  result.failure_strain = 2.0;
  const std::vector<double> strains = film_strains(result, 5);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(strains[i], 0.5 * static_cast<double>(i), 1e-12);
}

}  // namespace
}  // namespace nacre::tester
