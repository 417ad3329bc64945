#include "sysid/posterior_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "optimize/ensemble_sampler.hpp"
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
/// common scales of moduli and failure energies; the rest has valleys longer than a trust region's way.
constexpr std::array<std::size_t, 5> kSplits = {kE0, kE0 + 2, kW0, kW0 + 2, kGamma};
constexpr int kMostSpread = 9;  // points spread over the splits before the search narrows

class PosteriorFit final : public RecordedFit {
 public:
  PosteriorFit(FitData data, const FitSettings& settings, std::vector<double> spans, std::vector<Point> others)
      : RecordedFit(std::move(data), settings, 0.0),
        spans_(std::move(spans)),
        others_(std::move(others)),
        emulator_(spans_, data_.measured.size()),
        posterior_(data_, settings.start, settings.floor),
        splits_(kSplits.size(), settings.seed) {}

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    record_asked(std::move(predictions));
    const double before = smallest_cost_;
    learn();
    if (is_spreading()) return;
    const bool gained = smallest_cost_ < before - kLeastGain;
    idle_batches_ = gained || radius_ > kSmallestRadius ? 0 : idle_batches_ + 1;
    radius_ = gained ? std::min(kLargestRadius, 1.3 * radius_) : std::max(kSmallestRadius, 0.6 * radius_);
  }

  /// Improbability of the best trial: one simulation's objective is mostly luck (docs/decisions/0009).
  double cost() const override { return smallest_cost_; }

  std::vector<CoordinateInterval> intervals() const override {
    std::vector<CoordinateInterval> result(kEtaCount, {0.0, 1.0, kUnknownDeviation});
    if (trials_.size() < 2) return result;
    const std::vector<Eigen::VectorXd> draws = possible(posterior_.shared_error_count());
    std::vector<double> values(draws.size());
    for (std::size_t k = 0; k < kSearchedEta.size(); ++k) {
      std::transform(draws.begin(), draws.end(), values.begin(), [&](const Eigen::VectorXd& draw) { return draw[k]; });
      // The estimate is the best evaluation and not the middle of what is possible: it may stand at the edge.
      const double at = trials_[best_].point[kSearchedEta[k]];
      result[kSearchedEta[k]] = {std::min(at, quantile(values, 0.05)), std::max(at, quantile(values, 0.95)),
                                 standard_deviation(values)};
    }
    return result;
  }

  double freedom_taken() const override {
    if (trials_.size() < 2) return 0.0;
    return freedom_taken_by(kSearchedEta, slopes()(Eigen::all, kSearchedEta), posterior_.learnt_precisions(),
                            kUnknownPrecision);
  }

  std::vector<Point> plausible(int count) const override {
    if (trials_.size() < 2 || count <= 0) return {};
    const std::vector<Eigen::VectorXd> draws = possible(/*shared_errors=*/0);
    RandomStream random(settings_.seed, "sysid/plausible");
    std::vector<Point> points;
    for (int k = 0; k < count; ++k) points.push_back(point_at(draws[random.index(static_cast<int>(draws.size()))]));
    return points;
  }

 private:
  std::vector<Point> propose() override {
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
    // A point that was simulated already would give the same prediction again, and count twice.
    const Point likeliest = most_probable();
    if (is_new(likeliest)) points.push_back(likeliest);
    const RandomStream random(settings_.seed, "sysid/batch" + std::to_string(trials_.size()));
    for (Point& point : draws(likeliest, count - static_cast<int>(points.size()), random))
      points.push_back(std::move(point));
    return points;
  }

  /// In whole batches, and at most half of what the first batch leaves: the rest is needed to narrow down.
  bool is_spreading() const {
    const int first = 1 + static_cast<int>(others_.size()), batch = std::max(1, settings_.batch);
    const int spread = std::min(kMostSpread, (settings_.budget - first) / 2) / batch * batch;
    return static_cast<int>(trials_.size()) < first + spread;
  }

  /// The next point of Sobol's sequence over the splits, moduli and failure energies scaled together to where the
  /// emulator predicts the measured curves.
  Point spread_point() {
    Point point = settings_.start;
    const Point split = splits_.next();
    for (std::size_t k = 0; k < kSplits.size(); ++k) point[kSplits[k]] = split[k];
    const auto cost = [&](const Move& move) { return smooth_cost(moved(point, move, spans_)); };
    constexpr double kReach = 2.5;  // natural logarithms
    constexpr int kSteps = 9;
    return moved(point, best_scales(cost, kReach, kSteps), spans_);
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
                        [&](const FitTrial& trial) { return pull_to_start(trial.point, point, 1.0) < kSamePoint; });
  }

  /// The best trial with the searched coordinates of a draw.
  Point point_at(const Eigen::VectorXd& draw) const {
    Point point = trials_[best_].point;
    for (std::size_t k = 0; k < kSearchedEta.size(); ++k) point[kSearchedEta[k]] = draw[k];
    return point;
  }

  /// Draws from what the data leave possible by the emulator, its own uncertainty included: searched coordinates, then
  /// sizes of the errors that all designs share, when they are included.
  std::vector<Eigen::VectorXd> possible(Eigen::Index shared_errors) const {
    constexpr int kBurnIn = 100, kSteps = 60;  // from walkers that are nearly right
    const auto searched = static_cast<Eigen::Index>(kSearchedEta.size());
    std::vector<FeatureChange> changes;
    const auto cost = [&](const Eigen::VectorXd& at) {
      const auto inside = at.head(searched);
      if (inside.minCoeff() < 0.0 || inside.maxCoeff() > 1.0) return HUGE_VAL;
      const Point point = point_at(at);
      const double deviation = emulator_.predict_with_deviation(point, changes);
      return posterior_(point, changes, deviation, at.tail(shared_errors));
    };
    return optimize::sample_ensemble(cost, first_walkers(shared_errors), kBurnIn, kSteps,
                                     RandomStream(settings_.seed, "sysid/sampler"));
  }

  /// From the normal distribution that slopes at the best trial suggest, shared errors absorbed by the parameters.
  std::vector<Eigen::VectorXd> first_walkers(Eigen::Index shared_errors) const {
    constexpr int kWalkers = 32;
    const auto searched = static_cast<Eigen::Index>(kSearchedEta.size());
    const Eigen::MatrixXd moves = posterior_.moves_by_shared_errors(slopes());
    RandomStream random(settings_.seed, "sysid/walkers");
    std::vector<Eigen::VectorXd> walkers;
    for (const Point& point : draws(trials_[best_].point, kWalkers, RandomStream(settings_.seed, "sysid/first"))) {
      Eigen::VectorXd& walker = walkers.emplace_back(searched + shared_errors);
      auto errors = walker.tail(shared_errors);
      for (double& value : errors) value = random.normal();
      for (Eigen::Index k = 0; k < searched; ++k) {
        const std::size_t coordinate = kSearchedEta[k];
        const double move = moves.row(static_cast<Eigen::Index>(coordinate)).head(shared_errors).dot(errors);
        walker[k] = std::clamp(point[coordinate] + move, 0.0, 1.0);
      }
    }
    return walkers;
  }

  Eigen::MatrixXd slopes() const {
    return feature_slopes(emulator_, trials_[best_].point, data_.measured.size(), /*poisson_searched=*/false);
  }

  /// Points of the normal distribution that the data leave around `centre`, in opposite pairs, within the largest
  /// trust region and the cube.
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
      for (const std::size_t j : kSearchedEta) {
        const double reach = kLargestRadius / spans_[j];
        point[j] = std::clamp(point[j] + std::clamp(shift[j], -reach, reach), 0.0, 1.0);
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

std::unique_ptr<ParameterFit> make_posterior_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others) {
  return std::make_unique<PosteriorFit>(std::move(data), settings, spans_of(ranges), std::move(others));
}

}  // namespace nacre::sysid
