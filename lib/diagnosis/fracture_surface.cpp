#include "diagnosis/fracture_surface.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <numeric>

#include "base/matern.hpp"
#include "base/parallel.hpp"
#include "base/square.hpp"
#include "diagnosis/coordinates.hpp"
#include "material/effect_library.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

double matern52_at(double distance) { return matern52(std::sqrt(5.0) * distance); }

/// The mean over the columns and the leading principal components of what it leaves, `count` in all: columns x count,
/// orthonormal.
Eigen::MatrixXd mean_and_components(const Eigen::MatrixXd& values, Eigen::Index count) {
  const Eigen::Index columns = values.cols();
  Eigen::MatrixXd basis(columns, count);
  if (count == 0) return basis;
  basis.col(0).setConstant(1.0 / std::sqrt(static_cast<double>(columns)));
  Eigen::MatrixXd left = values.rowwise() - values.colwise().mean();
  left.colwise() -= Eigen::VectorXd(left.rowwise().mean());
  const Eigen::BDCSVD<Eigen::MatrixXd> parts(left, Eigen::ComputeThinV);
  basis.rightCols(count - 1) = parts.matrixV().leftCols(count - 1);
  return basis;
}

int library_index(std::string_view name) {
  const auto library = material::effect_library();
  const auto found =
      std::find_if(library.begin(), library.end(), [&](const material::Effect& e) { return e.name == name; });
  return static_cast<int>(found - library.begin());
}

}  // namespace

double effect_covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const EmulatorRules& rules) {
  const auto m = [&](double distance) { return matern52_at(std::abs(distance) / rules.effect_length); };
  const double size = a[0] * b[0] + m(a[0] - b[0]) - m(a[0]) * m(b[0]);
  const double shape = a.size() > 1 ? m((a.tail(a.size() - 1) - b.tail(b.size() - 1)).norm()) : 1.0;
  return size * shape;
}

FractureSurface::FractureSurface(const Observations& observations, const std::vector<int>& groups,
                                 std::vector<FractureRun> runs, const material::ToughnessParameters& centre,
                                 const EmulatorRules& rules)
    : reading_(observations.reading), runs_(std::move(runs)), centre_(to_vector(centre)), rules_(rules) {
  for (const int group : groups) batch_steps_.push_back(observations.groups[group].batch_step);
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean || row.test != tester::TestKind::toughness) continue;
    const auto at = std::ranges::find(groups, row.group);
    rows_.push_back(
        {i, static_cast<int>(at - groups.begin()), row.feature, is_notched_bulk(observations.groups[row.group])});
  }
  learn();
}

FractureSurface::SurfacePoint FractureSurface::point_of(const material::ParameterSet& set) const {
  SurfacePoint point;
  const material::ToughnessVector eta = to_vector(set.toughness);
  point.log_eta.resize(static_cast<Eigen::Index>(sysid::kSearchedEta.size()));
  for (Eigen::Index k = 0; k < point.log_eta.size(); ++k) {
    const std::size_t i = sysid::kSearchedEta[k];
    point.log_eta[k] = std::log(eta[i] / centre_[i]);
  }
  for (const auto& [name, values] : simulated_side(set).extensions) {
    const material::Effect& effect = *material::find_effect(name);
    Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
    for (std::size_t p = 0; p < values.size(); ++p) {
      x[p] = material::strength_of(effect.parameters[p], values[p]);
    }
    if (std::abs(x[0]) > rules_.no_effect) point.effects.emplace(library_index(name), x);
  }
  return point;
}

double FractureSurface::covariance(const Kernel& kernel, const SurfacePoint& a, const SurfacePoint& b) const {
  const double near = matern52_at((a.log_eta - b.log_eta).norm() / rules_.curved_length);
  double sum =
      square(rules_.level_sd) + square(kernel.linear) * a.log_eta.dot(b.log_eta) + square(kernel.curved) * near;
  for (const auto& [effect, x] : a.effects) {
    const auto other = b.effects.find(effect);
    const auto amplitude = kernel.effect.find(effect);
    if (other == b.effects.end() || amplitude == kernel.effect.end()) continue;
    sum += square(amplitude->second) * effect_covariance(x, other->second, rules_) *
           (1.0 - kernel.own_share + kernel.own_share * near);
  }
  return sum;
}

Eigen::MatrixXd FractureSurface::covariance_matrix(const Kernel& kernel, const std::vector<int>& at) const {
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      matrix(i, j) = matrix(j, i) = covariance(kernel, points_[at[i]], points_[at[j]]);
    matrix(i, i) += square(kernel.noise);
  }
  return matrix;
}

