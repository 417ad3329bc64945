#include "sysid/rivals/emulator_fit.hpp"

#include <algorithm>

#include "sysid/emulator.hpp"
#include "sysid/eta_moves.hpp"
#include "sysid/rivals/eta_fit.hpp"
#include "sysid/rivals/warped_objective.hpp"

namespace nacre::sysid {
namespace {

constexpr double kRivalFirstRadius = 0.7;  // of the trust region, in natural logarithms: a factor of two
constexpr double kRivalLargestRadius = 1.0;
constexpr double kRivalSmallestRadius = 0.05;
constexpr double kRivalLeastGain = 1e-3;  // relative gain that counts as progress

class EmulatorFit final : public EtaFit {
 public:
  EmulatorFit(FitData data, const FitSettings& settings, std::vector<double> spans, std::vector<Point> others)
      : EtaFit(std::move(data), settings, kPull, std::move(spans), std::move(others), /*poisson_searched=*/false),
        emulator_(spans_, data_.measured.size()),
        predicted_(data_) {}

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    const bool starting = trials_.empty();
    const double before = starting ? 0.0 : cost(trials_[best_]);
    record_asked(std::move(predictions));
    if (starting) return;
    const bool gained = cost(trials_[best_]) < (1.0 - kRivalLeastGain) * before;
    radius_ = gained ? std::min(kRivalLargestRadius, 1.3 * radius_) : 0.5 * radius_;
  }

 private:
  std::vector<Point> propose() override {
    const int count = std::min(std::max(1, settings_.batch), settings_.budget - static_cast<int>(trials_.size()));
    if (count <= 0 || radius_ < kRivalSmallestRadius) return {};
    if (trials_.empty()) return first_points();
    std::vector<Point> points;
    emulator_.learn(trials_, best_);
    predicted_.set_base(trials_[best_]);
    for (int k = 0; k < count; ++k) {
      // From greedy to curious: the later points of a batch explore where the emulator is least certain.
      points.push_back(best_predicted(0.5 * k));
      emulator_.add_pending(points.back());
    }
    return points;
  }

  Point best_predicted(double curiosity) {
    const Point& from = trials_[best_].point;
    const auto cost = [&](const Move& move) {
      const Point point = moved(from, move, spans_);
      emulator_.predict(point, changes_);
      const double expected = predicted_(changes_) + pull_on(point);
      return curiosity > 0.0 ? expected - curiosity * emulator_.deviation(point) : expected;
    };
    return moved(from, best_move(cost, radius_), spans_);
  }

  FeatureEmulator emulator_;
  WarpedObjective predicted_;
  std::vector<FeatureChange> changes_;
  double radius_ = kRivalFirstRadius;
};

}  // namespace

std::unique_ptr<ParameterFit> make_emulator_fit(FitData data, const FitSettings& settings,
                                                std::span<const material::ParameterRange> ranges,
                                                std::vector<Point> others) {
  return std::make_unique<EmulatorFit>(std::move(data), settings, spans_of(ranges), std::move(others));
}

}  // namespace nacre::sysid
