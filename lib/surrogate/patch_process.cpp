#include "surrogate/patch_process.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <string>

#include <Eigen/Dense>
#include <nlopt.hpp>

#include "base/hash.hpp"
#include "base/random.hpp"

namespace nacre::surrogate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The prior's mean: least squares on 1, phi, phi^2, the features of the trend, and the predictions of `base`.
class PriorMean {
 public:
  PriorMean(const Samples& samples, const Predictor* base) : features_(samples.trend), base_(base) {
    const MatrixXd terms = terms_at(samples.patterns);
    const Eigen::Map<const VectorXd> values(samples.values.data(), static_cast<Index>(samples.values.size()));
    // The ridge decides only where the samples do not (all of one fraction, fewer samples than terms).
    constexpr double kRidge = 1e-3;
    MatrixXd normal = terms.transpose() * terms;
    normal.diagonal().array() += kRidge;
    coefficients_ = normal.ldlt().solve(terms.transpose() * values);
  }
  VectorXd operator()(std::span<const pattern::Pattern> at) const { return terms_at(at) * coefficients_; }

 private:
  MatrixXd terms_at(std::span<const pattern::Pattern> at) const {
    const MatrixXd features = features_ ? features_(at) : MatrixXd();
    const Index own = 3 + features.cols();
    MatrixXd terms(static_cast<Index>(at.size()), base_ ? own + 1 : own);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double fraction = at[i].rigid_fraction() - 0.7;  // about the middle of the design space
      terms.row(static_cast<Index>(i)).head<3>() << 1.0, fraction, fraction * fraction;
    }
    if (features.cols() > 0) terms.middleCols(3, features.cols()) = features;
    if (base_) {
      const std::vector<double> base = base_->means(at);
      terms.col(own) = Eigen::Map<const VectorXd>(base.data(), terms.rows());
    }
    return terms;
  }

  Features features_;
  const Predictor* base_;
  VectorXd coefficients_;
};

/// Patterns in the form that the covariance uses.
struct Points {
  std::vector<QuarterRows> rows;
  MatrixXd features;         ///< a column for each pattern; without rows when there are none
  VectorXd noise_variances;  ///< of the values there; empty: not known
  std::size_t size() const { return rows.size(); }
  bool has_known_noise() const { return noise_variances.size() > 0; }
};

Points points_of(std::span<const pattern::Pattern> patterns, const Features& likeness,
                 std::span<const double> noise_variances = {}) {
  assert(noise_variances.empty() || noise_variances.size() == patterns.size());
  Points points;
  points.noise_variances =
      Eigen::Map<const VectorXd>(noise_variances.data(), static_cast<Index>(noise_variances.size()));
  points.rows.reserve(patterns.size());
  for (const pattern::Pattern& pattern : patterns) points.rows.push_back(quarter_rows(pattern));
  points.features =
      likeness ? MatrixXd(likeness(patterns).transpose()) : MatrixXd(0, static_cast<Index>(patterns.size()));
  return points;
}

/// Of patches and features together, and of a pattern's own part with itself.
class Covariance {
 public:
  Covariance(const PatchKernel& kernel, double own_variance)
      : patches_(kernel), kernel_(kernel), own_variance_(own_variance) {}
  double operator()(const Points& a, std::size_t i, const Points& b, std::size_t j) const {
    double value = patches_(a.rows[i], b.rows[j]);
    if (own_variance_ > 0.0 && a.rows[i] == b.rows[j]) value += own_variance_;
    if (a.features.rows() == 0) return value;
    const double apart = (a.features.col(static_cast<Index>(i)) - b.features.col(static_cast<Index>(j))).squaredNorm() /
                         static_cast<double>(a.features.rows());
    return value +
           kernel_.feature_variance * std::exp(-0.5 * apart / (kernel_.feature_length * kernel_.feature_length));
  }
  /// a.size() x b.size().
  MatrixXd between(const Points& a, const Points& b) const {
    MatrixXd matrix(static_cast<Index>(a.size()), static_cast<Index>(b.size()));
    for (std::size_t j = 0; j < b.size(); ++j)
      for (std::size_t i = 0; i < a.size(); ++i)
        matrix(static_cast<Index>(i), static_cast<Index>(j)) = (*this)(a, i, b, j);
    return matrix;
  }
  /// Lower triangle of that of points with themselves.
  MatrixXd within(const Points& points) const {
    const auto n = static_cast<Index>(points.size());
    MatrixXd matrix(n, n);
    for (Index j = 0; j < n; ++j)
      for (Index i = j; i < n; ++i) matrix(i, j) = (*this)(points, i, points, j);
    return matrix;
  }

 private:
  PatchCovariance patches_;
  PatchKernel kernel_;
  double own_variance_;
};

/// Variance of what neighbourhoods cannot explain of a pattern and is not noise.
double own_variance(const Points& samples, const PatchKernel& kernel) {
  return samples.has_known_noise() ? kernel.noise_variance : 0.0;
}

