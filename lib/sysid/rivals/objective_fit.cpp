#include "sysid/rivals/objective_fit.hpp"

#include <algorithm>
#include <cmath>

#include "sysid/emulator.hpp"
#include "sysid/eta_moves.hpp"
#include "sysid/rivals/eta_fit.hpp"
#include "sysid/rivals/warped_objective.hpp"

namespace nacre::sysid {
namespace {

constexpr double kWideReach = 2.3;  // natural logarithm of ten
constexpr int kWideSteps = 25;
constexpr double kRepeatability = 0.1;  // of one design's share of the objective: toughness and curve jump together

class ObjectiveFit final : public EtaFit {
 public:
  ObjectiveFit(FitData data, const FitSettings& settings, std::vector<double> spans, std::vector<Point> others,
               optimize::Algorithm algorithm)
      : EtaFit(std::move(data), settings, algorithm == optimize::Algorithm::trust_region ? kPull : 0.0,
               std::move(spans), std::move(others), /*poisson_searched=*/true),
        algorithm_(algorithm) {}

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    const std::size_t before = trials_.size();
    record_asked(std::move(predictions));
    std::vector<std::optional<double>> costs;
    for (std::size_t k = before; k < trials_.size(); ++k) costs.push_back(cost(trials_[k]));
    if (optimizer_) optimizer_->tell(costs);
  }

 private:
  std::vector<Point> propose() override {
    const bool rescales = algorithm_ == optimize::Algorithm::trust_region;
    if (trials_.empty() && rescales) return first_points();
    if (!optimizer_) begin_search(rescales ? std::vector<Point>{rescaled(), trials_[best_].point} : first_points());
    return optimizer_->ask();
  }

  void begin_search(std::vector<Point> starts) {
    optimize::BatchOptimizerSettings settings;
    settings.dimension = kEtaCount;
    settings.budget = settings_.budget - static_cast<int>(trials_.size());
    settings.batch = settings_.batch;
    settings.seed = settings_.seed;
    settings.starts = std::move(starts);
    settings.value_deviation = kRepeatability / std::sqrt(static_cast<double>(data_.measured.size()));
    optimizer_ = optimize::make_optimizer(algorithm_, settings);
  }

  /// The best trial with all moduli and all failure energies multiplied by the two factors that the scaling laws
  /// favour.
  Point rescaled() const {
    FeatureEmulator emulator(spans_, data_.measured.size());
    emulator.learn(trials_, best_);
    WarpedObjective predicted(data_);
    predicted.set_base(trials_[best_]);
    std::vector<FeatureChange> changes;
    const FitTrial& from = trials_[best_];
    const auto expected = [&](const Move& move) {
      const Point point = moved(from.point, move, spans_);
      emulator.predict(point, changes);
      return predicted(changes) + pull_on(point);
    };
    const Move scales = best_scales(expected, kWideReach, kWideSteps);
    return expected(scales) < cost(from) ? moved(from.point, scales, spans_) : from.point;
  }

  optimize::Algorithm algorithm_;
  std::unique_ptr<optimize::BatchOptimizer> optimizer_;
};

}  // namespace

std::unique_ptr<ParameterFit> make_objective_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others, optimize::Algorithm algorithm) {
  return std::make_unique<ObjectiveFit>(std::move(data), settings, spans_of(ranges), std::move(others), algorithm);
}

}  // namespace nacre::sysid
