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
#include "surrogate/pixel_network.hpp"

namespace nacre::surrogate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The prior's mean: least squares on 1, phi, phi^2, two conductances where they count, and what `base` predicts.
class Trend {
 public:
  Trend(const Samples& samples, const Predictor* base)
      : conducts_(samples.prior_mean == PriorMean::fraction_and_conductance), base_(base) {
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
    const int own_terms = conducts_ ? 5 : 3;
    MatrixXd terms(static_cast<Index>(at.size()), base_ ? own_terms + 1 : own_terms);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double fraction = at[i].rigid_fraction() - 0.7;  // about the middle of the design space
      auto row = terms.row(static_cast<Index>(i));
      row.head<3>() << 1.0, fraction, fraction * fraction;
      // Soft pixels as nearly nothing, and as a good part of the whole: chains of rigid pixels, and the mixture.
      constexpr double kNearlyNothing = 1e-3, kGoodPart = 0.05;
      if (conducts_) row.segment<2>(3) << log_conductance(at[i], kNearlyNothing), log_conductance(at[i], kGoodPart);
    }
    if (base_) {
      const std::vector<double> base = base_->means(at);
      terms.col(own_terms) = Eigen::Map<const VectorXd>(base.data(), terms.rows());
    }
    return terms;
  }

  bool conducts_;
  const Predictor* base_;
  VectorXd coefficients_;
};

std::vector<QuarterRows> rows_of(std::span<const pattern::Pattern> patterns) {
  std::vector<QuarterRows> rows;
  rows.reserve(patterns.size());
  for (const pattern::Pattern& pattern : patterns) rows.push_back(quarter_rows(pattern));
  return rows;
}

/// Lower triangle of the covariance of the samples, noise on its diagonal.
MatrixXd sample_covariance(const std::vector<QuarterRows>& rows, const PatchKernel& kernel) {
  const PatchCovariance covariance(kernel);
  const auto n = static_cast<Index>(rows.size());
  MatrixXd matrix(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i)
      matrix(i, j) = covariance(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
    matrix(j, j) += kernel.noise_variance;
  }
  return matrix;
}

class PatchProcess final : public Predictor {
 public:
  PatchProcess(const Samples& samples, const PatchKernel& kernel, std::shared_ptr<const Predictor> base)
      : base_(std::move(base)),
        trend_(samples, base_.get()),
        rows_(rows_of(samples.patterns)),
        covariance_(kernel),
        signal_variance_(kernel.signal_variance()),
        factor_(sample_covariance(rows_, kernel)) {
    assert(factor_.info() == Eigen::Success);
    const Eigen::Map<const VectorXd> values(samples.values.data(), static_cast<Index>(samples.values.size()));
    weights_ = factor_.solve(values - trend_(samples.patterns));
  }

  std::vector<double> means(std::span<const pattern::Pattern> at) const override {
    const VectorXd trend = trend_(at);
    std::vector<double> result(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      const QuarterRows rows = quarter_rows(at[i]);
      double sum = trend[static_cast<Index>(i)];
      for (std::size_t k = 0; k < rows_.size(); ++k)
        sum += weights_[static_cast<Index>(k)] * covariance_(rows, rows_[k]);
      result[i] = sum;
    }
    return result;
  }

  std::vector<Prediction> predict(std::span<const pattern::Pattern> at) const override {
    const VectorXd trend = trend_(at);
    MatrixXd cross = to_samples(rows_of(at));
    const VectorXd means = trend + cross.transpose() * weights_;
    factor_.matrixL().solveInPlace(cross);
    std::vector<Prediction> result(at.size());
    for (Index i = 0; i < cross.cols(); ++i) {
      const double variance = signal_variance_ - cross.col(i).squaredNorm();
      result[static_cast<std::size_t>(i)] = {means[i], std::sqrt(std::max(0.0, variance))};
    }
    return result;
  }

