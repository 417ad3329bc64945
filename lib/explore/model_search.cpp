#include "explore/model_search.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "explore/improvement.hpp"
#include "explore/surrogate_search.hpp"

#include "explore/random_search.hpp"

namespace nacre::explore {
namespace {

constexpr double kLeastPa = 1e-300;  // believed values that are not positive enclose no area

class ModelSearch final : public Search {
 public:
  explicit ModelSearch(const SearchSettings& settings)
      : settings_(settings), ledger_(settings), start_(starting_patterns(settings)) {
    settings_.known.clear();
  }

  std::vector<pattern::Pattern> ask() override {
    const std::optional<BatchRequest> next = batch_request();
    return next ? ask_with(batch_for(*next)) : ask_at_random();
  }

  std::optional<BatchRequest> batch_request() const override {
    if (starting() || ledger_.evaluated().empty() || ledger_.room() <= 0) return std::nullopt;
    return BatchRequest{settings_, ledger_.evaluated(), lost_, ledger_.room()};
  }

  std::vector<pattern::Pattern> ask_with(std::span<const pattern::Pattern> batch) override {
    for (const pattern::Pattern& pattern : batch) {
      if (ledger_.room() <= 0) break;
      if (!ledger_.seen(pattern))
        ledger_.add(pattern);
      else if (may_be_tested_again(pattern))
        ledger_.add_again(pattern);
    }
    return asked_ = ledger_.hand_out();
  }

  void tell(std::span<const std::optional<optimize::Performance>> performances,
            std::span<const Sampling> samplings) override {
    ledger_.record(performances, samplings);
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      if (!performances[i] && !is_evaluated(asked_[i])) lost_.push_back(asked_[i]);
    }
  }

  const std::vector<Evaluated>& evaluated() const override { return ledger_.evaluated(); }

 private:
  std::vector<Evaluated>::const_iterator find(const pattern::Pattern& pattern) const {
    return std::ranges::find(ledger_.evaluated(), pattern, &Evaluated::pattern);
  }
  bool is_evaluated(const pattern::Pattern& pattern) const { return find(pattern) != ledger_.evaluated().end(); }

  bool may_be_tested_again(const pattern::Pattern& pattern) const {
    if (settings_.algorithm != "learned" || settings_.learned.specimens <= 1) return false;
    const auto known = find(pattern);
    return known != ledger_.evaluated().end() && known->sampling.specimens < settings_.learned.specimens;
  }

  /// Whether random patterns of the start are left.
  bool starting() const {
    return !std::all_of(start_.begin(), start_.end(), [this](const auto& pattern) { return ledger_.seen(pattern); });
  }

  std::vector<pattern::Pattern> ask_at_random() {
    if (starting()) {
      for (const pattern::Pattern& pattern : start_) {
        if (ledger_.room() > 0 && !ledger_.seen(pattern)) ledger_.add(pattern);
      }
    } else {  // every simulation so far has failed: there is nothing to learn from yet
      RandomStream random(settings_.seed, fmt::format("explore/restart {}", ledger_.asked()));
      while (ledger_.room() > 0) ledger_.add(unseen_random_pattern(ledger_, random));
    }
    return asked_ = ledger_.hand_out();
  }

  SearchSettings settings_;
  Ledger ledger_;
  std::vector<pattern::Pattern> start_;
  std::vector<pattern::Pattern> asked_, lost_;
};

}  // namespace

std::uint64_t batch_seed(const BatchRequest& batch_request) {
  return content_hash64(fmt::format("{} {} {}", batch_request.settings.algorithm, batch_request.settings.seed,
                                    batch_request.evaluated.size() + batch_request.lost.size()));
}

std::vector<Evaluated> unseen(std::vector<Evaluated> candidates, const BatchRequest& batch_request) {
  std::unordered_set<std::uint64_t> seen;
  for (const Evaluated& sample : batch_request.evaluated) seen.insert(sample.pattern.bits());
  for (const pattern::Pattern& pattern : batch_request.lost) seen.insert(pattern.bits());
  std::erase_if(candidates, [&](const Evaluated& candidate) { return !seen.insert(candidate.pattern.bits()).second; });
  return candidates;
}

std::vector<pattern::Pattern> largest_growth(std::span<const Evaluated> candidates,
                                             std::span<const Evaluated> evaluated, int count) {
  std::vector<Belief> certain;
  for (const Evaluated& each : candidates) {
    const auto logarithm = [](double value) { return std::log(std::max(value, kLeastPa)); };
    certain.push_back({{logarithm(each.performance.modulus_pa), 0.0}, {logarithm(each.performance.toughness_pa), 0.0}});
  }
  std::vector<pattern::Pattern> chosen;
  for (const std::size_t i : best_improvements(certain, optimize::pareto_front(performances_of(evaluated)), count))
    chosen.push_back(candidates[i].pattern);
  return chosen;
}

std::unique_ptr<Search> make_model_search(const SearchSettings& settings) {
  return std::make_unique<ModelSearch>(settings);
}

}  // namespace nacre::explore
