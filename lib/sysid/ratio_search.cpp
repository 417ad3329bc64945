#include "sysid/ratio_search.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::sysid {
namespace {

constexpr double kSameLogX = 1e-7;  // points nearer than this are one
constexpr double kSpread = 0.1;     // of a step or bracket, between the points of one batch

}  // namespace

RatioSearch::RatioSearch(const Settings& settings) : settings_(settings) {
  settings_.first = std::clamp(settings.first, settings.lower, settings.upper);
}

std::optional<RatioSearch::Sample> RatioSearch::best_sample() const {
  const auto nearer = [](const Sample& a, const Sample& b) { return std::abs(a.log_ratio) < std::abs(b.log_ratio); };
  const auto found = std::min_element(samples_.begin(), samples_.end(), nearer);
  return found == samples_.end() ? std::nullopt : std::optional(*found);
}

bool RatioSearch::met() const {
  const std::optional<Sample> best = best_sample();
  return best && std::abs(std::expm1(best->log_ratio)) <= settings_.tolerance;
}

std::optional<double> RatioSearch::best() const {
  const std::optional<Sample> sample = best_sample();
  return sample ? std::optional(std::exp(sample->log_x)) : std::nullopt;
}

bool RatioSearch::is_new(double log_x, const std::vector<double>& chosen) const {
  const auto same = [&](double other) { return std::abs(other - log_x) < kSameLogX; };
  return std::none_of(chosen.begin(), chosen.end(), same) && std::none_of(failed_.begin(), failed_.end(), same) &&
         std::none_of(samples_.begin(), samples_.end(), [&](const Sample& sample) { return same(sample.log_x); });
}

std::vector<double> RatioSearch::proposals() const {
  if (samples_.empty()) {
    const double first = std::log(settings_.first);
    return {first, first + 0.5, first - 0.5, first + 1.5, first - 1.5};
  }
  // The narrowest bracket next to the best sample, if there is one.
  const Sample* below = nullptr;
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    const Sample& left = samples_[k];
    const Sample& right = samples_[k + 1];
    if (left.log_ratio * right.log_ratio > 0.0) continue;
    if (below == nullptr || right.log_x - left.log_x < (below + 1)->log_x - below->log_x) below = &left;
  }
  if (below != nullptr) {
    const Sample& left = *below;
    const Sample& right = *(below + 1);
    const double width = right.log_x - left.log_x;
    if (width < settings_.narrowest) return {};
    const double share = std::clamp(left.log_ratio / (left.log_ratio - right.log_ratio), 0.02, 0.98);
    const double middle = left.log_x + share * width, spread = kSpread * std::min(share, 1.0 - share) * width;
    return {middle, middle - spread, middle + spread, left.log_x + 0.5 * width};
  }
  const Sample best = *best_sample();
  const double step = -best.log_ratio;  // f grows about in proportion to x
  return {best.log_x + step, best.log_x + (1.0 + kSpread) * step + std::copysign(0.01, step), best.log_x + 2.0 * step,
          best.log_x + 4.0 * step};
}

std::vector<double> RatioSearch::ask(int count) const {
  std::vector<double> chosen;
  if (met()) return {};
  const double lower = std::log(settings_.lower), upper = std::log(settings_.upper);
  for (const double proposal : proposals()) {
    const double log_x = std::clamp(proposal, lower, upper);
    if (static_cast<int>(chosen.size()) < count && is_new(log_x, chosen)) chosen.push_back(log_x);
  }
  std::vector<double> points;
  for (const double log_x : chosen) points.push_back(std::clamp(std::exp(log_x), settings_.lower, settings_.upper));
  return points;
}

void RatioSearch::tell(double x, std::optional<double> ratio) {
  if (!ratio || !(*ratio > 0.0)) {
    failed_.push_back(std::log(x));
    return;
  }
  const Sample sample{std::log(x), std::log(*ratio)};
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), sample,
                                      [](const Sample& a, const Sample& b) { return a.log_x < b.log_x; });
  samples_.insert(place, sample);
}

}  // namespace nacre::sysid
