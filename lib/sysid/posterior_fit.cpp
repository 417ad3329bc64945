#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/random.hpp"
#include "optimize/sobol.hpp"
#include "sysid/emulator.hpp"
#include "sysid/eta_moves.hpp"
#include "sysid/feature_posterior.hpp"
#include "sysid/recorded_fit.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

constexpr double kFirstRadius = 0.7;  // of the trust region, in natural logarithms: a factor of two
constexpr double kLargestRadius = 1.0;
constexpr double kSmallestRadius = 0.2;  // below it the jumps decide; evaluations then average over them
constexpr double kLeastGain = 0.5;       // in -log posterior
constexpr int kIdleBatches = 4;  // in a row within the smallest radius without that gain: nothing more is to be found

/// Parameters that decide how a load is shared between the materials. Level and shape of all curves follow from the
/// common scales of moduli and failure energies; what these leave has valleys longer than a trust region's way.
constexpr std::array<std::size_t, 5> kSplits = {kE0, kE0 + 2, kW0, kW0 + 2, kGamma};
constexpr std::size_t kSpread = 9;  // points spread over the splits before the search narrows

class PosteriorFit final : public RecordedFit {
 public:
  PosteriorFit(FitData data, const FitSettings& settings, std::vector<double> spans, std::vector<Point> others)
      : RecordedFit(std::move(data), settings, 0.0),
        spans_(std::move(spans)),
        others_(std::move(others)),
        emulator_(spans_, data_.measured.size()),
        posterior_(data_, settings.start, settings.floor),
        splits_(static_cast<int>(kSplits.size()), settings.seed) {}

