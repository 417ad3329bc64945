#include "tester/unit_cell.hpp"

#include <algorithm>
#include <vector>

#include "fem/element.hpp"
#include "fem/mirror_cell.hpp"

namespace nacre::tester {
namespace {

/// Elements of the quarter along one side. The mirror lines run through elements -1 and 19 of a unit, between pixels.
constexpr int kQuarterElements = kElementsPerUnit / 2 + 1;

std::vector<double> element_sizes() {
  std::vector<double> sizes(kQuarterElements, 1.0);
  sizes.front() = sizes.back() = 0.5;
  return sizes;
}

int block_of(int i) { return std::clamp((i - 1) * kCellBlocks / (kQuarterElements - 1), 0, kCellBlocks - 1); }

}  // namespace

Result<UnitCell> pull_unit_cell(const pattern::Pattern& pattern, const material::ParameterSet& parameters,
                                AssemblyTarget target) {
  const fem::Grid grid = assemble_elastic_part(pattern.layout(), parameters, target, -1, kQuarterElements);
  const std::vector<double> sizes = element_sizes();
  const Result<fem::PulledCell> pulled = fem::pull_cell(sizes, fem::lame_of(grid));
  if (!pulled) return tl::unexpected(pulled.error());

  UnitCell cell{.modulus_pa = pulled->modulus_pa};
  std::array<double, kCellBlocks * kCellBlocks> areas{};
  for (int row = 0; row < kQuarterElements; ++row)
    for (int column = 0; column < kQuarterElements; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      const auto block = static_cast<std::size_t>(block_of(row) * kCellBlocks + block_of(column));
      const double area = sizes[row] * sizes[column];
      cell.load[block] += area * pulled->energy_j_per_m3[e] / grid.threshold_j_per_m3[e];
      areas[block] += area;
    }
  for (std::size_t block = 0; block < areas.size(); ++block) cell.load[block] /= areas[block];
  return cell;
}

}  // namespace nacre::tester
