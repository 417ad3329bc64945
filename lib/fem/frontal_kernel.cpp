#include "fem/frontal_kernel.hpp"

namespace nacre::fem {

const FrontalKernel& frontal_kernel(SimdLevel level) {
  return level == SimdLevel::avx512 ? avx512::kFrontal : level == SimdLevel::avx2 ? avx2::kFrontal : baseline::kFrontal;
}

}  // namespace nacre::fem
