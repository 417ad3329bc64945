#include "tester/fracture_record.hpp"

#include <algorithm>
#include <cmath>

#include "thesis/constants.hpp"

namespace nacre::tester {

void FractureRecord::MovingMean::add(double value) {
  if (full()) {
    sum_ -= values_[next_];
  } else {
    ++count_;
  }
  sum_ += value;
  values_[next_] = value;
  next_ = (next_ + 1) % values_.size();
}

FractureRecord::FractureRecord(const Sampling& sampling)
    : sampling_(sampling),
      transit_(std::max(sampling.transit_steps, 4)),
      quarter_(std::max(sampling.transit_steps / 4, 1)) {
  const double steps =
      std::min(sampling.strain_limit / sampling.strain_per_step, static_cast<double>(thesis::kStepLimit));
  const double samples = steps / sampling.steps_per_sample;
  curve_.strain.reserve(static_cast<std::size_t>(samples) + 4);
  curve_.stress_pa.reserve(static_cast<std::size_t>(samples) + 4);
  curve_.strain.push_back(0.0);
  curve_.stress_pa.push_back(0.0);
}

void FractureRecord::add(double strain, double stress_pa) {
  toughness_pa_ += 0.5 * (strain - last_strain_) * (stress_pa + last_stress_pa_);
  last_strain_ = strain;
  last_stress_pa_ = stress_pa;
  transit_.add(stress_pa);
  quarter_.add(stress_pa);
  if (quarter_.full()) peak_pa_ = std::max(peak_pa_, quarter_.mean());
  sample_strain_ += strain;
  sample_stress_pa_ += stress_pa;
  if (++sample_steps_ == sampling_.steps_per_sample) close_sample();
}

bool FractureRecord::separated() const {
  // Before it is pulled, a specimen with residual strains may be under slight compression.
  return peak_pa_ > 0.0 && transit_.mean() < thesis::kStressDropLimit * peak_pa_;
}

void FractureRecord::close_sample() {
  if (sample_steps_ == 0) return;
  if (const double strain = sample_strain_ / sample_steps_; strain > curve_.strain.back()) {
    curve_.strain.push_back(strain);
    curve_.stress_pa.push_back(sample_stress_pa_ / sample_steps_);
  }
  sample_strain_ = sample_stress_pa_ = 0.0;
  sample_steps_ = 0;
}

Curve FractureRecord::take_curve() {
  close_sample();
  return std::move(curve_);
}

}  // namespace nacre::tester
