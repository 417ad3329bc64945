#include "sysid/parallel_fit.hpp"

#include <algorithm>
#include <cassert>

namespace nacre::sysid {
namespace {

class ParallelFit final : public ParameterFit {
 public:
  explicit ParallelFit(std::vector<std::unique_ptr<ParameterFit>> fits) : fits_(std::move(fits)) {
    assert(!fits_.empty());
  }

  std::vector<Point> ask() override {
    std::vector<Point> points;
    asked_.clear();
    for (const auto& fit : fits_) {
      const std::vector<Point> of_fit = fit->ask();
      asked_.push_back(of_fit.size());
      points.insert(points.end(), of_fit.begin(), of_fit.end());
    }
    return points;
  }

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    auto next = predictions.begin();
    for (std::size_t k = 0; k < fits_.size(); ++k) {
      const auto end = next + static_cast<std::ptrdiff_t>(asked_[k]);
      if (asked_[k] > 0) fits_[k]->tell({std::make_move_iterator(next), std::make_move_iterator(end)});
      next = end;
    }
    trials_.clear();
    for (const auto& fit : fits_) trials_.insert(trials_.end(), fit->trials().begin(), fit->trials().end());
  }

  double progress() const override {
    double least = 1.0;
    for (const auto& fit : fits_) least = std::min(least, fit->progress());
    return least;
  }
  const FitTrial& first() const override { return fits_.front()->first(); }
  const FitTrial& best() const override { return leader().best(); }
  const std::vector<FitTrial>& trials() const override { return trials_; }
  std::vector<CoordinateInterval> intervals() const override { return leader().intervals(); }
  double freedom_taken() const override { return leader().freedom_taken(); }
  std::vector<Point> plausible(int count) const override { return leader().plausible(count); }

  std::vector<double> best_objectives() const override {
    std::vector<double> objectives;
    for (const auto& fit : fits_) objectives.push_back(fit->best().objective);
    return objectives;
  }

 private:
  const ParameterFit& leader() const {
    const auto better = [](const auto& a, const auto& b) { return a->cost() < b->cost(); };
    return **std::min_element(fits_.begin(), fits_.end(), better);
  }

  std::vector<std::unique_ptr<ParameterFit>> fits_;
  std::vector<std::size_t> asked_;  ///< points asked for, by fit
  std::vector<FitTrial> trials_;
};

}  // namespace

std::unique_ptr<ParameterFit> make_parallel_fit(std::vector<std::unique_ptr<ParameterFit>> fits) {
  if (fits.size() == 1) return std::move(fits.front());
  return std::make_unique<ParallelFit>(std::move(fits));
}

}  // namespace nacre::sysid
