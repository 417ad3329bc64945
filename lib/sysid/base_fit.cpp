#include "sysid/base_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sysid/objective.hpp"

namespace nacre::sysid {
namespace {

constexpr double kTolerance = 0.002;  // of toughness; the aim is kToughnessAim
constexpr int kMostPeakMatches = 3;
constexpr double kPeakTolerance = 0.03;
/// Factors on E, tried in turn.
constexpr std::array kModulusFactors = {1.0, 0.5, 2.0, 0.25};
/// Across a bracket of W narrower than this T is taken to jump; scaling E and W meets what is left.
constexpr double kNarrowest = 0.02;

double peak_of(const tester::Curve& curve) {
  return curve.empty() ? 0.0 : *std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
}

}  // namespace

MaterialFit::MaterialFit(const measurement::Replicates& measured, const MaterialRanges& ranges,
                         const MaterialTrial& start, int budget)
    : measured_(measured), ranges_(ranges), start_(start), budget_(budget) {
  start_ = {ranges.e.clamped(start.e_pa), ranges.w.clamped(start.w_j_per_m3),
            ranges.gamma.clamped(start.gamma_per_s)};
  best_ = start_;
  begin_threshold(start_.e_pa, start_.w_j_per_m3);
}

void MaterialFit::begin_threshold(double e_pa, double first_w) {
  kind_ = Search::threshold;
  origin_ = {e_pa, first_w, start_.gamma_per_s};
  search_.emplace(RatioSearch::Settings{.lower = ranges_.w.minimum,
                                        .upper = ranges_.w.maximum,
                                        .first = first_w,
                                        .tolerance = kTolerance,
                                        .narrowest = kNarrowest});
}

void MaterialFit::begin_scale() {
  kind_ = Search::scale;
  origin_ = best_;
  search_.emplace(RatioSearch::Settings{.lower = ranges_.e.minimum / origin_.e_pa,
                                        .upper = ranges_.e.maximum / origin_.e_pa,
                                        .first = measured_.toughness_pa / *best_prediction_.toughness_pa,
                                        .tolerance = kTolerance,
                                        .narrowest = kNarrowest});
}

MaterialTrial MaterialFit::trial_at(double x) const {
  if (kind_ == Search::threshold) return {origin_.e_pa, x, origin_.gamma_per_s};
  return {ranges_.e.clamped(x * origin_.e_pa), ranges_.w.clamped(x * origin_.w_j_per_m3), origin_.gamma_per_s};
}

std::vector<MaterialTrial> MaterialFit::ask(int count) {
  std::vector<MaterialTrial> trials;
  while (!finished_ && trials.empty()) {
    if (evaluations_ >= budget_) {
      finished_ = true;
      break;
    }
    for (const double x : search_->ask(std::min(count, budget_ - evaluations_))) trials.push_back(trial_at(x));
    if (trials.empty()) finished_ = !next_search();
  }
  return trials;
}

bool MaterialFit::match_peak() {
  const double measured_peak = peak_of(measured_.representative_curve), peak = peak_of(best_prediction_.curve);
  if (measured_peak <= 0.0 || peak <= 0.0 || ++peak_matches_ > kMostPeakMatches) return false;
  const double factor = measured_peak / peak;
  const double e_pa = ranges_.e.clamped(best_.e_pa * factor * factor);
  if (std::abs(factor - 1.0) < kPeakTolerance || e_pa == best_.e_pa) return false;
  begin_threshold(e_pa, best_.w_j_per_m3);
  return true;
}

bool MaterialFit::next_search() {
  if (search_->met() || met()) return match_peak();
  if (any_ && kind_ == Search::threshold) {
    begin_scale();
    return true;
  }
  while (++modulus_ < kModulusFactors.size()) {
    const double e_pa = ranges_.e.clamped(start_.e_pa * kModulusFactors[modulus_]);
    if (e_pa == ranges_.e.clamped(start_.e_pa * kModulusFactors[modulus_ - 1])) continue;
    begin_threshold(e_pa, start_.w_j_per_m3);
    return true;
  }
  return false;
}

double MaterialFit::error() const { return relative_error(best_prediction_.toughness_pa, measured_.toughness_pa); }

bool MaterialFit::met() const { return any_ && error() <= kToughnessAim; }

void MaterialFit::tell(const MaterialTrial& trial, const Prediction& prediction) {
  ++evaluations_;
  const bool usable = prediction.toughness_pa.has_value();
  search_->tell(kind_ == Search::threshold ? trial.w_j_per_m3 : trial.e_pa / origin_.e_pa,
                usable ? std::optional(*prediction.toughness_pa / measured_.toughness_pa) : std::nullopt);
  const double misfit = toughness_misfit(measured_, prediction);
  if (usable && (!any_ || misfit < best_misfit_)) {
    any_ = true;
    best_ = trial;
    best_prediction_ = prediction;
    best_misfit_ = misfit;
  }
}

double MaterialFit::progress() const {
  return finished_ ? 1.0 : std::min(1.0, static_cast<double>(evaluations_) / std::max(1, budget_));
}

}  // namespace nacre::sysid
