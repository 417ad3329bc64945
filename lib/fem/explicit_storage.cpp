#include "fem/explicit_storage.hpp"

#include <algorithm>
#include <cassert>
#include <memory>

namespace nacre::fem {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kWorkRows = 11, kLedgerRows = 2;

int padded(int count) { return (count + kRowPadding - 1) / kRowPadding * kRowPadding; }

}  // namespace

template <class Real>
ExplicitStorage<Real>::ExplicitStorage(int columns, int rows, bool with_ledger, bool with_energies)
    : failed_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
  ExplicitState<Real>& s = state_;
  s.columns = columns;
  s.rows = rows;
  s.stride = padded(columns + 1) + kRowPadding;
  s.element_stride = padded(columns + 1);  // a row of elements and the nodes below it are one loop
  const std::size_t front = kRowPadding, row = static_cast<std::size_t>(s.stride);
  const std::size_t nodes = static_cast<std::size_t>(rows + 1) * row;
  const std::size_t elements = static_cast<std::size_t>(rows) * static_cast<std::size_t>(s.element_stride);
  const std::size_t fields = with_ledger ? 6 : 4, work_rows = kWorkRows + (with_ledger ? kLedgerRows : 0);
  size_ = fields * (nodes + front) + (with_energies ? 4 : 3) * elements + work_rows * (row + front);
  // Not by an aligned new: before glibc 2.38 every such block of a specimen leaves a hole that the next does not fill
  // (its bug 14581), a megabyte a fracture.
  memory_.resize(size_ + kAlignment / sizeof(Real));
  void* start = memory_.data();
  std::size_t space = memory_.size() * sizeof(Real);
  block_ = static_cast<Real*>(std::align(kAlignment, size_ * sizeof(Real), start, space));
  for (Real** field : {&s.qx, &s.qy, &s.vx, &s.vy}) *field = take(nodes, front);
  for (Real** field : {&s.mu, &s.lambda, &s.threshold}) *field = take(elements, 0);
  if (with_energies) s.energy = take(elements, 0);
  ExplicitRows<Real>& r = s.row;
  for (Real** field : {&r.upper_x, &r.upper_y, &r.below_x, &r.below_y, &r.sum_x[0], &r.sum_x[1], &r.sum_x[2],
                       &r.sum_y[0], &r.sum_y[1], &r.sum_y[2], &r.weight})
    *field = take(row, front);
  if (with_ledger)
    s.ledger = {.last_vx = take(nodes, front),
                .last_vy = take(nodes, front),
                .before_x = take(row, front),
                .before_y = take(row, front)};
  s.failed = failed_.data();
}

/// `count` numbers with `front` before them.
template <class Real>
Real* ExplicitStorage<Real>::take(std::size_t count, std::size_t front) {
  Real* start = block_ + used_ + front;
  used_ += front + count;
  assert(used_ <= size_);
  return start;
}

template <class Real>
std::size_t ExplicitStorage<Real>::bytes() const {
  return size_ * sizeof(Real) + failed_.size() * sizeof(std::int32_t);
}

template <>
const ExplicitKernel<float>& explicit_kernel<float>(SimdLevel level) {
  return level == SimdLevel::avx512 ? avx512::kSingle : level == SimdLevel::avx2 ? avx2::kSingle : baseline::kSingle;
}

template <>
const ExplicitKernel<double>& explicit_kernel<double>(SimdLevel level) {
  return level == SimdLevel::avx512 ? avx512::kDouble : level == SimdLevel::avx2 ? avx2::kDouble : baseline::kDouble;
}

template class ExplicitStorage<float>;
template class ExplicitStorage<double>;

}  // namespace nacre::fem
