#pragma once
// Objective (2.8) of predicted feature changes: the curves of a known trial, stretched in stress and strain.

#include <span>
#include <vector>

#include "sysid/emulator.hpp"

namespace nacre::sysid {

/// A curve at equal strain steps from 0, cheap to look up.
struct GridCurve {
  double step = 0.0;
  std::vector<double> stress_pa;
};

class WarpedObjective {
 public:
  explicit WarpedObjective(const FitData& data);
  /// The trial whose curves are stretched.
  void set_base(const FitTrial& trial);
  /// Expected value of toughness_objective() when the features of design i change by changes[i]; designs that failed in
  /// the base count as failed.
  double operator()(std::span<const FeatureChange> changes) const;

 private:
  struct WarpedDesign {
    double weight = 0.0, measured_pa = 0.0, base_pa = 0.0;
    bool base_failed = true;
    GridCurve measured, base;  ///< empty when there is none
  };
  std::vector<WarpedDesign> designs_;
  double weight_sum_ = 0.0;
};

}  // namespace nacre::sysid
