#pragma once
// The toughness solver in plain scalar C++, single precision: the same mathematics as the explicit kernel, written the
// obvious way. A yardstick for its speed and a check of what it computes; energies, failure and recording as there.

#include <vector>

#include "fem/explicit_solver.hpp"

namespace nacre::bench {

class ScalarExplicit {
 public:
  ScalarExplicit(const fem::Grid& grid, const fem::ExplicitSettings& settings);

  /// One time step; the mean reaction of both grips, Pa.
  double step();
  int failed() const { return failed_; }

 private:
  struct Element {
    float mu = 0.0f, lambda = 0.0f, threshold = 0.0f;
    bool empty = true;
  };
  void add_forces();
  void add_element_forces(int row, int column);
  void accelerate();
  void smooth();

  int columns_, rows_;
  double strain_ = 0.0, strain_per_step_, force_pa_;
  float alpha_;
  int failed_ = 0;
  std::vector<Element> elements_;
  /// Nodal values relative to the uniform stretch, in elements and elements per step.
  std::vector<float> qx_, qy_, vx_, vy_, fx_, fy_, smooth_x_, smooth_y_;
};

}  // namespace nacre::bench
