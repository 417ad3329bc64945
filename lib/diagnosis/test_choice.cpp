#include "diagnosis/test_choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/statistics.hpp"

namespace nacre::diagnosis {
namespace {

/// Squared errors already bought for one pair, by way of testing.
using Bought = std::map<TestWay, double>;

double confusion(const Bought& bought) {
  double squared = 0.0;
  for (const auto& [way, square] : bought) squared += square;
  return normal_cdf(-0.5 * std::sqrt(squared));
}

void buy(Bought& bought, const TestValue& test, std::size_t pair, double most_errors) {
  double& square = bought[test.way];
  square = std::max(square, std::pow(std::min(test.pairs[pair].errors, most_errors), 2));
}

/// The value of one more test.
struct Worth {
  double fall = 0.0;     ///< of the chance of confusion, summed over the pairs
  double errors = 0.0;   ///< the largest separation
  std::size_t pair = 0;  ///< that gains most
};

bool is_better(const Worth& one, const Worth& other, double least_fall) {
  const double mine = std::max(one.fall, least_fall), its = std::max(other.fall, least_fall);
  return mine != its ? mine > its : one.errors > other.errors;
}

Worth worth_of(const TestValue& test, const std::vector<Bought>& bought, const TestRules& rules) {
  Worth worth;
  double most = -1.0;
  for (std::size_t pair = 0; pair < test.pairs.size(); ++pair) {
    Bought then = bought[pair];
    buy(then, test, pair, rules.most_errors);
    const double fall = confusion(bought[pair]) - confusion(then), errors = test.pairs[pair].errors;
    worth.fall += fall;
    worth.errors = std::max(worth.errors, errors);
    const double gain =
        fall + rules.least_fall * errors;  // where nothing falls any more, the pair that it separates most
    if (gain > most) most = gain, worth.pair = pair;
  }
  return worth;
}

}  // namespace

std::vector<TestChoice> choose_tests(const std::vector<TestValue>& tests, int count, const TestRules& rules) {
  std::vector<TestChoice> chosen;
  if (tests.empty()) return chosen;
  std::vector<Bought> bought(tests.front().pairs.size());
  std::vector<std::size_t> left;
  for (std::size_t t = 0; t < tests.size(); ++t)
    if (worth_of(tests[t], bought, rules).errors >= rules.least_errors) left.push_back(t);
  while (!left.empty() && static_cast<int>(chosen.size()) < count) {
    auto best = left.begin();
    Worth best_worth = worth_of(tests[*best], bought, rules);
    for (auto t = left.begin() + 1; t != left.end(); ++t) {
      const Worth worth = worth_of(tests[*t], bought, rules);
      if (is_better(worth, best_worth, rules.least_fall)) best = t, best_worth = worth;
    }
    if (tests[*best].pairs[best_worth.pair].errors < rules.least_errors) {  // others told its own pairs apart
      left.erase(best);
      continue;
    }
    chosen.push_back({*best, best_worth.pair});
    for (std::size_t pair = 0; pair < bought.size(); ++pair) buy(bought[pair], tests[*best], pair, rules.most_errors);
    left.erase(best);
  }
  return chosen;
}

}  // namespace nacre::diagnosis
