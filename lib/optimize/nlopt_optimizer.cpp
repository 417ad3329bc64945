#include "optimize/nlopt_optimizer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string_view>

#include "base/result.hpp"
#include "optimize/recorded_optimizer.hpp"
#include "optimize/replay.hpp"
#include "optimize/space_filling.hpp"

namespace nacre::optimize {
namespace {

// Chosen on functions like the toughness calibration (10 parameters whose influence spans two decades, correlated, an
// L1 or a squared misfit, 5 % jumps; 60 seeds). After 25 evaluations from the centre the misfit had fallen, as a
// geometric mean,
//   to 0.40 (L1) and 0.14 (squares) with one BOBYQA search filling its batches by looking ahead,
//   to 0.38 and 0.18 with COBYLA instead, to 0.47 and 0.26 by random search;
// three searches side by side, one point each, were worse than one (L1, 10 seeds: 0.46 against 0.31), and space-filling
// points before the search cost more than they found. From 100 evaluations on, Nelder-Mead in turn with BOBYQA is the
// most robust.
constexpr double kFirstStep = 0.2;
constexpr double kShrink = 0.5;                // of each new search's step
constexpr double kSmallestFirstStep = 0.01;    // below it the steps restart at kFirstStep
constexpr double kSmallestStepShare = 0.05;    // a search ends at this share of its first step
constexpr double kPatiencePerDimension = 2.0;  // evaluations without a new best before a search gives way,
constexpr double kPatience = 10.0;             // and as many more
constexpr int kFewDimensions = 3;              // in which space-filling points do fill the space
constexpr int kFruitlessSearches = 12;         // in a row, before a space-filling point is asked for instead
constexpr double kHopeless = 1e10;  // value of a failure while nothing has succeeded: models break on infinity

class NloptOptimizer final : public BatchOptimizer {
 public:
  explicit NloptOptimizer(const BatchOptimizerSettings& settings);
  std::vector<Point> ask() override;
  void tell(const std::vector<std::optional<double>>& values) override;
  std::optional<Evaluation> best() const override { return best_; }

 private:
  bool full() const { return static_cast<int>(batch_.size()) >= std::min(settings_.batch, settings_.budget - told_); }
  bool is_new(const Point& point) const { return !values_.contains(point) && !pending(point); }
  bool pending(const Point& point) const { return std::find(batch_.begin(), batch_.end(), point) != batch_.end(); }
  void add_starts();
  void add_from_searches();
  void begin_at_best_initial_guess();
  Point next_start();
  void begin_search();
  bool search_is_stale() const;
  bool explores_elsewhere() const;
  std::optional<Point> wanted() const;
  double value_of_nearest(const Point& point) const;
  double penalty() const;

