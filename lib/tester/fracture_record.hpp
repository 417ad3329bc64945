#pragma once

#include <vector>

#include "tester/curve.hpp"

namespace nacre::tester {

/// The load cell's record of a fracture test: takes the stress at every step, keeps the curve at fewer strains and the
/// area under it, and finds peak and separation on means over time, so that ringing ends no test. Memory is allocated
/// at the start.
class FractureRecord {
 public:
  struct Sampling {
    double strain_per_step = 0.0;
    int steps_per_sample = 1;  ///< a sample of the curve is the mean over so many steps
    int transit_steps = 1;     ///< steps in which an elastic wave runs once along the specimen
    double strain_limit = 0.0;
  };
  explicit FractureRecord(const Sampling& sampling);

  void add(double strain, double stress_pa);

  /// The mean over the last transit is below 20 % of the peak.
  bool separated() const;
  /// Largest mean over a quarter of a transit.
  double peak_stress_pa() const { return peak_pa_; }
  /// Area under the stress at every step (Eq. 2.6), J/m^3.
  double toughness_pa() const { return toughness_pa_; }
  /// The curve so far from (0, 0) on; closes the last sample.
  Curve take_curve();

 private:
  /// The mean over the last `length` values.
  class MovingMean {
   public:
    explicit MovingMean(int length) : values_(length) {}
    void add(double value);
    double mean() const { return count_ ? sum_ / static_cast<double>(count_) : 0.0; }
    bool full() const { return count_ == values_.size(); }

   private:
    std::vector<double> values_;
    std::size_t next_ = 0, count_ = 0;
    double sum_ = 0.0;
  };
  void close_sample();

  Sampling sampling_;
  MovingMean transit_, quarter_;
  Curve curve_;
  double last_strain_ = 0.0, last_stress_pa_ = 0.0;
  double sample_strain_ = 0.0, sample_stress_pa_ = 0.0;
  int sample_steps_ = 0;
  double peak_pa_ = 0.0, toughness_pa_ = 0.0;
};

}  // namespace nacre::tester
