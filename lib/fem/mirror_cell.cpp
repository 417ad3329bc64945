#include "fem/mirror_cell.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "fem/element.hpp"
#include "fem/frontal_cholesky.hpp"

namespace nacre::fem {
namespace {

/// Displacements or forces: 2 per node, as StaticSolution has them.
using NodalField = std::vector<double>;

/// Depends on the elements' sizes alone. Elements point into it: its address must not change.
class CellPlan {
 public:
  explicit CellPlan(std::span<const double> sizes)
      : sizes_(sizes.begin(), sizes.end()), length_(std::accumulate(sizes.begin(), sizes.end(), 0.0)) {
    grid_.columns = grid_.rows = sizes.size();
    grid_.phase.assign(sizes.size() * sizes.size(), Phase::soft);
    for (const double height : sizes)
      for (const double width : sizes) {
        const auto [shape, is_new] = stiffness_.try_emplace({width, height});
        if (is_new) shape->second = rectangle_stiffness(width, height);
        shapes_.push_back(&shape->second);
        areas_.push_back(width * height);
      }
    held_.assign(static_cast<std::size_t>(2 * (grid_.columns + 1) * (grid_.rows + 1)), 0);
    for (int i = 0; i <= grid_.columns; ++i)
      for (const int end : {0, grid_.columns}) held_[place(i, end, 0)] = held_[place(end, i, 1)] = 1;
    factorisation_ = std::make_unique<FrontalCholesky>(std::make_shared<const DissectionPlan>(dissect(grid_, held_)));
  }
  CellPlan(const CellPlan&) = delete;
  CellPlan& operator=(const CellPlan&) = delete;

  bool is_for(std::span<const double> sizes) const { return std::ranges::equal(sizes_, sizes); }
  const Grid& grid() const { return grid_; }
  double length() const { return length_; }
  const std::vector<const UnitStiffness*>& shapes() const { return shapes_; }
  const std::vector<double>& areas() const { return areas_; }
  /// The prescribed displacements of the sides: along their normal.
  const std::vector<char>& held() const { return held_; }
  FrontalCholesky& factorisation() { return *factorisation_; }

  /// The whole stretched by 1 along a direction (0 x, 1 y): its far side moves.
  NodalField stretch(int direction) const {
    NodalField field(held_.size(), 0.0);
    for (int i = 0; i <= grid_.columns; ++i)
      field[direction == 0 ? place(i, grid_.columns, 0) : place(grid_.rows, i, 1)] = length_;
    return field;
  }

 private:
  std::size_t place(int row, int column, int direction) const {
    return 2 * (row * (grid_.columns + 1) + column) + direction;
  }

  std::vector<double> sizes_;
  double length_;
  Grid grid_;
  std::map<std::pair<double, double>, UnitStiffness> stiffness_;
  std::vector<const UnitStiffness*> shapes_;
  std::vector<double> areas_;
  std::vector<char> held_;
  std::unique_ptr<FrontalCholesky> factorisation_;
};

/// A thread keeps its last plan: a search solves one shape of cell thousands of times.
CellPlan& plan_for(std::span<const double> sizes) {
  thread_local std::unique_ptr<CellPlan> last;
  if (!last || !last->is_for(sizes)) last = std::make_unique<CellPlan>(sizes);
  return *last;
}

/// Energy of each element times two, and the sum of its forces over all elements where `forces` is given.
std::vector<double> work_of(const CellPlan& plan, const std::vector<material::Lame>& lame, const NodalField& field,
                            NodalField* forces) {
  std::vector<double> work;
  const Grid& grid = plan.grid();
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      const auto nodes = element_nodes(grid, row, column);
      ElementVector own;
      for (int a = 0; a < kElementNodes; ++a)
        own.segment<2>(2 * a) = Eigen::Map<const Eigen::Vector2d>(field.data() + 2 * nodes[a]);
      const UnitStiffness& shape = *plan.shapes()[e];
      const ElementVector force = lame[e].mu_pa * (shape.shear * own) + lame[e].lambda_pa * (shape.bulk * own);
      work.push_back(own.dot(force));
      for (int a = 0; forces != nullptr && a < kElementNodes; ++a)
        Eigen::Map<Eigen::Vector2d>(forces->data() + 2 * nodes[a]) += force.segment<2>(2 * a);
    }
  return work;
}

/// The cell in equilibrium under a prescribed stretch, with the forces on its displacements.
struct Stretched {
  NodalField displacement, force;
};

Stretched stretched(CellPlan& plan, const std::vector<material::Lame>& lame, int direction) {
  Stretched result{.displacement = plan.stretch(direction), .force = NodalField(plan.held().size(), 0.0)};
  work_of(plan, lame, result.displacement, &result.force);
  plan.factorisation().solve(result.force);
  for (std::size_t i = 0; i < plan.held().size(); ++i)
    if (!plan.held()[i]) result.displacement[i] = -result.force[i];
  std::fill(result.force.begin(), result.force.end(), 0.0);
  work_of(plan, lame, result.displacement, &result.force);
  return result;
}

}  // namespace

Result<PulledCell> pull_cell(std::span<const double> sizes, const std::vector<material::Lame>& lame) {
  assert(!sizes.empty() && lame.size() == sizes.size() * sizes.size());
  CellPlan& plan = plan_for(sizes);
  if (!plan.factorisation().factorise(lame, plan.shapes())) return fail("a part of the cell has no stiffness");
  // Pulled with its sides held, then released: the sides come in until their force vanishes.
  const Stretched along = stretched(plan, lame, 1), across = stretched(plan, lame, 0);
  const auto work = [](const NodalField& displacement, const NodalField& force) {
    return std::inner_product(displacement.begin(), displacement.end(), force.begin(), 0.0);
  };
  const double contraction = work(along.displacement, across.force) / work(across.displacement, across.force);
  NodalField free = along.displacement;
  for (std::size_t i = 0; i < free.size(); ++i) free[i] -= contraction * across.displacement[i];

  PulledCell cell{.modulus_pa = 0.0, .energy_j_per_m3 = work_of(plan, lame, free, nullptr)};
  for (std::size_t e = 0; e < lame.size(); ++e) {
    cell.modulus_pa += cell.energy_j_per_m3[e] / (plan.length() * plan.length());
    cell.energy_j_per_m3[e] *= 0.5 / plan.areas()[e];
  }
  return cell;
}

}  // namespace nacre::fem
