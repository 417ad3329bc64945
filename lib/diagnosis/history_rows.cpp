#include "diagnosis/history_rows.hpp"

#include <Eigen/Dense>
#include <map>
#include <optional>

#include "measurement/piece.hpp"

namespace nacre::diagnosis {
namespace {

/// One number per specimen, or none where it is not known.
using Regressor = std::vector<std::optional<double>>;

/// A regressor and a feature over the specimens that have both, less their means over each group.
struct Centred {
  Eigen::VectorXd x, y;
  std::vector<std::string> pieces;
};

/// Variance of a slope over that of a piece, where tests of one piece deviate alike.
double weight_of_pieces(const Eigen::VectorXd& x, const std::vector<std::string>& pieces) {
  std::map<std::string, double> sums;
  for (std::size_t i = 0; i < pieces.size(); ++i) sums[pieces[i]] += x[static_cast<Eigen::Index>(i)];
  double squares = 0.0;
  for (const auto& [piece, sum] : sums) squares += sum * sum;
  return squares / (x.squaredNorm() * x.squaredNorm());
}

Centred centred(const std::vector<Deviation>& deviations, const Regressor& regressor, Feature feature) {
  struct Sums {
    double x = 0.0, y = 0.0;
    int count = 0;
  };
  std::map<int, Sums> groups;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const auto& y = value_of(deviations[i].from_mean, feature);
    if (!y || !regressor[i]) continue;
    Sums& sums = groups[deviations[i].group];
    sums.x += *regressor[i], sums.y += *y, ++sums.count;
    shown.push_back(i);
  }
  const auto count = static_cast<Eigen::Index>(shown.size());
  Centred both{Eigen::VectorXd(count), Eigen::VectorXd(count), {}};
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t i = shown[k];
    const Sums& sums = groups[deviations[i].group];
    both.x[k] = *regressor[i] - sums.x / sums.count;
    both.y[k] = *value_of(deviations[i].from_mean, feature) - sums.y / sums.count;
    both.pieces.push_back(measurement::piece_of(*deviations[i].measured->specimen));
  }
  return both;
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

/// Batches by their number.
std::map<double, std::string> batches_of(const std::vector<Deviation>& deviations) {
  std::map<double, std::string> batches;
  for (const Deviation& d : deviations)
    if (const std::string& batch = d.measured->specimen->batch; !batch.empty())
      batches.emplace(d.measured->batch_step, batch);
  return batches;
}

/// A number for the batch of each specimen; none where it is not known.
template <class Value>
Regressor of_batches(const std::vector<Deviation>& deviations, Value value) {
  Regressor numbers;
  for (const Deviation& d : deviations)
    numbers.push_back(d.measured->specimen->batch.empty() ? std::nullopt
                                                          : std::optional<double>(value(d.measured->batch_step)));
  return numbers;
}

/// The slope over batches, and the differences of single batches from it.
void add_batch_rows(std::vector<HistoryRow>& rows, const std::vector<Deviation>& deviations, Feature feature,
                    tester::TestKind test, int fewest) {
  constexpr double kLeast = 1e-6;
  const auto [steps, values, pieces] =
      centred(deviations, of_batches(deviations, [](double step) { return step; }), feature);
  if (values.size() < fewest || steps.squaredNorm() < kLeast) return;
  std::map<std::string, Eigen::VectorXd> members;
  std::vector<Eigen::VectorXd> regressors{steps};
  std::vector<int> numbers{0};
  for (const auto& [step, batch] : batches_of(deviations)) {
    const auto is_of_batch = [step = step](double other) { return other == step ? 1.0 : 0.0; };
    const Eigen::VectorXd own = centred(deviations, of_batches(deviations, is_of_batch), feature).x;
    Eigen::VectorXd rest = own;
    for (const Eigen::VectorXd& before : regressors) rest -= before.dot(rest) / before.squaredNorm() * before;
    if (rest.squaredNorm() > kLeast * static_cast<double>(rest.size())) {
      regressors.push_back(rest);
      numbers.push_back(static_cast<int>(members.size()) + 1);
    }
    members.emplace(batch, own);
  }
  for (std::size_t k = 0; k < regressors.size(); ++k) {
    const Eigen::VectorXd& x = regressors[k];
    const double squares = x.squaredNorm();
    HistoryRow history{DataRow{.group = -1,
                               .feature = feature,
                               .kind = k == 0 ? RowKind::batch : RowKind::batch_rest,
                               .test = test,
                               .weight = 1.0 / squares,
                               .scatter = 0,
                               .batch = numbers[k]},
                       x.dot(values) / squares,
                       weight_of_pieces(x, pieces),
                       {}};
    for (const auto& [batch, own] : members) history.of_batches[batch] = x.dot(own) / squares;
    rows.push_back(std::move(history));
  }
}

}  // namespace

std::vector<HistoryRow> history_rows(const std::vector<std::vector<Measured>>& groups, int fewest) {
  std::vector<HistoryRow> rows;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness, tester::TestKind::tensile}) {
    const std::vector<Deviation> deviations = deviations_of(groups, test);
    const Regressor order = order_in_batch(deviations);
    for (const Feature feature : {Feature::log_modulus, Feature::log_toughness, Feature::log_peak}) {
      add_batch_rows(rows, deviations, feature, test, fewest);
      const auto [x, y, pieces] = centred(deviations, order, feature);
      if (y.size() < fewest || x.squaredNorm() < 1e-6) continue;
      rows.push_back({DataRow{-1, feature, RowKind::print_order, test, 1.0 / x.squaredNorm()},
                      x.dot(y) / x.squaredNorm(),
                      weight_of_pieces(x, pieces),
                      {}});
    }
  }
  return rows;
}

}  // namespace nacre::diagnosis
