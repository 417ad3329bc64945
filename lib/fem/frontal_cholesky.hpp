#pragma once
// Multifrontal Cholesky factorisation of a grid's stiffness matrix along a dissection plan.

#include <memory>
#include <vector>

#include "fem/dissection.hpp"
#include "fem/element.hpp"
#include "fem/frontal_kernel.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::fem {

/// Factor of the tangent at F = I. Keeps its memory (5 MB for 80 x 40 elements) from one grid of the same plan to the
/// next. Not for several threads at once. The same bits with every instruction set.
class FrontalCholesky {
 public:
  explicit FrontalCholesky(std::shared_ptr<const DissectionPlan> plan, SimdLevel level = best_simd_level());

  /// Factorises the stiffness of the elements with these Lame parameters; false when it is not positive definite, that
  /// is when a part of the grid can move freely. About 1 ms for 80 x 40 elements, growing with the number of elements
  /// to the power 1.5.
  bool factorise(const std::vector<material::Lame>& lame);
  /// The same of elements that are not squares: shapes[e] for element e.
  bool factorise(const std::vector<material::Lame>& lame, const std::vector<const UnitStiffness*>& shapes);

  /// Solves K x = b in place; entries of held unknowns are neither read nor written.
  void solve(std::vector<double>& x);

 private:
  /// A padded array: whole cache lines, so that every column starts on one.
  struct alignas(64) Line {
    double number[kFrontPadding];
  };
  static double* numbers(std::vector<Line>& lines) { return lines.empty() ? nullptr : lines.front().number; }

  void lay_out();
  void assemble(std::size_t block, const std::vector<material::Lame>& lame,
                const std::vector<const UnitStiffness*>& shapes);

  std::shared_ptr<const DissectionPlan> plan_;
  const FrontalKernel& kernel_;
  std::vector<FrontView> fronts_;
  /// The factors of all blocks; updates, by depth in the dissection and half: at most two of a depth are in use.
  std::vector<Line> factors_, updates_, local_;
  std::vector<double> inverses_;
};

}  // namespace nacre::fem
