#pragma once
// The record of an optimiser that is asked batch by batch: its settings, everything told, and the best of it.

#include <limits>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Throws InputError when dimension, batch or a start is out of range; clamps the starts to the cube.
void check_settings(BatchOptimizerSettings& settings);

/// The error of a resumed history that holds a point which these settings would not have asked for.
InputError another_search(std::size_t evaluation);

class RecordedOptimizer : public BatchOptimizer {
 public:
  explicit RecordedOptimizer(const BatchOptimizerSettings& settings);
  std::vector<Point> ask() final;
  void tell(const std::vector<std::optional<double>>& values) final;
  std::optional<Evaluation> best() const final { return best_; }

 protected:
  /// `count` points more, after the starts have been asked for; fewer when nothing more can be gained.
  virtual std::vector<Point> propose(int count) = 0;
  /// Called when the values of a batch are recorded.
  virtual void told() {}

  /// Takes up what an earlier search was told without asking for it again.
  void restore(const std::vector<Evaluation>& told);
  int told_count() const { return evaluations_.size(); }
  /// Values of the first `count` evaluations; a failure counts as somewhat worse than the worst success among them.
  std::vector<double> values(std::size_t count = std::numeric_limits<std::size_t>::max()) const;

  BatchOptimizerSettings settings_;
  std::vector<Evaluation> evaluations_;
  std::vector<Point> asked_;  ///< not told yet

 private:
  void keep(Evaluation evaluation);

  std::optional<Evaluation> best_;
  std::size_t next_start_ = 0;
};

}  // namespace nacre::optimize
