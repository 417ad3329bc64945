#include "sysid/base_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sysid/objective.hpp"

namespace nacre::sysid {
namespace {

constexpr double kTolerance = 0.002;  // of toughness; the aim is 1 %
constexpr double kGoodEnough = 0.01;
constexpr int kMostPeakMatches = 3;
constexpr double kPeakTolerance = 0.03;

/// Factors on E, tried in turn when W alone cannot meet the toughness.
constexpr std::array<double, 7> kModulusFactors = {1.0, 0.7, 1.4, 0.4, 2.5, 0.2, 5.0};

double clamped(double value, const material::ParameterRange& range) {
  return std::clamp(value, range.minimum, range.maximum);
}

double peak_of(const tester::Curve& curve) {
  return curve.empty() ? 0.0 : *std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
}

}  // namespace

MaterialFit::MaterialFit(const measurement::Replicates& measured, const MaterialRanges& ranges,
                         const MaterialTrial& start, int budget)
    : measured_(measured), ranges_(ranges), start_(start), budget_(budget) {
  start_ = {clamped(start.e_pa, ranges.e), clamped(start.w_j_per_m3, ranges.w),
            clamped(start.gamma_per_s, ranges.gamma)};
  best_ = start_;
  begin_search(start_.e_pa, start_.w_j_per_m3);
}

void MaterialFit::begin_search(double e_pa, double first_w) {
  e_pa_ = e_pa;
  search_.emplace(RatioSearch::Settings{
      .lower = ranges_.w.minimum, .upper = ranges_.w.maximum, .first = first_w, .tolerance = kTolerance});
}

std::vector<MaterialTrial> MaterialFit::ask(int count) {
  std::vector<MaterialTrial> trials;
  while (!finished_ && trials.empty()) {
    if (evaluations_ >= budget_) {
      finished_ = true;
      break;
    }
    for (const double w : search_->ask(std::min(count, budget_ - evaluations_))) {
      trials.push_back({e_pa_, w, start_.gamma_per_s});
    }
    if (trials.empty()) finished_ = search_->met() ? !match_peak() : !next_stage();
  }
  return trials;
}

bool MaterialFit::match_peak() {
  const double measured_peak = peak_of(measured_.representative_curve), peak = peak_of(best_prediction_.curve);
  if (measured_peak <= 0.0 || peak <= 0.0 || ++peak_matches_ > kMostPeakMatches) return false;
  const double factor = measured_peak / peak;
  const double e_pa = clamped(e_pa_ * factor * factor, ranges_.e);
  if (std::abs(factor - 1.0) < kPeakTolerance || e_pa == e_pa_) return false;
  begin_search(e_pa, best_.w_j_per_m3);
  return true;
}

bool MaterialFit::next_stage() {
  if (met()) return match_peak();
  while (++stage_ < kModulusFactors.size()) {
    const double e_pa = clamped(start_.e_pa * kModulusFactors[stage_], ranges_.e);
    if (e_pa == e_pa_) continue;  // clamped to where the search was before
    begin_search(e_pa, best_.w_j_per_m3);
    return true;
  }
  return false;
}

double MaterialFit::error() const { return relative_error(best_prediction_.toughness_pa, measured_.toughness_pa); }

bool MaterialFit::met() const { return any_ && error() <= kGoodEnough; }

void MaterialFit::tell(const MaterialTrial& trial, const Prediction& prediction) {
  ++evaluations_;
  const bool usable = prediction.toughness_pa.has_value();
  search_->tell(trial.w_j_per_m3,
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
