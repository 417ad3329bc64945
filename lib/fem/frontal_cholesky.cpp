#include "fem/frontal_cholesky.hpp"

#include <algorithm>

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

/// Where the update of each block is kept: two places per depth.
std::vector<std::size_t> update_places(const std::vector<DissectionBlock>& blocks) {
  std::vector<std::size_t> place(blocks.size(), 0);
  for (std::size_t k = blocks.size(); k-- > 0;)
    if (blocks[k].halves[0] >= 0)
      for (std::size_t half = 0; half < 2; ++half) place[blocks[k].halves[half]] = 2 * (place[k] / 2 + 1) + half;
  return place;
}

}  // namespace

FrontalCholesky::FrontalCholesky(std::shared_ptr<const DissectionPlan> plan, SimdLevel level)
    : plan_(std::move(plan)), kernel_(frontal_kernel(level)) {
  lay_out();
}

void FrontalCholesky::lay_out() {
  const std::vector<DissectionBlock>& blocks = plan_->blocks;
  const std::vector<std::size_t> place = update_places(blocks);
  std::vector<std::size_t> place_size(*std::max_element(place.begin(), place.end()) + 1, 0), factor_start;
  std::size_t factor_size = 0, pivots = 0;
  int largest = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    FrontView front{};
    front.pivots = blocks[k].pivot_count();
    front.pivot_rows = padded_front_rows(front.pivots);
    front.border = blocks[k].border_count();
    front.border_rows = padded_front_rows(front.border);
    fronts_.push_back(front);
    factor_start.push_back(factor_size);
    factor_size += front.stride() * front.pivots;
    pivots += blocks[k].pivots.size();
    place_size[place[k]] = std::max(place_size[place[k]], static_cast<std::size_t>(front.border_rows * front.border));
    largest = std::max(largest, front.stride());
  }
  std::vector<std::size_t> place_start(place_size.size(), 0);
  for (std::size_t i = 1; i < place_size.size(); ++i) place_start[i] = place_start[i - 1] + place_size[i - 1];
  factors_.resize(factor_size / kFrontPadding);
  updates_.resize((place_start.back() + place_size.back()) / kFrontPadding);
  local_.resize(static_cast<std::size_t>(largest) / kFrontPadding);
  inverses_.resize(pivots);
  std::size_t pivot = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    fronts_[k].factor = numbers(factors_) + factor_start[k];
    fronts_[k].update = numbers(updates_) + place_start[place[k]];
    fronts_[k].inverse = inverses_.data() + pivot;
    pivot += blocks[k].pivots.size();
  }
}

void FrontalCholesky::assemble(std::size_t k, const std::vector<material::Lame>& lame,
                               const std::vector<const UnitStiffness*>& shapes) {
  const DissectionBlock& block = plan_->blocks[k];
  const FrontView& front = fronts_[k];
  std::fill_n(front.factor, front.stride() * front.pivots, 0.0);
  std::fill_n(front.update, front.border_rows * front.border, 0.0);
  for (std::size_t e = 0; e < block.elements.size(); ++e) {
    const auto element = static_cast<std::size_t>(block.elements[e]);
    const material::Lame& constants = lame[element];
    const UnitStiffness& unit = shapes.empty() ? unit_stiffness() : *shapes[element];
    kernel_.add_element(front, {block.element_rows[e].data(), constants.mu_pa, constants.lambda_pa}, unit.shear.data(),
                        unit.bulk.data());
  }
  for (std::size_t half = 0; half < 2 && block.halves[half] >= 0; ++half)
    kernel_.add_half(front, fronts_[block.halves[half]], block.half_runs[half].data(),
                     static_cast<int>(block.half_runs[half].size()));
}

bool FrontalCholesky::factorise(const std::vector<material::Lame>& lame) { return factorise(lame, {}); }

bool FrontalCholesky::factorise(const std::vector<material::Lame>& lame,
                                const std::vector<const UnitStiffness*>& shapes) {
  const double smallest_pivot = kSmallestPivot * stiffest(lame);
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    assemble(k, lame, shapes);
    if (!kernel_.eliminate(fronts_[k], smallest_pivot)) return false;
  }
  return true;
}

void FrontalCholesky::solve(std::vector<double>& x) {
  double* const local = numbers(local_);
  const auto gather = [&](const std::vector<int>& unknowns, double* to) {
    for (std::size_t i = 0; i < unknowns.size(); ++i) to[i] = x[unknowns[i]];
  };
  const auto scatter = [&](const std::vector<int>& unknowns, const double* from) {
    for (std::size_t i = 0; i < unknowns.size(); ++i) x[unknowns[i]] = from[i];
  };
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    const DissectionBlock& block = plan_->blocks[k];
    const FrontView& front = fronts_[k];
    std::fill_n(local, front.stride(), 0.0);
    gather(block.pivots, local);
    gather(block.border, local + front.pivot_rows);
    kernel_.forward(front, local);
    scatter(block.pivots, local);
    scatter(block.border, local + front.pivot_rows);
  }
  for (std::size_t k = fronts_.size(); k-- > 0;) {
    const DissectionBlock& block = plan_->blocks[k];
    const FrontView& front = fronts_[k];
    std::fill_n(local, front.stride(), 0.0);
    gather(block.pivots, local);
    gather(block.border, local + front.pivot_rows);
    kernel_.backward(front, local);
    scatter(block.pivots, local);
  }
}

}  // namespace nacre::fem
