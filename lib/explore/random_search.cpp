#include "explore/random_search.hpp"

#include <algorithm>

#include "pattern/random_pattern.hpp"

namespace nacre::explore {
namespace {

class RandomSearch final : public Search {
 public:
  explicit RandomSearch(const SearchSettings& settings)
      : ledger_(settings), start_(starting_patterns(settings)), random_(settings.seed, "explore/random") {}

  std::vector<pattern::Pattern> ask() override {
    for (; next_ < start_.size() && ledger_.room() > 0; ++next_) {
      if (!ledger_.seen(start_[next_])) ledger_.add(start_[next_]);
    }
    while (ledger_.room() > 0) ledger_.add(unseen_random_pattern(ledger_, random_));
    return ledger_.hand_out();
  }

  void tell(std::span<const std::optional<optimize::Performance>> performances,
            std::span<const Sampling> samplings) override {
    ledger_.record(performances, samplings);
  }

  const std::vector<Evaluated>& evaluated() const override { return ledger_.evaluated(); }

 private:
  Ledger ledger_;
  std::vector<pattern::Pattern> start_;
  std::size_t next_ = 0;
  RandomStream random_;
};

}  // namespace

std::vector<pattern::Pattern> starting_patterns(const SearchSettings& settings) {
  RandomStream random(settings.seed, "explore/start");
  return pattern::stratified_patterns(std::max(0, settings.population - static_cast<int>(settings.known.size())),
                                      random);
}

pattern::Pattern unseen_random_pattern(const Ledger& ledger, RandomStream& random) {
  while (true) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    if (!ledger.seen(pattern)) return pattern;
  }
}

std::unique_ptr<Search> make_random_search(const SearchSettings& settings) {
  return std::make_unique<RandomSearch>(settings);
}

}  // namespace nacre::explore
