#include "diagnosis/test_choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/statistics.hpp"

namespace nacre::diagnosis {
namespace {

constexpr double kMostErrors = 4.0;   // believed of one way of testing
constexpr double kLeastErrors = 1.0;  // below which a test separates nothing
constexpr double kLeastFall = 1e-6;   // of a chance, below which a further test is not bought for it

/// Squared errors already bought for one pair, by way of testing.
using Bought = std::map<std::string, double>;

double confusion(const Bought& bought) {
  double squared = 0.0;
  for (const auto& [way, square] : bought) squared += square;
  return normal_cdf(-0.5 * std::sqrt(squared));
}

void buy(Bought& bought, const TestValue& test, std::size_t pair) {
  double& square = bought[test.way];
  square = std::max(square, std::pow(std::min(test.pairs[pair].errors, kMostErrors), 2));
}

/// The value of one more test.
struct Worth {
  double fall = 0.0;     ///< of the chance of confusion, summed over the pairs
  double errors = 0.0;   ///< the largest separation
  std::size_t pair = 0;  ///< that gains most
  bool operator>(const Worth& other) const {
    const double mine = std::max(fall, kLeastFall), its = std::max(other.fall, kLeastFall);
    return mine != its ? mine > its : errors > other.errors;
  }
};

Worth worth_of(const TestValue& test, const std::vector<Bought>& bought) {
  Worth worth;
  double most = -1.0;
  for (std::size_t pair = 0; pair < test.pairs.size(); ++pair) {
    Bought then = bought[pair];
    buy(then, test, pair);
    const double fall = confusion(bought[pair]) - confusion(then), errors = test.pairs[pair].errors;
    worth.fall += fall;
    worth.errors = std::max(worth.errors, errors);
    const double gain = fall + kLeastFall * errors;  // where nothing falls any more, the pair that it separates most
    if (gain > most) most = gain, worth.pair = pair;
  }
  return worth;
}

}  // namespace

std::vector<TestChoice> choose_tests(const std::vector<TestValue>& tests, int count) {
  std::vector<TestChoice> chosen;
  if (tests.empty()) return chosen;
  std::vector<Bought> bought(tests.front().pairs.size());
  std::vector<std::size_t> left;
  for (std::size_t t = 0; t < tests.size(); ++t)
    if (worth_of(tests[t], bought).errors >= kLeastErrors) left.push_back(t);
  while (!left.empty() && static_cast<int>(chosen.size()) < count) {
    auto best = left.begin();
    Worth best_worth = worth_of(tests[*best], bought);
    for (auto t = left.begin() + 1; t != left.end(); ++t) {
      const Worth worth = worth_of(tests[*t], bought);
      if (worth > best_worth) best = t, best_worth = worth;
    }
    chosen.push_back({*best, best_worth.pair});
    for (std::size_t pair = 0; pair < bought.size(); ++pair) buy(bought[pair], tests[*best], pair);
    left.erase(best);
  }
  return chosen;
}

}  // namespace nacre::diagnosis
