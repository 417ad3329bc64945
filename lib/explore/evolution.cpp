#include "explore/evolution.hpp"

#include <algorithm>
#include <numeric>

#include "base/random.hpp"
#include "explore/ledger.hpp"
#include "explore/random_search.hpp"
#include "pattern/mutation.hpp"

namespace nacre::explore {
namespace {

/// A member of the population and its fitness within it.
struct Member {
  Evaluated sample;
  int rank = 0;
  double crowding = 0.0;
  bool better_than(const Member& other) const {
    return rank != other.rank ? rank < other.rank : crowding > other.crowding;
  }
};

/// Ranks and crowding of all members, who compete with one another.
void judge(std::vector<Member>& members) {
  std::vector<optimize::Performance> performances;
  performances.reserve(members.size());
  for (const Member& member : members) performances.push_back(member.sample.performance);
  const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
  const std::vector<double> crowding = optimize::crowding_distances(performances, ranks);
  for (std::size_t i = 0; i < members.size(); ++i) members[i].rank = ranks[i], members[i].crowding = crowding[i];
}

class Evolution final : public Search {
 public:
  Evolution(const SearchSettings& settings, Variation variation)
      : variation_(variation),
        population_size_(settings.population),
        ledger_(settings),
        start_(starting_patterns(settings)),
        tournament_(settings.seed, "explore/tournament"),
        mutation_(settings.seed, "explore/mutation"),
        restart_(settings.seed, "explore/restart") {
    join(ledger_.evaluated());
  }

  std::vector<pattern::Pattern> ask() override {
    while (next_start_ < start_.size() && ledger_.seen(start_[next_start_])) ++next_start_;
    if (next_start_ < start_.size()) {
      add_start();
    } else if (population_.empty()) {
      // Every simulation so far has failed: there are no parents yet.
      while (ledger_.room() > 0) ledger_.add(unseen_random_pattern(ledger_, restart_));
    } else {
      add_offspring();
    }
    return ledger_.hand_out();
  }

  void tell(std::span<const std::optional<optimize::Performance>> performances,
            std::span<const Sampling> samplings) override {
    join(ledger_.record(performances, samplings));
  }

  const std::vector<Evaluated>& evaluated() const override { return ledger_.evaluated(); }

 private:
  void add_start() {
    for (; next_start_ < start_.size() && ledger_.room() > 0; ++next_start_) {
      if (!ledger_.seen(start_[next_start_])) ledger_.add(start_[next_start_]);
    }
  }

  void add_offspring() {
    int proposals_left = kMaximumProposals;
    while (ledger_.room() > 0) {
      const auto child = offspring(proposals_left);
      if (!child) return;
      ledger_.add(*child);
    }
  }

  /// A feasible pattern that was not seen before, or nothing once the proposals are used up.
  std::optional<pattern::Pattern> offspring(int& proposals_left) {
    const auto is_new = [this](const pattern::Pattern& child) { return !ledger_.seen(child); };
    if (variation_ != Variation::single_pixel_rolled_back) {
      const auto kind =
          variation_ == Variation::three_way ? pattern::MutationKind::three_way : pattern::MutationKind::single_pixel;
      return pattern::mutate_until(parent(), kind, mutation_, is_new, proposals_left);
    }
    for (; proposals_left > 0; --proposals_left) {
      const auto child = pattern::mutate_or_roll_back(parent(), pattern::MutationKind::single_pixel, mutation_);
      if (child && is_new(*child)) return child;
    }
    return std::nullopt;
  }

  /// Binary tournament.
  const pattern::Pattern& parent() {
    const int size = population_.size();
    const Member& first = population_[tournament_.index(size)];
    const Member& second = population_[tournament_.index(size)];
    return (second.better_than(first) ? second : first).sample.pattern;
  }

  /// (mu + lambda) survival.
  void join(std::span<const Evaluated> newcomers) {
    for (const Evaluated& sample : newcomers) population_.push_back({sample});
    judge(population_);
    if (population_.size() <= population_size_) return;
    std::stable_sort(population_.begin(), population_.end(),
                     [](const Member& a, const Member& b) { return a.better_than(b); });
    population_.resize(population_size_);
  }

  Variation variation_;
  std::size_t population_size_;
  Ledger ledger_;
  std::vector<pattern::Pattern> start_;
  std::size_t next_start_ = 0;
  RandomStream tournament_, mutation_, restart_;
  std::vector<Member> population_;
};

}  // namespace

std::unique_ptr<Search> make_evolution(const SearchSettings& settings, Variation variation) {
  return std::make_unique<Evolution>(settings, variation);
}

}  // namespace nacre::explore