/// Amplitude of every effect: root mean square over its runs of their changes beyond the base, less what chance does,
/// per unit of the effect's own deviation.
void FractureSurface::learn_effects(Learnt& learnt, const Eigen::MatrixXd& centred) const {
  const std::vector<int> base = base_runs();
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance_matrix(learnt.kernel, base));
  const Eigen::MatrixXd weights = factor.solve(centred(base, Eigen::all));
  // Sums, not ratios: a run with hardly any of the effect hardly informs its amplitude.
  std::map<int, std::pair<double, double>> squares;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (points_[k].effects.size() != 1) continue;
    Eigen::VectorXd row(static_cast<Eigen::Index>(base.size()));
    for (std::size_t j = 0; j < base.size(); ++j) row[j] = covariance(learnt.kernel, points_[k], points_[base[j]]);
    const Eigen::RowVectorXd change = centred.row(static_cast<Eigen::Index>(k)) - row.transpose() * weights;
    const double by_chance =
        covariance(learnt.kernel, points_[k], points_[k]) + square(learnt.kernel.noise) - row.dot(factor.solve(row));
    const auto& [effect, x] = *points_[k].effects.begin();
    const auto columns = static_cast<double>(change.size());
    auto& [sum, expected] = squares[effect];
    sum += change.squaredNorm() - by_chance * columns;
    expected += effect_covariance(x, x, rules_) * columns;
  }
  for (const auto& [effect, sums] : squares)
    learnt.kernel.effect[effect] =
        std::max(std::sqrt(std::max(sums.first / sums.second, 0.0)), rules_.least_amplitude * learnt.kernel.noise);
  learnt.kernel.own_share = likeliest_share(learnt.kernel, centred);
}

double FractureSurface::likeliest_share(Kernel kernel, const Eigen::MatrixXd& targets) const {
  double best = kernel.own_share, least = std::numeric_limits<double>::infinity();
  for (const double share : rules_.own_shares) {
    kernel.own_share = share;
    const double cost = surprise(kernel, all_runs(), targets);
    if (cost < least) least = cost, best = share;
  }
  return best;
}

double FractureSurface::surprise(const Kernel& kernel, const std::vector<int>& at,
                                 const Eigen::MatrixXd& targets) const {
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance_matrix(kernel, at));
  return 0.5 * factor.matrixL().solve(targets).squaredNorm() +
         static_cast<double>(targets.cols()) * factor.matrixLLT().diagonal().array().log().sum();
}

FractureSurface::Kernel FractureSurface::likeliest_kernel(const std::vector<int>& at,
                                                          const Eigen::MatrixXd& targets) const {
  struct Posterior {
    const FractureSurface& surface;
    const std::vector<int>& at;
    const Eigen::MatrixXd& targets;
  } posterior{*this, at, targets};
  const auto cost = [](const std::vector<double>& x, std::vector<double>&, void* data) {
    const Posterior& own = *static_cast<Posterior*>(data);
    const Kernel kernel{std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), {}};
    // A weak prior about the start keeps the amplitudes that the runs do not determine.
    const EmulatorRules& rules = own.surface.rules_;
    double squares = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) squares += square((x[i] - rules.kernel[i]) / rules.kernel_sd);
    return 0.5 * squares + own.surface.surprise(kernel, own.at, own.targets);
  };
  std::vector<double> x(rules_.kernel.begin(), rules_.kernel.end());
  if (at.size() >= 5) {
    nlopt::opt search(nlopt::LN_SBPLX, 3);
    search.set_lower_bounds({-4.0, -5.0, -5.0});
    search.set_upper_bounds({3.0, 2.0, 1.0});
    search.set_initial_step(0.5);
    search.set_maxeval(50);
    search.set_min_objective(cost, &posterior);
    try {
      double smallest = 0.0;
      search.optimize(x, smallest);
    } catch (const nlopt::roundoff_limited&) {  // the point reached is the best that doubles can tell
    }
  }
  return {std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), {}};
}

std::vector<int> FractureSurface::half_nearest_to_the_centre() const {
  std::vector<int> order(points_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return points_[a].log_eta.squaredNorm() < points_[b].log_eta.squaredNorm(); });
  order.resize((order.size() + 1) / 2);
  return order;
}

std::vector<int> FractureSurface::base_runs() const {
  std::vector<int> base;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (points_[k].effects.empty()) base.push_back(static_cast<int>(k));
  return base;
}

