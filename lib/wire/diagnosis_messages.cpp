#include "wire/diagnosis_messages.hpp"

#include <algorithm>

namespace nacre::wire {

std::string DiagnoseRequest::contradiction() const {
  return std::ranges::is_sorted(specimens, {}, &NamedSpecimen::name) ? "" : "specimens: they are not sorted";
}

}  // namespace nacre::wire
