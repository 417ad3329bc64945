#include "baselines.hpp"

#include <cmath>

#include "base/statistics.hpp"
#include "study_laboratory.hpp"
#include "sysid/offline.hpp"

namespace nacre::calibration_study {
namespace {

using measurement::Replicates;

double median(const std::vector<double>& values) { return values.empty() ? 0.0 : quantile(values, 0.5); }

/// A quantity as a line in the rigid fraction.
struct FractionLine {
  double slope = 0.0, offset = 0.0;
  double at(double x) const { return offset + slope * x; }
};

FractionLine least_squares(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i)
    xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
  const double slope = xx > 0.0 ? xy / xx : 0.0;
  return {slope, mean_y - slope * mean_x};
}

double mean_error(const std::vector<double>& predicted, const std::vector<double>& measured) {
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) sum += std::abs(predicted[i] / measured[i] - 1.0);
  return measured.empty() ? 0.0 : sum / static_cast<double>(measured.size());
}

}  // namespace

Baselines baselines_of(const StudyCase& study_case) {
  std::vector<double> fraction, modulus, toughness, log_toughness;
  for (const Replicates& design : study_case.fitted) {
    fraction.push_back(design.design.rigid_fraction());
    modulus.push_back(design.modulus_pa);
    toughness.push_back(design.toughness_pa);
    log_toughness.push_back(std::log(design.toughness_pa));
  }
  const FractionLine modulus_line = least_squares(fraction, modulus),
                     toughness_line = least_squares(fraction, log_toughness);
  std::vector<double> modulus_by_line, toughness_by_line, modulus_measured, toughness_measured;
  for (const Replicates& design : study_case.held_out) {
    modulus_by_line.push_back(modulus_line.at(design.design.rigid_fraction()));
    toughness_by_line.push_back(std::exp(toughness_line.at(design.design.rigid_fraction())));
    modulus_measured.push_back(design.modulus_pa);
    toughness_measured.push_back(design.toughness_pa);
  }
  return {.modulus_line = mean_error(modulus_by_line, modulus_measured),
          .toughness_constant =
              mean_error(std::vector<double>(toughness_measured.size(), median(toughness)), toughness_measured),
          .toughness_line = mean_error(toughness_by_line, toughness_measured),
          .line_spearman = rank_correlation(toughness_by_line, toughness_measured)};
}

ErrorFloor floor_of(const StudyCase& study_case, sysid::LocalSimulator& simulator,
                    const std::function<void()>& may_go_on) {
  const material::ParameterSet truth = as_tester_parameters(study_case.truth);
  const auto predictions = sysid::predict({truth}, study_case.held_out, simulator, may_go_on).front();
  std::vector<double> modulus, toughness, modulus_measured, toughness_measured, modulus_ratio, toughness_ratio;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    if (!predictions[i].modulus_pa || !predictions[i].toughness_pa) continue;
    modulus.push_back(*predictions[i].modulus_pa);
    toughness.push_back(*predictions[i].toughness_pa);
    modulus_measured.push_back(study_case.held_out[i].modulus_pa);
    toughness_measured.push_back(study_case.held_out[i].toughness_pa);
    modulus_ratio.push_back(modulus_measured.back() / modulus.back());
    toughness_ratio.push_back(toughness_measured.back() / toughness.back());
  }
  const double modulus_scale = median(modulus_ratio), toughness_scale = median(toughness_ratio);
  for (double& value : modulus) value *= modulus_scale;
  for (double& value : toughness) value *= toughness_scale;
  return {mean_error(modulus, modulus_measured), mean_error(toughness, toughness_measured),
          rank_correlation(toughness, toughness_measured)};
}

}  // namespace nacre::calibration_study
