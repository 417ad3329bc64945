#include "optimize/sobol.hpp"

#include <bit>
#include <span>

#include "base/random.hpp"
#include "base/result.hpp"

namespace nacre::optimize {
namespace {

/// Primitive polynomial of one dimension (its inner coefficients as bits) and the first direction numbers m_1, m_2, ...
struct Dimension {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 6> first;
};

constexpr std::array<Dimension, SobolPoints::kMostDimensions - 1> kDimensions = {{{1, 0, {1}},
                                                                                  {2, 1, {1, 3}},
                                                                                  {3, 1, {1, 3, 1}},
                                                                                  {3, 2, {1, 1, 1}},
                                                                                  {4, 1, {1, 1, 3, 3}},
                                                                                  {4, 4, {1, 3, 5, 13}},
                                                                                  {5, 2, {1, 1, 5, 5, 17}},
                                                                                  {5, 4, {1, 1, 5, 5, 5}},
                                                                                  {5, 7, {1, 1, 7, 11, 19}},
                                                                                  {5, 11, {1, 1, 5, 1, 1}},
                                                                                  {5, 13, {1, 1, 1, 3, 11}},
                                                                                  {5, 14, {1, 3, 5, 5, 31}},
                                                                                  {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                                  {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                                  {6, 16, {1, 3, 1, 13, 27, 49}}}};

constexpr int kBitCount = 32;

std::array<std::uint32_t, kBitCount> directions_of(const Dimension& dimension) {
  std::array<std::uint32_t, kBitCount> v{};
  const int degree = dimension.degree;
  for (int i = 0; i < kBitCount; ++i) {
    const std::size_t at = i;
    if (i < degree) {
      v[at] = dimension.first[at] << (kBitCount - 1 - i);
      continue;
    }
    const std::uint32_t back = v[i - degree];
    v[at] = back ^ (back >> degree);
    for (int k = 1; k < degree; ++k) {
      if ((dimension.coefficients >> (degree - 1 - k)) & 1u) v[at] ^= v[i - k];
    }
  }
  return v;
}

}  // namespace

SobolPoints::SobolPoints(int dimension, std::uint64_t seed) {
  if (dimension < 1 || dimension > kMostDimensions) {
    throw InputError::format("Sobol sequence: dimension = {}, expected 1 to {}", dimension, kMostDimensions);
  }
  RandomStream random(seed, "optimize/sobol");
  for (int k = 0; k < dimension; ++k) {
    if (k == 0) {
      auto& v = directions_.emplace_back();
      for (int i = 0; i < kBits; ++i) v[i] = 1u << (kBits - 1 - i);
    } else {
      directions_.push_back(directions_of(kDimensions[k - 1]));
    }
    state_.push_back(0);
    shift_.push_back(static_cast<std::uint32_t>(random.bits() >> 32));
  }
}

Point SobolPoints::next() {
  constexpr double kScale = 1.0 / 4294967296.0;
  Point point;
  for (std::size_t k = 0; k < state_.size(); ++k) point.push_back(((state_[k] ^ shift_[k]) + 0.5) * kScale);
  const int flipped = std::countr_one(count_++);  // Gray code: one direction number a step
  for (std::size_t k = 0; k < state_.size(); ++k) state_[k] ^= directions_[k][flipped];
  return point;
}

}  // namespace nacre::optimize