  MatrixXd covariance(std::span<const pattern::Pattern> at) const override {
    const std::vector<QuarterRows> rows = rows_of(at);
    MatrixXd cross = to_samples(rows), prior(cross.cols(), cross.cols());
    factor_.matrixL().solveInPlace(cross);
    for (Index j = 0; j < prior.cols(); ++j) {
      for (Index i = j; i < prior.rows(); ++i)
        prior(i, j) = prior(j, i) = covariance_(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
    }
    return prior - cross.transpose() * cross;
  }

 private:
  /// Covariance of every sample (rows) with these patterns (columns).
  MatrixXd to_samples(const std::vector<QuarterRows>& at) const {
    MatrixXd cross(static_cast<Index>(rows_.size()), static_cast<Index>(at.size()));
    for (Index i = 0; i < cross.cols(); ++i) {
      for (Index k = 0; k < cross.rows(); ++k)
        cross(k, i) = covariance_(at[static_cast<std::size_t>(i)], rows_[static_cast<std::size_t>(k)]);
    }
    return cross;
  }

  std::shared_ptr<const Predictor> base_;
  Trend trend_;
  std::vector<QuarterRows> rows_;
  PatchCovariance covariance_;
  double signal_variance_;
  Eigen::LLT<MatrixXd, Eigen::Lower> factor_;
  VectorXd weights_;
};

/// Unknowns of the kernel's search: logarithms of variances, logarithms of -log decay; standardised values.
constexpr int kUnknowns = 8;
constexpr double kCentre[kUnknowns] = {-1.5, -0.5, -0.7, -0.7, -2.0, -1.5, -2.5, -3.0};
constexpr double kSpread = 1.5;
constexpr double kReach = 2.5;  ///< bounds of the search, in spreads

double decay_from(double unknown) { return std::exp(-std::exp(unknown)); }

PatchKernel kernel_at(const std::vector<double>& at) {
  return {.pixel_variance = std::exp(at[0]),
          .patch_variance = std::exp(at[1]),
          .patch_decay = decay_from(at[4]),
          .region_variance = std::exp(at[2]),
          .region_decay = decay_from(at[5]),
          .whole_variance = std::exp(at[3]),
          .whole_decay = decay_from(at[6]),
          .noise_variance = std::exp(at[7])};
}

struct KernelQuestion {
  std::vector<QuarterRows> rows;
  VectorXd values;  ///< standardised while a kernel is looked for
};

/// Negative log posterior density of a kernel.
double misfit(const std::vector<double>& at, std::vector<double>&, void* data) {
  const KernelQuestion& question = *static_cast<KernelQuestion*>(data);
  const Eigen::LLT<MatrixXd, Eigen::Lower> factor(sample_covariance(question.rows, kernel_at(at)));
  if (factor.info() != Eigen::Success) return 1e10;
  const VectorXd reduced = factor.matrixL().solve(question.values);
  const MatrixXd& lower = factor.matrixLLT();
  double value = 0.5 * reduced.squaredNorm() + lower.diagonal().array().log().sum();
  for (int k = 0; k < kUnknowns; ++k) {
    const double apart = (at[static_cast<std::size_t>(k)] - kCentre[k]) / kSpread;
    value += 0.5 * apart * apart;
  }
  return value;
}

/// The most probable unknowns; BOBYQA, which needs no derivatives.
std::vector<double> most_probable(KernelQuestion& question) {
  std::vector<double> at(std::begin(kCentre), std::end(kCentre)), lower = at, upper = at;
  for (double& bound : lower) bound -= kReach * kSpread;
  for (double& bound : upper) bound += kReach * kSpread;
  nlopt::opt search(nlopt::LN_BOBYQA, kUnknowns);
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_initial_step(0.7);
  search.set_min_objective(misfit, &question);
  search.set_maxeval(90);
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

/// What the prior's mean leaves of at most kKernelSamples samples.
KernelQuestion deciding_samples(const Samples& samples, std::uint64_t seed, const Predictor* base) {
  assert(samples.patterns.size() == samples.values.size() && !samples.values.empty());
  const Trend trend(samples, base);
  const VectorXd residuals =
      Eigen::Map<const VectorXd>(samples.values.data(), static_cast<Index>(samples.values.size())) -
      trend(samples.patterns);
  RandomStream random(seed, "surrogate/kernel");
  KernelQuestion question;
  std::vector<double> values;
  for (const std::size_t i : chosen_indices(samples.values.size(), kKernelSamples, random)) {
    question.rows.push_back(quarter_rows(samples.patterns[i]));
    values.push_back(residuals[static_cast<Index>(i)]);
  }
  question.values = Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
  return question;
}

/// Kernels found lately, by content of the question: a search asks the same question many times. What is answered does
/// not depend on it.
class KernelMemory {
 public:
  std::vector<double> most_probable_of(KernelQuestion& question) {
    const std::string key = key_of(question);
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    std::vector<double> found = most_probable(question);
    const std::lock_guard lock(mutex_);
    constexpr std::size_t kMost = 256;
    if (known_.size() >= kMost) known_.clear();
    return known_[key] = std::move(found);
  }

 private:
  static std::string key_of(const KernelQuestion& question) {
    std::string bytes(reinterpret_cast<const char*>(question.rows.data()), question.rows.size() * sizeof(QuarterRows));
    bytes.append(reinterpret_cast<const char*>(question.values.data()),
                 static_cast<std::size_t>(question.values.size()) * sizeof(double));
    return content_hash(bytes);
  }
  std::mutex mutex_;
  std::map<std::string, std::vector<double>> known_;
};

}  // namespace

PatchKernel fit_patch_kernel(const Samples& samples, std::uint64_t seed, const Predictor* base) {
  KernelQuestion question = deciding_samples(samples, seed, base);
  const auto size = static_cast<std::size_t>(question.values.size());
  const double variance = question.values.squaredNorm() / static_cast<double>(size);
  const double scale = variance > 0.0 ? std::sqrt(variance) : 1.0;
  question.values /= scale;
  static KernelMemory memory;
  PatchKernel kernel = kernel_at(size < 10 ? std::vector<double>(std::begin(kCentre), std::end(kCentre))
                                           : memory.most_probable_of(question));
  for (double* part : {&kernel.pixel_variance, &kernel.patch_variance, &kernel.region_variance, &kernel.whole_variance,
                       &kernel.noise_variance}) {
    *part *= scale * scale;
  }
  return kernel;
}

double log_likelihood(const Samples& samples, const PatchKernel& kernel, std::uint64_t seed, const Predictor* base) {
  const KernelQuestion deciding = deciding_samples(samples, seed, base);
  const Eigen::LLT<MatrixXd, Eigen::Lower> factor(sample_covariance(deciding.rows, kernel));
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