/// Lower triangle of the covariance of the samples, noise on its diagonal.
MatrixXd sample_covariance(const Points& points, const PatchKernel& kernel) {
  MatrixXd matrix = Covariance(kernel, own_variance(points, kernel)).within(points);
  if (points.has_known_noise())
    matrix.diagonal() += points.noise_variances;
  else
    matrix.diagonal().array() += kernel.noise_variance;
  return matrix;
}

class PatchProcess final : public Predictor {
 public:
  PatchProcess(const Samples& samples, const PatchKernel& kernel, std::shared_ptr<const Predictor> base)
      : base_(std::move(base)),
        trend_(samples, base_.get()),
        likeness_(samples.likeness),
        samples_(points_of(samples.patterns, likeness_, samples.noise_variances)),
        covariance_(kernel, own_variance(samples_, kernel)),
        signal_variance_(kernel.signal_variance() + own_variance(samples_, kernel)),
        factor_(sample_covariance(samples_, kernel)) {
    assert(factor_.info() == Eigen::Success);
    const Eigen::Map<const VectorXd> values(samples.values.data(), static_cast<Index>(samples.values.size()));
    weights_ = factor_.solve(values - trend_(samples.patterns));
  }

  std::vector<double> means(std::span<const pattern::Pattern> at) const override {
    const VectorXd means = trend_(at) + covariance_.between(samples_, points_of(at, likeness_)).transpose() * weights_;
    return {means.begin(), means.end()};
  }

  std::vector<PatternPrediction> predict(std::span<const pattern::Pattern> at) const override {
    MatrixXd cross = covariance_.between(samples_, points_of(at, likeness_));
    const VectorXd means = trend_(at) + cross.transpose() * weights_;
    factor_.matrixL().solveInPlace(cross);
    std::vector<PatternPrediction> result(at.size());
    for (Index i = 0; i < cross.cols(); ++i) {
      const double variance = signal_variance_ - cross.col(i).squaredNorm();
      result[i] = {means[i], std::sqrt(std::max(0.0, variance))};
    }
    return result;
  }

  MatrixXd covariance(std::span<const pattern::Pattern> at) const override {
    const Points points = points_of(at, likeness_);
    MatrixXd cross = covariance_.between(samples_, points);
    factor_.matrixL().solveInPlace(cross);
    const MatrixXd prior = covariance_.within(points).selfadjointView<Eigen::Lower>();
    return prior - cross.transpose() * cross;
  }

 private:
  std::shared_ptr<const Predictor> base_;
  PriorMean trend_;
  Features likeness_;
  Points samples_;
  Covariance covariance_;
  double signal_variance_;
  Eigen::LLT<MatrixXd, Eigen::Lower> factor_;
  VectorXd weights_;
};

/// Unknowns of the kernel's search: logarithms of variances, logarithms of -log decay; of features, where there are
/// any, the logarithms of variance and length; standardised values.
constexpr double kCentre[] = {-1.5, -0.5, -0.7, -0.7, -2.0, -1.5, -2.5, -3.0, -0.7, -1.2};
constexpr std::size_t kPatchUnknowns = 8;
constexpr double kSpread = 1.5;
constexpr double kReach = 2.5;  ///< bounds of the search, in spreads

double decay_from(double unknown) { return std::exp(-std::exp(unknown)); }

PatchKernel kernel_at(const std::vector<double>& at) {
  const bool has_features = at.size() > kPatchUnknowns;
  return {.pixel_variance = std::exp(at[0]),
          .patch_variance = std::exp(at[1]),
          .patch_decay = decay_from(at[4]),
          .region_variance = std::exp(at[2]),
          .region_decay = decay_from(at[5]),
          .whole_variance = std::exp(at[3]),
          .whole_decay = decay_from(at[6]),
          .feature_variance = has_features ? std::exp(at[8]) : 0.0,
          .feature_length = has_features ? std::exp(at[9]) : 1.0,
          .noise_variance = std::exp(at[7])};
}

struct KernelPosterior {
  Points points;
  VectorXd values;  ///< standardised while a kernel is searched
  /// Where a search for its kernel begins.
  std::vector<double> centre() const {
    return {std::begin(kCentre), points.features.rows() > 0 ? std::end(kCentre) : std::begin(kCentre) + kPatchUnknowns};
  }
};

/// Negative log posterior density of a kernel.
double misfit(const std::vector<double>& at, std::vector<double>&, void* data) {
  const KernelPosterior& posterior = *static_cast<KernelPosterior*>(data);
  const Eigen::LLT<MatrixXd, Eigen::Lower> factor(sample_covariance(posterior.points, kernel_at(at)));
  if (factor.info() != Eigen::Success) return 1e10;
  const VectorXd reduced = factor.matrixL().solve(posterior.values);
  const MatrixXd& lower = factor.matrixLLT();
  double value = 0.5 * reduced.squaredNorm() + lower.diagonal().array().log().sum();
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double apart = (at[k] - kCentre[k]) / kSpread;
    value += 0.5 * apart * apart;
  }
  return value;
}