std::vector<int> FractureSurface::all_runs() const {
  std::vector<int> all(points_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

FractureSurface::Learnt FractureSurface::learn_columns(const Eigen::MatrixXd& values) const {
  Learnt learnt{.kernel = {},
                .mean = values.colwise().mean(),
                .weights = {},
                .factor = {},
                .left_out = {},
                .run_variance = Eigen::VectorXd(values.cols()),
                .variance_scale = Eigen::VectorXd(values.cols())};
  Eigen::MatrixXd centred = values.rowwise() - learnt.mean;
  const double spread = std::max(std::sqrt(centred.squaredNorm() / static_cast<double>(centred.size())), 1e-9);
  centred /= spread;
  const std::vector<int> base = base_runs();
  learnt.kernel = likeliest_kernel(base, centred(base, Eigen::all));
  learn_effects(learnt, centred);
  learnt.factor.compute(covariance_matrix(learnt.kernel, all_runs()));
  const auto count = static_cast<Eigen::Index>(points_.size());
  const Eigen::MatrixXd inverse = learnt.factor.solve(Eigen::MatrixXd::Identity(count, count));
  learnt.weights = spread * (inverse * centred);
  learnt.left_out = inverse.diagonal().cwiseInverse().asDiagonal() * learnt.weights;
  const std::vector<int> near = half_nearest_to_the_centre();
  double expected = 0.0;  // of a run that is left out
  for (const int k : near) expected += 1.0 / inverse(k, k) / static_cast<double>(near.size());
  learnt.run_variance = learnt.left_out(near, Eigen::all).cwiseAbs2().colwise().mean();
  learnt.variance_scale = learnt.run_variance / expected;
  return learnt;
}

FractureSurface::LearntFeature FractureSurface::learn_feature(std::vector<int> rows,
                                                              const Eigen::MatrixXd& values) const {
  const std::vector<int> base = base_runs();
  const std::size_t count = std::min({static_cast<std::size_t>(rules_.components), rows.size() / 2,
                                      base.size() / static_cast<std::size_t>(rules_.runs_of_component)});
  LearntFeature learnt{std::move(rows), {}, {}, {}};
  learnt.basis = mean_and_components(values(base, Eigen::all), static_cast<Eigen::Index>(count));
  const Eigen::MatrixXd scores = values * learnt.basis;
  for (const auto& score : scores.colwise()) learnt.components.push_back(learn_columns(score));
  learnt.rest = learn_columns(values - scores * learnt.basis.transpose());
  return learnt;
}

void FractureSurface::learn() {
  for (const FractureRun& run : runs_) points_.push_back(point_of(run.parameters));
  const auto count = static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd values(count, static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    double sum = 0.0;
    int known = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& prediction = runs_[k].predictions[rows_[r].group];
      const auto value = value_of(shown_features(prediction, {}, reading_), rows_[r].feature);
      values(k, static_cast<Eigen::Index>(r)) = value.value_or(std::nan(""));
      if (value) sum += *value, ++known;
    }
    // A run that failed does not count: the mean of the others takes its place.
    for (Eigen::Index k = 0; k < count; ++k)
      if (std::isnan(values(k, static_cast<Eigen::Index>(r))))
        values(k, static_cast<Eigen::Index>(r)) = known > 0 ? sum / known : 0.0;
  }
  // What layouts have in common homogeneous specimens have not.
  std::map<std::pair<Feature, bool>, std::vector<int>> by_kind;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    by_kind[{rows_[r].feature, rows_[r].is_bulk}].push_back(static_cast<int>(r));
  const std::vector<std::pair<std::pair<Feature, bool>, std::vector<int>>> kinds(by_kind.begin(), by_kind.end());
  learnt_.assign(kinds.size(), {});
  parallel_for(kinds.size(), [&](int k) {
    const std::vector<int>& rows = kinds[k].second;
    learnt_[k] = learn_feature(rows, values(Eigen::all, rows));
  });
  run_variance_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.size()));
  for (const LearntFeature& learnt : learnt_) {
    run_variance_(learnt.rows) = learnt.rest.run_variance;
    for (std::size_t k = 0; k < learnt.components.size(); ++k)
      run_variance_(learnt.rows) +=
          learnt.components[k].run_variance[0] * learnt.basis.col(static_cast<Eigen::Index>(k)).cwiseAbs2();
  }
}

