#pragma once
// The record of a fit: its data, all trials, and the best of them by objective plus pull to the start.

#include <Eigen/Dense>
#include <algorithm>
#include <span>
#include <utility>

#include "sysid/fit.hpp"
#include "sysid/objective.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {

class RecordedFit : public ParameterFit {
 public:
  std::vector<Point> ask() final {
    if (asked_.empty() && !finished_) {
      asked_ = propose();
      finished_ = asked_.empty();
    }
    return asked_;
  }
  double progress() const final {
    return finished_ ? 1.0 : std::min(1.0, static_cast<double>(trials_.size()) / settings_.budget);
  }
  const FitTrial& first() const final { return trials_.front(); }
  const FitTrial& best() const final { return trials_[best_]; }
  const std::vector<FitTrial>& trials() const final { return trials_; }
  std::vector<CoordinateInterval> intervals() const override {
    constexpr double kReach90 = 1.645;  // standard deviations
    std::vector<CoordinateInterval> result;
    const std::vector<double> of_coordinates = deviations();
    for (std::size_t j = 0; j < of_coordinates.size(); ++j) {
      const double at = best().point[j], reach = kReach90 * of_coordinates[j];
      result.push_back({std::max(0.0, at - reach), std::min(1.0, at + reach), of_coordinates[j]});
    }
    return result;
  }

 protected:
  /// `pull` is the cost of moving every parameter across its whole range.
  RecordedFit(FitData data, const FitSettings& settings, double pull)
      : data_(std::move(data)), settings_(settings), pull_(pull) {}

  /// Standard deviation of every coordinate of best().point as far as the data determine it (spread.hpp);
  /// kUnknownDeviation where they do not, or were not asked.
  virtual std::vector<double> deviations() const {
    return std::vector<double>(settings_.start.size(), kUnknownDeviation);
  }

  /// freedom_taken() from E or T by a linear model at best().point whose `jacobian` has a column for each of
  /// `coordinates`: one that is at its bound no longer follows the data.
  double freedom_taken_by(std::span<const std::size_t> coordinates, Eigen::MatrixXd jacobian,
                          const Eigen::VectorXd& weights, double prior_precision) const {
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      const double at = best().point[coordinates[k]];
      if (at <= 0.0 || at >= 1.0) jacobian.col(static_cast<Eigen::Index>(k)).setZero();
    }
    return sysid::freedom_taken(jacobian, weights, prior_precision, data_.measured.size());
  }

  /// The part of the cost that needs no simulation.
  double pull_on(const Point& point) const { return pull_to_start(point, settings_.start, pull_); }
  double cost(const FitTrial& trial) const { return trial.objective + pull_on(trial.point); }

  void record(const Point& point, std::vector<Prediction> predictions, double objective) {
    trials_.push_back({point, std::move(predictions), objective});
    if (cost(trials_.back()) < cost(trials_[best_])) best_ = trials_.size() - 1;
  }

  /// Records what was asked for, by the toughness part of (2.8).
  void record_asked(std::vector<std::vector<Prediction>> predictions) {
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      const double objective = toughness_objective(data_.measured, data_.weights, predictions[k]);
      record(asked_[k], std::move(predictions[k]), objective);
    }
    asked_.clear();
  }

  FitData data_;
  FitSettings settings_;
  std::vector<FitTrial> trials_;
  std::vector<Point> asked_;  ///< points asked for and not told yet
  std::size_t best_ = 0;
  bool finished_ = false;

 private:
  /// The points to evaluate next, once those before are recorded; none ends the fit.
  virtual std::vector<Point> propose() = 0;

  double pull_;
};

}  // namespace nacre::sysid
