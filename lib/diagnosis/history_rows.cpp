#include "diagnosis/history_rows.hpp"

#include <map>

namespace nacre::diagnosis {
namespace {

constexpr int kFewest = 6;

/// Deviations of a feature and of a regressor from the means of their groups.
struct Regression {
  double squares = 0.0, products = 0.0;
  int count = 0;
};

/// Sum over groups of (x - mean x)(y - mean y).
Regression regress(const std::vector<Deviation>& deviations, const std::vector<double>& x, Feature feature) {
  std::map<int, std::pair<double, int>> means;
  for (std::size_t i = 0; i < deviations.size(); ++i)
    means[deviations[i].group].first += x[i], ++means[deviations[i].group].second;
  Regression sum;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const auto& y = value_of(deviations[i].from_mean, feature);
    if (!y) continue;
    const auto& [total, count] = means[deviations[i].group];
    const double from_mean = x[i] - total / count;
    sum.squares += from_mean * from_mean;
    sum.products += from_mean * *y;
    ++sum.count;
  }
  return sum;
}

/// Print order less its mean over the specimen's batch, which makes it nearly independent of the number of the batch.
std::vector<double> order_in_batch(const std::vector<Deviation>& deviations) {
  std::map<double, std::pair<double, int>> means;
  for (const Deviation& d : deviations)
    means[d.measured->batch_step].first += d.measured->specimen->print_order, ++means[d.measured->batch_step].second;
  std::vector<double> order;
  for (const Deviation& d : deviations) {
    const auto& [total, count] = means[d.measured->batch_step];
    order.push_back(d.measured->specimen->print_order - total / count);
  }
  return order;
}

}  // namespace

std::vector<HistoryRow> history_rows(const std::vector<std::vector<Measured>>& groups) {
  std::vector<HistoryRow> rows;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness, tester::TestKind::tensile}) {
    const std::vector<Deviation> deviations = deviations_of(groups, test);
    std::vector<double> batch;
    for (const Deviation& d : deviations) batch.push_back(d.measured->batch_step);
    const std::vector<double> order = order_in_batch(deviations);
    for (const Feature feature : {Feature::log_modulus, Feature::log_toughness, Feature::log_peak}) {
      for (const Probe probe : {Probe::batch, Probe::print_order}) {
        const Regression sum = regress(deviations, probe == Probe::batch ? batch : order, feature);
        if (sum.count < kFewest || sum.squares < 1e-6) continue;
        rows.push_back({Row{-1, feature, probe, test, 1.0 / sum.squares}, sum.products / sum.squares});
      }
    }
  }
  return rows;
}

}  // namespace nacre::diagnosis
