#include "optimize/recorded_optimizer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace nacre::optimize {

void check_settings(BatchOptimizerSettings& settings) {
  const auto at_least_one = [](std::string_view key, int value) {
    if (value < 1) throw InputError::format("optimiser: {} = {}, expected at least 1", key, value);
  };
  at_least_one("dimension", settings.dimension);
  at_least_one("batch", settings.batch);
  for (Point& start : settings.starts) {
    if (static_cast<int>(start.size()) != settings.dimension) {
      throw InputError::format("optimiser: a start has {} coordinates, expected {}", start.size(), settings.dimension);
    }
    for (double& coordinate : start) {
      if (!std::isfinite(coordinate)) throw InputError("optimiser: a start has a coordinate that is no number");
      coordinate = std::clamp(coordinate, 0.0, 1.0);
    }
  }
}

InputError another_search(std::size_t evaluation) {
  return InputError::format(
      "optimiser: evaluation {} is no point that these settings ask for, the record is that of another search: name "
      "another "
      "file",
      evaluation);
}

RecordedOptimizer::RecordedOptimizer(const BatchOptimizerSettings& settings) : settings_(settings) {
  check_settings(settings_);
}

std::vector<Point> RecordedOptimizer::ask() {
  assert(asked_.empty() && "ask() before the last batch was told");
  const int count = std::min(settings_.batch, settings_.budget - told_count());
  if (count <= 0) return {};
  while (next_start_ < settings_.starts.size() && static_cast<int>(asked_.size()) < count) {
    asked_.push_back(settings_.starts[next_start_++]);
  }
  const int more = count - static_cast<int>(asked_.size());
  if (more > 0) {
    for (Point& point : propose(more)) asked_.push_back(std::move(point));
  }
  return asked_;
}

void RecordedOptimizer::tell(const std::vector<std::optional<double>>& values) {
  assert(!asked_.empty() && "tell() without a batch that was asked for");
  assert(values.size() == asked_.size() && "tell() needs a value for every point of the batch");
  for (std::size_t i = 0; i < asked_.size(); ++i) keep({std::move(asked_[i]), values[i]});
  asked_.clear();
  told();
}

void RecordedOptimizer::keep(Evaluation evaluation) {
  assert(!evaluation.value || std::isfinite(*evaluation.value));
  if (evaluation.value && (!best_ || *evaluation.value < *best_->value)) best_ = evaluation;
  evaluations_.push_back(std::move(evaluation));
}

void RecordedOptimizer::restore(const std::vector<Evaluation>& told) {
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (static_cast<int>(told[i].point.size()) != settings_.dimension) {
      throw InputError::format("optimiser: evaluation {} has {} coordinates, expected {}", i, told[i].point.size(),
                               settings_.dimension);
    }
    keep(told[i]);
  }
  next_start_ = std::min(told.size(), settings_.starts.size());
}

std::vector<double> RecordedOptimizer::values(std::size_t count) const {
  const std::span known = std::span(evaluations_).first(std::min(count, evaluations_.size()));
  double worst = -HUGE_VAL, least = HUGE_VAL;
  for (const Evaluation& evaluation : known) {
    if (!evaluation.value) continue;
    worst = std::max(worst, *evaluation.value);
    least = std::min(least, *evaluation.value);
  }
  if (worst < least) worst = least = 0.0;  // all failed
  const double spread = worst - least;
  std::vector<double> result;
  for (const Evaluation& evaluation : known) result.push_back(evaluation.value.value_or(worst + 0.1 * spread));
  return result;
}

}  // namespace nacre::optimize
