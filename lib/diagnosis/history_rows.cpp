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

/// One number per specimen, or none where it is not known.
using Regressor = std::vector<std::optional<double>>;

/// Sum over groups of (x - mean x)(y - mean y).
Regression regress(const std::vector<Deviation>& deviations, const Regressor& x, Feature feature) {
  struct Sums {
    double x = 0.0, y = 0.0;
    int count = 0;
  };
  std::map<int, Sums> groups;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const auto& y = value_of(deviations[i].from_mean, feature);
    if (!y || !x[i]) continue;
    Sums& sums = groups[deviations[i].group];
    sums.x += *x[i], sums.y += *y, ++sums.count;
  }
  Regression sum;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const auto& y = value_of(deviations[i].from_mean, feature);
    if (!y || !x[i]) continue;
    const Sums& sums = groups[deviations[i].group];
    const double from_mean = *x[i] - sums.x / sums.count;
    sum.squares += from_mean * from_mean;
    sum.products += from_mean * (*y - sums.y / sums.count);
    ++sum.count;
  }
  return sum;
}

/// Print order less its mean over the specimen's batch, which makes it nearly independent of the number of the batch;
/// none where it is not known.
Regressor order_in_batch(const std::vector<Deviation>& deviations) {
  std::map<double, std::pair<double, int>> means;
  for (const Deviation& d : deviations)
    if (d.measured->specimen->print_order > 0)
      means[d.measured->batch_step].first += d.measured->specimen->print_order, ++means[d.measured->batch_step].second;
  Regressor order;
  for (const Deviation& d : deviations) {
    order.emplace_back();
    if (d.measured->specimen->print_order <= 0) continue;
    const auto& [total, count] = means[d.measured->batch_step];
    order.back() = d.measured->specimen->print_order - total / count;
  }
  return order;
}

}  // namespace

std::vector<HistoryRow> history_rows(const std::vector<std::vector<Measured>>& groups) {
  std::vector<HistoryRow> rows;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness, tester::TestKind::tensile}) {
    const std::vector<Deviation> deviations = deviations_of(groups, test);
    Regressor batch;
    for (const Deviation& d : deviations) batch.emplace_back(d.measured->batch_step);
    const Regressor order = order_in_batch(deviations);
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