  BatchOptimizerSettings settings_;
  SpaceFillingPoints space_filling_;
  std::size_t next_start_ = 0;
  bool starts_known_ = false;
  std::optional<LocalSearch> search_;
  int searches_begun_ = 0;
  int search_began_at_ = 0;  ///< evaluations told by then
  double step_ = kFirstStep;
  std::map<Point, double> values_;  ///< everything told, failures at their penalty
  std::vector<Point> batch_;        ///< asked for, not yet told
  int told_ = 0;
  int best_found_at_ = 0;
  std::optional<Evaluation> best_;
  double worst_ = 0.0;  ///< largest value of a success
};

NloptOptimizer::NloptOptimizer(const BatchOptimizerSettings& settings)
    : settings_(settings), space_filling_(settings.dimension, settings.seed) {
  check_settings(settings_);
  std::vector<Point>& starts = settings_.starts;
  if (starts.empty()) starts.push_back(Point(settings.dimension, 0.5));
}

std::vector<Point> NloptOptimizer::ask() {
  assert(batch_.empty() && "ask() before the last batch was told");
  if (!starts_known_ && next_start_ == settings_.starts.size()) begin_at_best_initial_guess();
  add_starts();
  add_from_searches();
  return batch_;
}

void NloptOptimizer::add_starts() {
  for (; next_start_ < settings_.starts.size() && !full(); ++next_start_) {
    const Point& start = settings_.starts[next_start_];
    if (is_new(start)) batch_.push_back(start);
  }
}

void NloptOptimizer::add_from_searches() {
  int fruitless = 0;
  while (!full()) {
    if (!search_ || search_is_stale()) begin_search();
    if (explores_elsewhere()) {
      batch_.push_back(space_filling_.next());
      continue;
    }
    if (const auto point = wanted()) {
      batch_.push_back(*point);
      fruitless = 0;
      continue;
    }
    begin_search();
    if (++fruitless < kFruitlessSearches) continue;
    batch_.push_back(space_filling_.next());
    fruitless = 0;
  }
}

/// The first search looked ahead from the first start. It goes on when that is the best one, and else restarts.
void NloptOptimizer::begin_at_best_initial_guess() {
  starts_known_ = true;
  const auto better = [this](const Point& a, const Point& b) { return values_.at(a) < values_.at(b); };
  const Point& best = *std::min_element(settings_.starts.begin(), settings_.starts.end(), better);
  if (!best_ || (search_ && search_->start == best)) return;
  searches_begun_ = 0;
  step_ = kFirstStep;
  begin_search();
  search_->start = best;
}

void NloptOptimizer::begin_search() {
  // BOBYQA is not defined in one dimension.
  const bool quadratic_model = searches_begun_ % 2 == 0 && settings_.dimension > 1;
  search_ = LocalSearch{.algorithm = quadratic_model ? nlopt::LN_BOBYQA : nlopt::LN_NELDERMEAD,
                        .start = next_start(),
                        .step = step_,
                        .smallest_step = step_ * kSmallestStepShare,
                        .maximum_evaluations = 10 * settings_.budget + 100};
  search_began_at_ = told_;
  ++searches_begun_;
  step_ *= kShrink;
  if (step_ < kSmallestFirstStep) step_ = kFirstStep;
}

Point NloptOptimizer::next_start() {
  if (best_) return best_->point;
  return starts_known_ ? space_filling_.next() : settings_.starts.front();
}

bool NloptOptimizer::search_is_stale() const {
  const int fruitless = told_ - std::max(search_began_at_, best_found_at_);
  return fruitless > kPatiencePerDimension * settings_.dimension + kPatience;
}

/// Whether the next point of this batch is better spent on the rest of the cube: in few dimensions, once two points of
/// a search that has its first model stand in the batch. (The third guess is worth little: giving it away costs under 3
/// % in ten dimensions, and in two it halves what is left of Rosenbrock's function after 200 evaluations.)
bool NloptOptimizer::explores_elsewhere() const {
  const bool has_model = search_ && told_ - search_began_at_ > 2 * settings_.dimension;
  return settings_.dimension <= kFewDimensions && has_model && batch_.size() >= 2;
}

/// The search looks ahead over the points of this batch as if each were as good as its nearest neighbour.
std::optional<Point> NloptOptimizer::wanted() const {
  return next_unknown(*search_, [this](const Point& point) -> std::optional<double> {
    if (const auto told = values_.find(point); told != values_.end()) return told->second;
    if (pending(point)) return value_of_nearest(point);
    return std::nullopt;
  });
}

double NloptOptimizer::value_of_nearest(const Point& point) const {
  double nearest = HUGE_VAL, value = kHopeless;
  for (const auto& [other, other_value] : values_) {
    double distance = 0.0;
    for (std::size_t k = 0; k < point.size(); ++k) distance += (point[k] - other[k]) * (point[k] - other[k]);
    if (distance < nearest) nearest = distance, value = other_value;
  }
  return value;
}

/// Worse than everything seen, but of its magnitude, so that a model of the objective survives it.
double NloptOptimizer::penalty() const {
  if (!best_) return kHopeless;
  return worst_ + (worst_ - *best_->value) + 0.1 * std::abs(worst_);
}

void NloptOptimizer::tell(const std::vector<std::optional<double>>& values) {
  assert(!batch_.empty() && "tell() without a batch that was asked for");
  assert(values.size() == batch_.size() && "tell() needs a value for every point of the batch");
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    if (!values[i]) continue;
    assert(std::isfinite(*values[i]));
    worst_ = best_ ? std::max(worst_, *values[i]) : *values[i];
    if (best_ && *values[i] >= *best_->value) continue;
    best_ = Evaluation{batch_[i], values[i]};
    best_found_at_ = told_ + static_cast<int>(batch_.size());
  }
  for (std::size_t i = 0; i < batch_.size(); ++i) values_.emplace(batch_[i], values[i].value_or(penalty()));
  told_ += batch_.size();
  batch_.clear();
}

}  // namespace

std::unique_ptr<BatchOptimizer> make_nlopt_optimizer(const BatchOptimizerSettings& settings) {
  return std::make_unique<NloptOptimizer>(settings);
}

}  // namespace nacre::optimize
