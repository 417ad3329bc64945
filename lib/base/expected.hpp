#pragma once

#include <stdexcept>
#include <utility>

#include "base/result.hpp"

namespace nacre {

/// The value of what cannot fail, such as reading what this program wrote itself. Throws std::logic_error.
template <class T>
T expected(Result<T> result) {
  if (!result) throw std::logic_error(result.error().message);
  return *std::move(result);
}

}  // namespace nacre