/// The most probable unknowns; BOBYQA, which needs no derivatives.
std::vector<double> most_probable(KernelPosterior& posterior) {
  std::vector<double> at = posterior.centre(), lower = at, upper = at;
  for (double& bound : lower) bound -= kReach * kSpread;
  for (double& bound : upper) bound += kReach * kSpread;
  nlopt::opt search(nlopt::LN_BOBYQA, static_cast<unsigned>(at.size()));
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_initial_step(0.7);
  search.set_min_objective(misfit, &posterior);
  constexpr int kMostPerUnknown = 11;
  search.set_maxeval(kMostPerUnknown * static_cast<int>(at.size()));
  search.set_ftol_abs(0.05);
  try {
    double value = 0.0;
    search.optimize(at, value);
  } catch (const std::runtime_error&) {  // no progress possible any more: `at` is the best so far
  }
  return at;
}

/// Up to `count` of the indices below `size`, in increasing order.
std::vector<std::size_t> chosen_indices(std::size_t size, std::size_t count, RandomStream& random) {
  std::vector<std::size_t> indices(size);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (size <= count) return indices;
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(indices[i], indices[i + static_cast<std::size_t>(random.index(static_cast<int>(size - i)))]);
  }
  indices.resize(count);
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// Residuals of the prior's mean at no more than kKernelSamples samples.
KernelPosterior deciding_samples(const Samples& samples, std::uint64_t seed, const Predictor* base) {
  assert(samples.patterns.size() == samples.values.size() && !samples.values.empty());
  const PriorMean trend(samples, base);
  const VectorXd residuals =
      Eigen::Map<const VectorXd>(samples.values.data(), static_cast<Index>(samples.values.size())) -
      trend(samples.patterns);
  RandomStream random(seed, "surrogate/kernel");
  std::vector<pattern::Pattern> patterns;
  std::vector<double> values, noise_variances;
  for (const std::size_t i : chosen_indices(samples.values.size(), kKernelSamples, random)) {
    patterns.push_back(samples.patterns[i]);
    values.push_back(residuals[i]);
    if (!samples.noise_variances.empty()) noise_variances.push_back(samples.noise_variances[i]);
  }
  KernelPosterior posterior{.points = points_of(patterns, samples.likeness, noise_variances), .values = {}};
  posterior.values = Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
  return posterior;
}

/// Kernels found lately, by content of their samples: a search fits to the same samples many times. Results do not
/// depend on it.
class KernelMemory {
 public:
  std::vector<double> most_probable_of(KernelPosterior& posterior) {
    const std::string key = key_of(posterior);
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    std::vector<double> found = most_probable(posterior);
    const std::lock_guard lock(mutex_);
    constexpr std::size_t kMost = 256;
    if (known_.size() >= kMost) known_.clear();
    return known_[key] = std::move(found);
  }

 private:
  static std::string key_of(const KernelPosterior& posterior) {
    const Points& points = posterior.points;
    std::string bytes(reinterpret_cast<const char*>(points.rows.data()), points.rows.size() * sizeof(QuarterRows));
    const auto append = [&](const auto& numbers) {
      bytes.append(reinterpret_cast<const char*>(numbers.data()),
                   static_cast<std::size_t>(numbers.size()) * sizeof(double));
    };
    append(posterior.values);
    append(points.features);
    append(points.noise_variances);
    return content_hash(bytes);
  }
  std::mutex mutex_;
  std::map<std::string, std::vector<double>> known_;
};

}  // namespace

PatchKernel fit_patch_kernel(const Samples& samples, std::uint64_t seed, const Predictor* base) {
  KernelPosterior posterior = deciding_samples(samples, seed, base);
  const auto size = static_cast<std::size_t>(posterior.values.size());
  const double variance = posterior.values.squaredNorm() / static_cast<double>(size);
  const double scale = variance > 0.0 ? std::sqrt(variance) : 1.0;
  posterior.values /= scale;
  posterior.points.noise_variances /= scale * scale;
  static KernelMemory memory;
  PatchKernel kernel = kernel_at(size < 10 ? posterior.centre() : memory.most_probable_of(posterior));
  for (double* part : {&kernel.pixel_variance, &kernel.patch_variance, &kernel.region_variance, &kernel.whole_variance,
                       &kernel.feature_variance, &kernel.noise_variance}) {
    *part *= scale * scale;
  }
  return kernel;
}

double log_likelihood(const Samples& samples, const PatchKernel& kernel, std::uint64_t seed, const Predictor* base) {
  const KernelPosterior deciding = deciding_samples(samples, seed, base);
  const Eigen::LLT<MatrixXd, Eigen::Lower> factor(sample_covariance(deciding.points, kernel));
  assert(factor.info() == Eigen::Success);
  const VectorXd reduced = factor.matrixL().solve(deciding.values);
  constexpr double kLogTwoPi = 1.8378770664093453;
  return -0.5 * reduced.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum() -
         0.5 * kLogTwoPi * static_cast<double>(deciding.values.size());
}

std::unique_ptr<Predictor> make_patch_process(const Samples& samples, const PatchKernel& kernel,
                                              std::shared_ptr<const Predictor> base) {
  assert(samples.patterns.size() == samples.values.size() && !samples.values.empty());
  return std::make_unique<PatchProcess>(samples, kernel, std::move(base));
}

}  // namespace nacre::surrogate
