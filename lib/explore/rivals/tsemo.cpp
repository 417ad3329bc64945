#include "explore/rivals/tsemo.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "explore/model_search.hpp"
#include "explore/rivals/cube_models.hpp"
#include "explore/surrogate_search.hpp"

namespace nacre::explore {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSpectralFeatures = 1000;
constexpr int kGenerations = 100, kPopulation = 100;  // as shipped

/// Frequencies of the Matern-5/2 kernel: its spectral density is a Student distribution with five degrees of freedom.
MatrixXd spectral_frequencies(const optimize::MaternKernel& kernel, RandomStream& random) {
  constexpr int kDegrees = 5;
  MatrixXd frequencies(kernel.lengths.size(), kSpectralFeatures);
  for (Index m = 0; m < frequencies.cols(); ++m) {
    double chi_squared = 0.0;
    for (int i = 0; i < kDegrees; ++i) chi_squared += std::pow(random.normal(), 2);
    const double stretch = std::sqrt(kDegrees / chi_squared);
    for (Index j = 0; j < frequencies.rows(); ++j) frequencies(j, m) = random.normal() * stretch / kernel.lengths[j];
  }
  return frequencies;
}

/// A function drawn from a posterior: one drawn from the prior, plus what carries it through the data (pathwise
/// conditioning: f(x) + k(x, X) (K + s_n^2 I)^-1 (y - f(X) - noise)).
class DrawnFunction {
 public:
  DrawnFunction(const ObjectiveModel& model, RandomStream& random)
      : model_(&model),
        frequencies_(spectral_frequencies(model.process.kernel(), random)),
        phases_(kSpectralFeatures),
        amplitudes_(kSpectralFeatures) {
    const optimize::MaternKernel& kernel = model.process.kernel();
    const double amplitude = kernel.signal_deviation * std::sqrt(2.0 / kSpectralFeatures);
    for (int m = 0; m < kSpectralFeatures; ++m) {
      phases_[m] = random.uniform(0.0, 2.0 * std::numbers::pi);
      amplitudes_[m] = amplitude * random.normal();
    }
    optimize::RegressionData missing = model.process.observations();
    missing.values -= prior(missing.inputs);
    for (Index i = 0; i < missing.values.size(); ++i) missing.values[i] -= kernel.noise_deviation * random.normal();
    // The process centres its values; what it takes off comes back with its mean.
    correction_ = std::make_unique<optimize::GaussianProcess>(std::move(missing), kernel);
  }

  /// In Pa, at the rows of `points`.
  VectorXd operator()(const MatrixXd& points) const {
    return (model_->mean + model_->deviation * (prior(points) + correction_->means(points)).array()).matrix();
  }

 private:
  VectorXd prior(const MatrixXd& points) const {
    const MatrixXd waves = ((points * frequencies_).rowwise() + phases_.transpose()).array().cos();
    return waves * amplitudes_;
  }

  const ObjectiveModel* model_;
  MatrixXd frequencies_;
  VectorXd phases_, amplitudes_;
  std::unique_ptr<optimize::GaussianProcess> correction_;
};

}  // namespace

std::vector<pattern::Pattern> tsemo_batch(const BatchRequest& batch_request) {
  const std::uint64_t seed = batch_seed(batch_request);
  RandomStream random(seed, "explore/tsemo");
  const std::vector<ObjectiveModel> models = fit_cube_models(batch_request.evaluated, seed);
  const DrawnFunction modulus(models[0], random), toughness(models[1], random);
  const auto drawn = [&](std::span<const pattern::Pattern> patterns) {
    const MatrixXd points = points_of(patterns);
    const VectorXd e = modulus(points), t = toughness(points);
    std::vector<optimize::Performance> performances;
    for (Index i = 0; i < e.size(); ++i) performances.push_back({e[i], t[i]});
    return performances;
  };
  const std::vector<Evaluated> start = best_by_rank(batch_request.evaluated, kPopulation);
  const std::vector<Evaluated> candidates =
      unseen(search_believed(drawn, start, {.generations = kGenerations, .population = kPopulation, .seed = seed}),
             batch_request);
  return largest_growth(candidates, batch_request.evaluated, batch_request.count);
}

}  // namespace nacre::explore
