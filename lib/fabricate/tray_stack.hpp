#pragma once
// All specimens of a tray as one stack of slices.

#include <span>
#include <vector>

#include "fabricate/job.hpp"

namespace nacre::fabricate {

/// The specimens of one tray and the smallest rectangle that holds them, each where the job has placed it, to the
/// nearest droplet. A specimen has the droplets of its model's own stack; above it there is nothing.
class TrayStack : public SliceStack {
 public:
  /// `plans`: of the job's models, in their order; job and plans must outlive it.
  TrayStack(const Job& job, int tray, std::span<const DropletPlan> plans);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int layers() const override { return layers_; }
  bool is_like_before(int layer) const override;
  bool is_noise(int layer) const override;
  Slice slice(int layer) const override;
  /// The stack's front left corner from that of the tray.
  double corner_x_mm() const { return corner_x_mm_; }
  double corner_y_mm() const { return corner_y_mm_; }

 private:
  struct Part {
    std::size_t model;
    int column, row;  ///< of its first droplet, far left
  };
  std::span<const DropletPlan> plans_;
  std::vector<Part> parts_;  ///< those of a model one after another
  int columns_ = 0, rows_ = 0, layers_ = 0;
  double corner_x_mm_ = 0.0, corner_y_mm_ = 0.0;
};

}  // namespace nacre::fabricate
