// The sweep of explicit_kernel.ipp with the extended law, compiled once per instruction set.

#include "fem/extended_state.hpp"

#include "fem/explicit_kernel.ipp"

namespace nacre::fem::NACRE_SIMD {

#include "fem/extended_law.ipp"

template <class Real>
constexpr ExtendedKernel<Real> kExtendedTable = {advance<Extended<Real, true>, false>,
                                                 advance<CrackBand<Real>, false>,
                                                 internal_forces<Extended<Real, false>>};

extern const ExtendedKernel<float> kExtendedSingle = kExtendedTable<float>;
extern const ExtendedKernel<double> kExtendedDouble = kExtendedTable<double>;

}  // namespace nacre::fem::NACRE_SIMD
