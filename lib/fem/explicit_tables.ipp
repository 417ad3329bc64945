// The entry points of the kernel of Eq. 2.1, for explicit_kernel_*.cpp.

#include "fem/explicit_kernel.ipp"

namespace nacre::fem::NACRE_SIMD {

template <class Real>
constexpr ExplicitKernel<Real> kTable = {advance<NeoHookean<Real>, false>, advance<NeoHookean<Real>, true>,
                                         advance<NeoHookeanMean<Real>, false>, first_inverted<Real>,
                                         internal_forces<NeoHookean<Real>>};

extern const ExplicitKernel<float> kSingle = kTable<float>;
extern const ExplicitKernel<double> kDouble = kTable<double>;

}  // namespace nacre::fem::NACRE_SIMD
