// The parts that DGEMO is made of.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "base/random.hpp"
#include "explore/rivals/family_front.hpp"
#include "explore/rivals/front_discovery.hpp"
#include "explore/rivals/morbo.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::explore {
namespace {

double price_of(const std::vector<int>& families, const std::vector<std::vector<double>>& prices,
                const FamilyPrices& settings) {
  double price = settings.family * static_cast<double>(std::set<int>(families.begin(), families.end()).size());
  for (std::size_t c = 0; c < families.size(); ++c) {
    price += prices[c][families[c]];
    if (c > 0 && families[c] != families[c - 1]) price += settings.change;
  }
  return price;
}

/// The smallest price over all assignments.
double brute_force(const std::vector<std::vector<double>>& prices, const FamilyPrices& settings) {
  const std::size_t cells = prices.size(), families = prices.front().size();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t code = 0; code < static_cast<std::size_t>(std::pow(families, cells)); ++code) {
    std::vector<int> assignment;
    for (std::size_t rest = code, c = 0; c < cells; ++c, rest /= families)
      assignment.push_back(static_cast<int>(rest % families));
    best = std::min(best, price_of(assignment, prices, settings));
  }
  return best;
}

std::vector<std::vector<double>> random_prices(int cells, int families, RandomStream& random) {
  std::vector<std::vector<double>> prices(cells);
  for (auto& row : prices)
    for (int f = 0; f < families; ++f) row.push_back(random.uniform(0.0, 10.0));
  return prices;
}

TEST(FamilyFront, TheChainIsSolvedExactlyWhenFamiliesCostNothing) {
  RandomStream random(1, "test");
  for (int i = 0; i < 30; ++i) {
    const auto prices = random_prices(6, 4, random);
    const FamilyPrices settings{.change = random.uniform(0.0, 6.0), .family = 0.0};
    const FamilyAssignment found = assign_families(prices, settings);
    EXPECT_NEAR(found.price, price_of(found.family, prices, settings), 1e-12);
    EXPECT_NEAR(found.price, brute_force(prices, settings), 1e-12);
  }
}

TEST(FamilyFront, WithAPricePerFamilyItComesNearTheBest) {
  RandomStream random(2, "test");
  double found_sum = 0.0, best_sum = 0.0;
  for (int i = 0; i < 30; ++i) {
    const auto prices = random_prices(6, 4, random);
    const FamilyPrices settings{.change = 2.0, .family = 4.0};
    const FamilyAssignment found = assign_families(prices, settings);
    EXPECT_NEAR(found.price, price_of(found.family, prices, settings), 1e-12);
    found_sum += found.price;
    best_sum += brute_force(prices, settings);
  }
  EXPECT_GE(found_sum, best_sum - 1e-9);
  EXPECT_LT(found_sum, 1.05 * best_sum);
}

/// Samples in batches of 10, each batch as good in both properties as the factor says.
std::vector<Evaluated> samples_of(const std::vector<double>& factors) {
  RandomStream random(4, "test");
  std::vector<Evaluated> samples;
  for (const double factor : factors) {
    const pattern::Pattern near = samples.empty() ? pattern::random_pattern(random) : samples.front().pattern;
    for (int i = 0; i < 10; ++i) {
      const bool is_first = samples.size() < 10;
      const pattern::Pattern pattern = is_first && i > 0 ? pattern::random_pattern(random)
                                                         : pattern::Pattern(near.bits() ^ (samples.size() * 37 % 4096));
      samples.push_back({pattern, {factor * (1.0 + 0.01 * i) * 1e9, factor * (1.1 - 0.01 * i) * 1e6}});
    }
  }
  return samples;
}

TEST(TrustRegions, GrowWhileTheyGrowTheFrontAndRestartWhereTheyDoNot) {
  const auto first_after = [](const std::vector<double>& factors) {
    return trust_regions(samples_of(factors), 10).front();
  };
  EXPECT_EQ(first_after({1.0}).radius, 16);
  EXPECT_EQ(first_after({1.0, 2.0, 3.0}).radius, 32);
  EXPECT_EQ(first_after({1.0, 0.1, 0.1, 0.1}).radius, 8);
  EXPECT_EQ(first_after({1.0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1}).radius, 4);
  const TrustRegion stuck = first_after({1.0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
  const TrustRegion restarted = first_after({1.0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
  EXPECT_EQ(restarted.radius, 16);
  EXPECT_NE(restarted.centre, stuck.centre);
}

/// |x - a|^2 and |x - b|^2: the front is the straight line from a to b.
class TwoBowls final : public SmoothPair {
 public:
  TwoBowls(Eigen::VectorXd a, Eigen::VectorXd b) : centres_{std::move(a), std::move(b)} {}
  Eigen::Vector2d values(const Eigen::VectorXd& at) const override {
    return {(at - centres_[0]).squaredNorm(), (at - centres_[1]).squaredNorm()};
  }
  Eigen::VectorXd gradient(int objective, const Eigen::VectorXd& at) const override {
    return 2.0 * (at - centres_[objective]);
  }
  Eigen::MatrixX2d values_all(const Eigen::MatrixXd& at) const override {
    Eigen::MatrixX2d result(at.rows(), 2);
    for (Eigen::Index i = 0; i < at.rows(); ++i) result.row(i) = values(at.row(i));
    return result;
  }

 private:
  std::array<Eigen::VectorXd, 2> centres_;
};

TEST(FrontDiscovery, FindsTheLineBetweenTwoBowls) {
  const Eigen::VectorXd a = Eigen::VectorXd::Constant(6, 0.2), b = Eigen::VectorXd::Constant(6, 0.7);
  RandomStream random(3, "test");
  const auto cells = discover_front(TwoBowls(a, b), {Eigen::VectorXd::Constant(6, 0.95), Eigen::VectorXd::Zero(6)},
                                    {.edge = 1.0, .generations = 6, .local_searches = 15}, random);
  int on_front = 0;
  double lowest = 1.0, highest = 0.0;
  for (const auto& cell : cells) {
    const FrontPoint& best = cell.front();
    const double along = best.at.mean();
    const double off = (best.at.array() - along).matrix().norm();
    if (off > 0.01 || along < 0.19 || along > 0.71) continue;
    ++on_front;
    lowest = std::min(lowest, along), highest = std::max(highest, along);
  }
  EXPECT_GT(on_front, 60) << "of 100 cells";
  EXPECT_LT(lowest, 0.25);
  EXPECT_GT(highest, 0.65);
}

}  // namespace
}  // namespace nacre::explore
