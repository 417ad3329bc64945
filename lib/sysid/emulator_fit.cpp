#include <algorithm>
#include <array>
#include <cmath>
#include <nlopt.hpp>

#include "sysid/emulator.hpp"
#include "sysid/recorded_fit.hpp"
#include "sysid/warped_objective.hpp"

namespace nacre::sysid {
namespace {

constexpr double kPull = 0.01;        // cost of moving every parameter across its whole range
constexpr double kFirstRadius = 0.7;  // of the trust region, in natural logarithms: a factor of two
constexpr double kLargestRadius = 1.0;
constexpr double kSmallestRadius = 0.05;
constexpr double kScaleReach =
    3.0;  // the common scales of E and of W may move this many radii: they are well predicted
constexpr double kLeastGain = 1e-3;  // relative gain that counts as progress
constexpr int kScaleSteps = 9;       // of the grid over the two scales, per axis
constexpr int kSearchEvaluations = 600;

/// Moves of the trust region: two common scales, the moduli and failure energies of soft and interface relative to the
/// rigid material's, and the damping.
constexpr int kMoveCount = 7;
using Move = std::array<double, kMoveCount>;

class EmulatorFit final : public RecordedFit {
 public:
  EmulatorFit(FitData data, const FitSettings& settings, std::vector<double> spans, std::vector<Point> others)
      : RecordedFit(std::move(data), settings, kPull),
        spans_(std::move(spans)),
        others_(std::move(others)),
        emulator_(spans_, data_.measured.size()),
        predicted_(data_) {}

  std::vector<Point> ask() override {
    if (asked_.empty() && !finished_) asked_ = propose();
    finished_ = asked_.empty();
    return asked_;
  }

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    const bool starting = trials_.empty();
    const double before = starting ? 0.0 : cost(trials_[best_]);
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      const double objective = toughness_objective(data_.measured, data_.weights, predictions[k]);
      record(asked_[k], std::move(predictions[k]), objective);
    }
    asked_.clear();
    if (starting) return;
    const bool gained = cost(trials_[best_]) < (1.0 - kLeastGain) * before;
    radius_ = gained ? std::min(kLargestRadius, 1.3 * radius_) : 0.5 * radius_;
  }

  std::vector<double> deviations() const override {
    return toughness_deviations(data_, trials_, best_, spans_, /*poisson_searched=*/false);
  }

 private:
  std::vector<Point> propose() {
    const int count = std::min(std::max(1, settings_.batch), settings_.budget - static_cast<int>(trials_.size()));
    if (count <= 0 || radius_ < kSmallestRadius) return {};
    std::vector<Point> points;
    if (trials_.empty()) {
      points = {settings_.start};
      for (const Point& other : others_) {
        if (static_cast<int>(points.size()) < count) points.push_back(other);
      }
      return points;
    }
    emulator_.learn(trials_, best_);
    predicted_.set_base(trials_[best_]);
    for (int k = 0; k < count; ++k) {
      // From greedy to curious: the later points of a batch look where the emulator knows least.
      points.push_back(best_predicted(0.5 * k));
      emulator_.add_pending(points.back());
    }
    return points;
  }

  Point moved(const Move& move) const {
    std::array<double, kEtaCount> shift{};
    const auto group = [&](int first, double scale, double soft, double interface) {
      shift[static_cast<std::size_t>(first)] = scale + soft;
      shift[static_cast<std::size_t>(first + 1)] = scale;
      shift[static_cast<std::size_t>(first + 2)] = scale + interface;
    };
    group(kE0, move[0], move[2], move[3]);
    group(kW0, move[1], move[4], move[5]);
    shift[kGamma] = move[6];
    Point point = trials_[best_].point;
    for (std::size_t j = 0; j < point.size(); ++j) point[j] = std::clamp(point[j] + shift[j] / spans_[j], 0.0, 1.0);
    return point;
  }

  double predicted_cost(const Move& move, double curiosity) {
    const Point point = moved(move);
    emulator_.predict(point, changes_);
    const double cost = predicted_(changes_) + pull_on(point);
    return curiosity > 0.0 ? cost - curiosity * emulator_.deviation(point) : cost;
  }

  Point best_predicted(double curiosity) {
    Move start{};
    double smallest = predicted_cost(start, curiosity);
    const double reach = kScaleReach * radius_;
    for (int i = 0; i < kScaleSteps; ++i) {
      for (int j = 0; j < kScaleSteps; ++j) {
        Move move{};
        move[0] = reach * (2.0 * i / (kScaleSteps - 1) - 1.0);
        move[1] = reach * (2.0 * j / (kScaleSteps - 1) - 1.0);
        const double here = predicted_cost(move, curiosity);
        if (here < smallest) {
          smallest = here;
          start = move;
        }
      }
    }
    return moved(search_from(start, curiosity));
  }

  /// NLopt's subplex: the predicted objective is a sum of absolute values, without derivatives where it matters.
  Move search_from(const Move& start, double curiosity) {
    nlopt::opt search(nlopt::LN_SBPLX, kMoveCount);
    std::vector<double> bound(kMoveCount, radius_), step(kMoveCount, 0.3 * radius_);
    bound[0] = bound[1] = kScaleReach * radius_;
    search.set_upper_bounds(bound);
    for (double& value : bound) value = -value;
    search.set_lower_bounds(bound);
    search.set_initial_step(step);
    search.set_maxeval(kSearchEvaluations);
    Question question{this, curiosity};
    search.set_min_objective(&EmulatorFit::asked_by_nlopt, &question);
    std::vector<double> move(start.begin(), start.end());
    try {
      double smallest = 0.0;
      search.optimize(move, smallest);
    } catch (const nlopt::roundoff_limited&) {  // the point reached is the best that doubles can tell
    }
    Move result{};
    std::copy(move.begin(), move.end(), result.begin());
    return result;
  }

  struct Question {
    EmulatorFit* fit;
    double curiosity;
  };
  static double asked_by_nlopt(const std::vector<double>& move, std::vector<double>&, void* question) {
    const Question& asked = *static_cast<Question*>(question);
    Move copy{};
    std::copy(move.begin(), move.end(), copy.begin());
    return asked.fit->predicted_cost(copy, asked.curiosity);
  }

  std::vector<double> spans_;
  std::vector<Point> others_;
  FeatureEmulator emulator_;
  WarpedObjective predicted_;
  std::vector<FeatureChange> changes_;
  double radius_ = kFirstRadius;
};

}  // namespace

std::unique_ptr<Fit> make_emulator_fit(FitData data, const FitSettings& settings,
                                       std::span<const material::ParameterRange> ranges, std::vector<Point> others) {
  return std::make_unique<EmulatorFit>(std::move(data), settings, spans_of(ranges), std::move(others));
}

}  // namespace nacre::sysid
