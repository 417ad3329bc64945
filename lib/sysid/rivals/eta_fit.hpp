#pragma once
// Common part of the two searches for eta by its objective: initial guesses, cost of a trial, and the emulator's
// interval of the best point.

#include <algorithm>
#include <utility>
#include <vector>

#include "sysid/emulator.hpp"
#include "sysid/recorded_fit.hpp"

namespace nacre::sysid {

class EtaFit : public RecordedFit {
 public:
  std::vector<double> deviations() const final {
    return toughness_deviations(data_, trials_, best_, spans_, poisson_searched_, settings_.floor);
  }

  double freedom_taken() const final {
    if (trials_.size() < 2) return 0.0;
    const ToughnessModel model = toughness_model(data_, trials_, best_, spans_, poisson_searched_);
    return freedom_taken_by(model.searched, model.slopes, model.weights / model.noise, kUnknownPrecision);
  }

 protected:
  static constexpr double kPull = 0.01;  ///< cost of moving every parameter across its whole range

  /// `spans` as spans_of() gives them; `others`: further initial guesses.
  EtaFit(FitData data, const FitSettings& settings, double pull, std::vector<double> spans, std::vector<Point> others,
         bool poisson_searched)
      : RecordedFit(std::move(data), settings, pull),
        spans_(std::move(spans)),
        others_(std::move(others)),
        poisson_searched_(poisson_searched) {}

  /// The start and as many of the others as one batch and the budget hold.
  std::vector<Point> first_points() const {
    std::vector<Point> points = {settings_.start};
    const int more = std::min(settings_.batch, settings_.budget) - 1;
    for (const Point& other : others_) {
      if (static_cast<int>(points.size()) <= more) points.push_back(other);
    }
    return points;
  }

  std::vector<double> spans_;

 private:
  std::vector<Point> others_;
  bool poisson_searched_;
};

}  // namespace nacre::sysid