/// Change by the testing machine in every row: on the curves of the runs nearest to the point, averaged.
Eigen::VectorXd FractureSurface::machine_change(const material::ParameterSet& set, const SurfacePoint& at) const {
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    double distance = (points_[k].log_eta - at.log_eta).squaredNorm();
    for (const auto& [effect, x] : points_[k].effects) {
      const auto own = at.effects.find(effect);
      distance += own == at.effects.end() ? 1.0 + x.squaredNorm() : (own->second - x).squaredNorm();
    }
    for (const auto& [effect, x] : at.effects)
      distance += points_[k].effects.contains(effect) ? 0.0 : 1.0 + x.squaredNorm();
    order.emplace_back(distance, static_cast<int>(k));
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min<std::size_t>(order.size(), static_cast<std::size_t>(rules_.nearest)));
  Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.size()));
  Eigen::VectorXd known = change;
  for (const auto& [distance, k] : order) {
    const FractureRun& run = runs_[k];
    std::vector<FeatureValues> plain, shown;
    for (std::size_t g = 0; g < batch_steps_.size(); ++g) {
      plain.push_back(shown_features(run.predictions[g], {}, reading_));
      shown.push_back(shown_features(run.predictions[g], set.extensions, reading_, {.batch_step = batch_steps_[g]}));
    }
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto group = static_cast<std::size_t>(rows_[r].group);
      const auto& before = value_of(plain[group], rows_[r].feature);
      const auto& after = value_of(shown[group], rows_[r].feature);
      if (!before || !after) continue;
      change[r] += *after - *before;
      known[r] += 1.0;
    }
  }
  return change.cwiseQuotient(known.cwiseMax(1.0));
}

Eigen::VectorXd FractureSurface::predict(const material::ParameterSet& set) const {
  const SurfacePoint at = point_of(set);
  Eigen::VectorXd result(static_cast<Eigen::Index>(rows_.size()));
  for (const LearntFeature& learnt : learnt_) {
    result(learnt.rows) = predicted(learnt.rest, at).transpose();
    for (std::size_t k = 0; k < learnt.components.size(); ++k)
      result(learnt.rows) += predicted(learnt.components[k], at)[0] * learnt.basis.col(static_cast<Eigen::Index>(k));
  }
  const bool machine = std::any_of(set.extensions.begin(), set.extensions.end(), [](const auto& extension) {
    return material::acts_in_measurement(extension.first) &&
           std::any_of(extension.second.begin(), extension.second.end(), [](double v) { return v != 0.0; });
  });
  if (machine) result += machine_change(set, at);
  return result;
}

Eigen::VectorXd FractureSurface::covariance_with_runs(const Kernel& kernel, const SurfacePoint& at) const {
  Eigen::VectorXd covariances(static_cast<Eigen::Index>(points_.size()));
  for (std::size_t k = 0; k < points_.size(); ++k) covariances[k] = covariance(kernel, at, points_[k]);
  return covariances;
}

Eigen::RowVectorXd FractureSurface::predicted(const Learnt& learnt, const SurfacePoint& at) const {
  return learnt.mean + covariance_with_runs(learnt.kernel, at).transpose() * learnt.weights;
}

Eigen::VectorXd FractureSurface::variance_of_mean(const Learnt& learnt, const SurfacePoint& at) const {
  const Eigen::VectorXd to_runs = covariance_with_runs(learnt.kernel, at);
  const double left = covariance(learnt.kernel, at, at) - to_runs.dot(learnt.factor.solve(to_runs));
  return learnt.variance_scale * std::max(left, 0.0);
}

ErrorOfMean FractureSurface::error_of_mean(const material::ParameterSet& set) const {
  const SurfacePoint at = point_of(set);
  const auto rows = static_cast<Eigen::Index>(rows_.size());
  ErrorOfMean error{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, 0)};
  for (const LearntFeature& learnt : learnt_) {
    error.own(learnt.rows) = variance_of_mean(learnt.rest, at);
    const Eigen::Index first = error.shared.cols(), count = learnt.basis.cols();
    error.shared.conservativeResize(Eigen::NoChange, first + count);
    error.shared.rightCols(count).setZero();
    for (Eigen::Index k = 0; k < count; ++k)
      error.shared.col(first + k)(learnt.rows) =
          std::sqrt(variance_of_mean(learnt.components[k], at)[0]) * learnt.basis.col(k);
  }
  return error;
}

Eigen::MatrixXd FractureSurface::own_errors(Feature feature) const {
  for (const LearntFeature& learnt : learnt_)
    if (const SurfaceRow& first = rows_[learnt.rows.front()]; first.feature == feature && !first.is_bulk)
      return learnt.rest.left_out;
  return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(runs_.size()), 0);
}

FeatureValues FractureSurface::batch_step(const material::ParameterSet& set) const {
  FeatureValues slopes;
  std::array<int, kFeatureCount> count{};
  const FractureRun& run = runs_.front();
  for (std::size_t g = 0; g < batch_steps_.size(); ++g) {
    const FeatureValues before = shown_features(run.predictions[g], set.extensions, reading_, {.batch_step = 0.0}),
                        after = shown_features(run.predictions[g], set.extensions, reading_, {.batch_step = 1.0});
    for (std::size_t f = 0; f < kFeatureCount; ++f)
      if (before[f] && after[f]) slopes[f] = slopes[f].value_or(0.0) + (*after[f] - *before[f]), ++count[f];
  }
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    if (slopes[f]) *slopes[f] /= count[f];
  return slopes;
}

}  // namespace nacre::diagnosis