  std::vector<Point> ask() override {
    if (asked_.empty() && !finished_) asked_ = propose();
    finished_ = asked_.empty();
    return asked_;
  }

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      const double objective = toughness_objective(data_.measured, data_.weights, predictions[k]);
      record(asked_[k], std::move(predictions[k]), objective);
    }
    asked_.clear();
    const double before = smallest_cost_;
    learn();
    if (is_spreading()) return;
    const bool gained = smallest_cost_ < before - kLeastGain;
    idle_batches_ = gained || radius_ > kSmallestRadius ? 0 : idle_batches_ + 1;
    radius_ = gained ? std::min(kLargestRadius, 1.3 * radius_) : std::max(kSmallestRadius, 0.6 * radius_);
  }

  std::vector<double> deviations() const override {
    if (trials_.size() < 2) return std::vector<double>(kEtaCount, kUnknownDeviation);
    const Eigen::MatrixXd covariance = posterior_.estimate_covariance(slopes());
    std::vector<double> result;
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) result.push_back(std::sqrt(covariance(j, j)));
    return result;
  }

  std::vector<Point> plausible(int count) const override {
    return draws(trials_[best_].point, count, RandomStream(settings_.seed, "sysid/plausible"));
  }

 private:
  std::vector<Point> propose() {
    const int count = std::min(std::max(1, settings_.batch), settings_.budget - static_cast<int>(trials_.size()));
    if (count <= 0 || idle_batches_ >= kIdleBatches) return {};
    std::vector<Point> points;
    if (trials_.empty()) {
      points = {settings_.start};
      for (const Point& other : others_) {
        if (static_cast<int>(points.size()) < count) points.push_back(other);
      }
      return points;
    }
    if (is_spreading()) {
      while (static_cast<int>(points.size()) < count) points.push_back(spread_point());
      return points;
    }
    // A point that was simulated already would give the same answer again, and count twice.
    const Point likeliest = most_probable();
    if (is_new(likeliest)) points.push_back(likeliest);
    const RandomStream random(settings_.seed, "sysid/batch" + std::to_string(trials_.size()));
    for (Point& point : draws(likeliest, count - static_cast<int>(points.size()), random))
      points.push_back(std::move(point));
    return points;
  }

  bool is_spreading() const { return trials_.size() < 1 + others_.size() + kSpread; }

  /// The next point of Sobol's sequence over the splits, moduli and failure energies scaled together to where the
  /// emulator expects the measured curves.
  Point spread_point() {
    Point point = settings_.start;
    const Point split = splits_.next();
    for (std::size_t k = 0; k < kSplits.size(); ++k) point[kSplits[k]] = split[k];
    const auto cost = [&](const Move& move) { return smooth_cost(moved(point, move, spans_)); };
    constexpr double kReach = 2.5;  // natural logarithms
    return moved(point, best_scales(cost, kReach), spans_);
  }

  /// Around the trial that is most probable so far; twice, since which trial that is depends on the centre a little.
  void learn() {
    best_ = smallest_raw_cost();
    for (int k = 0; k < 2; ++k) {
      emulator_.learn_with_prior(trials_, best_);
      posterior_.set_base(trials_[best_]);
      best_ = most_probable_trial();
    }
  }

  /// By the objective alone, to have a centre at all.
  std::size_t smallest_raw_cost() const {
    std::size_t smallest = 0;
    for (std::size_t k = 1; k < trials_.size(); ++k) {
      if (trials_[k].objective < trials_[smallest].objective) smallest = k;
    }
    return smallest;
  }

  std::size_t most_probable_trial() {
    std::size_t best = best_;
    smallest_cost_ = smooth_cost(trials_[best_].point);
    for (std::size_t k = 0; k < trials_.size(); ++k) {
      const double here = smooth_cost(trials_[k].point);
      if (here < smallest_cost_) smallest_cost_ = here, best = k;
    }
    return best;
  }

  double smooth_cost(const Point& point) {
    emulator_.predict_smooth(point, changes_);
    return posterior_(point, changes_);
  }

  Point most_probable() {
    const Point& from = trials_[best_].point;
    const auto cost = [&](const Move& move) { return smooth_cost(moved(from, move, spans_)); };
    return moved(from, best_move(cost, radius_), spans_);
  }

  bool is_new(const Point& point) const {
    constexpr double kSamePoint = 1e-12;  // mean square distance
    return std::none_of(trials_.begin(), trials_.end(),
                        [&](const Trial& trial) { return pull_to_start(trial.point, point, 1.0) < kSamePoint; });
  }

  Eigen::MatrixXd slopes() const {
    return feature_slopes(emulator_, trials_[best_].point, data_.measured.size(), /*poisson_searched=*/false);
  }

  /// Points of the normal distribution that the data leave around `centre`, in opposite pairs, within the trust region
  /// and the cube.
  std::vector<Point> draws(const Point& centre, int count, RandomStream random) const {
    const Eigen::LLT<Eigen::MatrixXd> factor(posterior_.posterior_covariance(slopes()));
    std::vector<Point> points;
    Eigen::VectorXd normal(kEtaCount);
    for (int k = 0; k < count; ++k) {
      if (k % 2 == 0) {
        for (double& value : normal) value = random.normal();
      }
      Eigen::VectorXd shift = factor.matrixL() * normal;
      if (k % 2 == 1) shift = -shift;
      Point point = centre;
      for (std::size_t j = 0; j < point.size(); ++j) {
        const bool is_poisson = j >= kNu0 && j < kW0;
        if (is_poisson) continue;
        const double reach = kLargestRadius / spans_[j];
        point[j] = std::clamp(point[j] + std::clamp(shift[static_cast<Eigen::Index>(j)], -reach, reach), 0.0, 1.0);
      }
      points.push_back(std::move(point));
    }
    return points;
  }

  std::vector<double> spans_;
  std::vector<Point> others_;
  FeatureEmulator emulator_;
  FeaturePosterior posterior_;
  optimize::SobolPoints splits_;
  std::vector<FeatureChange> changes_;
  double radius_ = kFirstRadius;
  double smallest_cost_ = HUGE_VAL;
  int idle_batches_ = 0;
};

}  // namespace

std::unique_ptr<Fit> make_posterior_fit(FitData data, const FitSettings& settings,
                                        std::span<const material::ParameterRange> ranges, std::vector<Point> others) {
  return std::make_unique<PosteriorFit>(std::move(data), settings, spans_of(ranges), std::move(others));
}

}  // namespace nacre::sysid
