#include "optimize/space_filling.hpp"

#include <cmath>

#include "base/random.hpp"

namespace nacre::optimize {

SpaceFillingPoints::SpaceFillingPoints(int dimension, std::uint64_t seed) {
  double g = 2.0;
  for (int i = 0; i < 60; ++i) g = std::pow(1.0 + g, 1.0 / (dimension + 1));  // contracts by more than half a step
  RandomStream random(seed, "optimize/space-filling");
  for (int k = 1; k <= dimension; ++k) {
    stride_.push_back(std::pow(g, -k));
    position_.push_back(random.uniform());
  }
}

Point SpaceFillingPoints::next() {
  for (std::size_t k = 0; k < position_.size(); ++k) position_[k] = std::fmod(position_[k] + stride_[k], 1.0);
  return position_;
}

}  // namespace nacre::optimize
