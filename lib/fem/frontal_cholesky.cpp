#include "fem/frontal_cholesky.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

#include "fem/element.hpp"

namespace nacre::fem {
namespace {

/// Pivots below this share of the stiffest element are rounding: a motion that nothing resists. Real ones stay above
/// 1e-8 for materials five decades apart.
constexpr double kSmallestPivot = 1e-12;

double stiffest(const std::vector<material::Lame>& lame) {
  double largest = 0.0;
  for (const material::Lame& constants : lame) largest = std::max(largest, constants.mu_pa + constants.lambda_pa);
  return largest;
}

}  // namespace

FrontalCholesky::FrontalCholesky(std::shared_ptr<const DissectionPlan> plan) : plan_(std::move(plan)) {
  std::size_t total = 0;
  int largest = 0;
  for (const DissectionBlock& block : plan_->blocks) {
    start_.push_back(total);
    total += static_cast<std::size_t>(block.front_size()) * static_cast<std::size_t>(block.front_size());
    largest = std::max(largest, block.front_size());
  }
  storage_.resize(total);
  local_.resize(largest);
}

FrontalCholesky::Front FrontalCholesky::front(std::size_t block) {
  const int size = plan_->blocks[block].front_size();
  return {storage_.data() + start_[block], size, size};
}

void FrontalCholesky::assemble_elements(const DissectionBlock& block, const std::vector<material::Lame>& lame,
                                        Front& target) {
  const UnitStiffness& unit = unit_stiffness();
  for (std::size_t k = 0; k < block.elements.size(); ++k) {
    const material::Lame& constants = lame[static_cast<std::size_t>(block.elements[k])];
    const ElementMatrix stiffness = constants.mu_pa * unit.shear + constants.lambda_pa * unit.bulk;
    const std::array<std::int16_t, 8>& places = block.element_places[k];
    for (std::size_t b = 0; b < 8; ++b)
      for (std::size_t a = 0; a < 8; ++a)
        if (places[b] >= 0 && places[a] >= places[b])
          target(places[a], places[b]) += stiffness(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
}

void FrontalCholesky::add_half(const DissectionBlock& block, std::size_t half, Front& target) {
  const auto index = static_cast<std::size_t>(block.halves[half]);
  const auto source = front(index);
  const auto first = static_cast<Eigen::Index>(plan_->blocks[index].pivots.size());
  const std::vector<std::int16_t>& places = block.half_places[half];
  const auto count = static_cast<Eigen::Index>(places.size());
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::int16_t column = places[static_cast<std::size_t>(j)];
    for (Eigen::Index i = j; i < count; ++i) {
      const std::int16_t row = places[static_cast<std::size_t>(i)];
      target(std::max(row, column), std::min(row, column)) += source(first + i, first + j);
    }
  }
}

bool FrontalCholesky::factorise(const std::vector<material::Lame>& lame) {
  const double smallest_pivot = kSmallestPivot * stiffest(lame);
  for (std::size_t k = 0; k < plan_->blocks.size(); ++k) {
    const DissectionBlock& block = plan_->blocks[k];
    Front matrix = front(k);
    matrix.setZero();
    if (block.halves[0] < 0) {
      assemble_elements(block, lame, matrix);
    } else {
      add_half(block, 0, matrix);
      add_half(block, 1, matrix);
    }
    const auto pivots = static_cast<Eigen::Index>(block.pivots.size()),
               border = static_cast<Eigen::Index>(block.border.size());
    if (pivots == 0) continue;
    Eigen::Ref<Eigen::MatrixXd> corner = matrix.topLeftCorner(pivots, pivots);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> in_place(corner);
    if (in_place.info() != Eigen::Success || corner.diagonal().array().square().minCoeff() < smallest_pivot)
      return false;
    if (border == 0) continue;
    auto side = matrix.bottomLeftCorner(border, pivots);
    corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(side);
    matrix.bottomRightCorner(border, border).selfadjointView<Eigen::Lower>().rankUpdate(side, -1.0);
  }
  return true;
}

void FrontalCholesky::solve(std::vector<double>& x) {
  const auto blocks = plan_->blocks.size();
  for (std::size_t k = 0; k < blocks; ++k) {
    const DissectionBlock& block = plan_->blocks[k];
    const Front matrix = front(k);
    const auto pivots = static_cast<Eigen::Index>(block.pivots.size()),
               border = static_cast<Eigen::Index>(block.border.size());
    auto head = local_.head(pivots);
    for (Eigen::Index i = 0; i < pivots; ++i)
      head[i] = x[static_cast<std::size_t>(block.pivots[static_cast<std::size_t>(i)])];
    matrix.topLeftCorner(pivots, pivots).triangularView<Eigen::Lower>().solveInPlace(head);
    for (Eigen::Index i = 0; i < pivots; ++i)
      x[static_cast<std::size_t>(block.pivots[static_cast<std::size_t>(i)])] = head[i];
    auto tail = local_.segment(pivots, border);
    tail.noalias() = matrix.bottomLeftCorner(border, pivots) * head;
    for (Eigen::Index i = 0; i < border; ++i)
      x[static_cast<std::size_t>(block.border[static_cast<std::size_t>(i)])] -= tail[i];
  }
  for (std::size_t k = blocks; k-- > 0;) {
    const DissectionBlock& block = plan_->blocks[k];
    const Front matrix = front(k);
    const auto pivots = static_cast<Eigen::Index>(block.pivots.size()),
               border = static_cast<Eigen::Index>(block.border.size());
    auto head = local_.head(pivots);
    auto tail = local_.segment(pivots, border);
    for (Eigen::Index i = 0; i < pivots; ++i)
      head[i] = x[static_cast<std::size_t>(block.pivots[static_cast<std::size_t>(i)])];
    for (Eigen::Index i = 0; i < border; ++i)
      tail[i] = x[static_cast<std::size_t>(block.border[static_cast<std::size_t>(i)])];
    head.noalias() -= matrix.bottomLeftCorner(border, pivots).transpose() * tail;
    matrix.topLeftCorner(pivots, pivots).triangularView<Eigen::Lower>().transpose().solveInPlace(head);
    for (Eigen::Index i = 0; i < pivots; ++i)
      x[static_cast<std::size_t>(block.pivots[static_cast<std::size_t>(i)])] = head[i];
  }
}

}  // namespace nacre::fem
