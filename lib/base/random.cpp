#include "base/random.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include "base/hash.hpp"

namespace nacre {

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : engine_(content_hash64(std::to_string(seed) + "/" + std::string(name))) {}

double RandomStream::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

int RandomStream::index(int count) {
  assert(count >= 1);
  const std::uint64_t n = static_cast<std::uint64_t>(count);
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % n;
  std::uint64_t draw = engine_();
  while (draw >= limit) draw = engine_();
  return draw % n;
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace nacre
