// The operations of simd_packs.hpp for one element at a time, as a thread of a device has it, and as the host emulates
// it. Included inside a namespace, single precision only. No include guard on purpose.

#ifdef __CUDACC__
#define NACRE_INLINE __host__ __device__ __forceinline__
#else
#define NACRE_INLINE inline
#endif

template <class Real>
struct PackTypes;
template <>
struct PackTypes<float> {
  using Pack = float;
  using Bits = std::int32_t;
  static constexpr int kMantissaBits = 23;
  static constexpr std::int32_t kSqrtHalfBits = 0x3f3504f3;
};
template <class Real>
using Pack = typename PackTypes<Real>::Pack;
template <class Real>
using Bits = typename PackTypes<Real>::Bits;

template <class Real>
NACRE_INLINE Pack<Real> load(const Real* from) {
  return *from;
}
template <class Real>
NACRE_INLINE void store(Real* to, Pack<Real> value) {
  *to = value;
}
template <class Real>
NACRE_INLINE Pack<Real> broadcast(Real value) {
  return value;
}
template <class Real>
NACRE_INLINE Bits<Real> bits_of(Pack<Real> value) {
  Bits<Real> bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}
template <class Real>
NACRE_INLINE Pack<Real> pack_of(Bits<Real> bits) {
  Pack<Real> value;
  memcpy(&value, &bits, sizeof value);
  return value;
}
template <class Real>
NACRE_INLINE Pack<Real> converted(Bits<Real> whole) {
  return static_cast<Real>(whole);
}
template <class Real>
NACRE_INLINE Pack<Real> magnitude(Pack<Real> value) {
  return value < Real{0} ? -value : value;
}

NACRE_INLINE float fma(float a, float b, float c) { return ::fmaf(a, b, c); }
// A NaN gives the second number, as in simd_packs.hpp.
NACRE_INLINE float larger(float a, float b) { return a > b ? a : b; }
NACRE_INLINE float smaller(float a, float b) { return a < b ? a : b; }
NACRE_INLINE float square_root(float a) { return ::sqrtf(a); }

struct Flags {
  bool failed = false;
};
NACRE_INLINE void flag_unless_at_most(Flags& flags, float a, float b) { flags.failed = flags.failed || !(a <= b); }
NACRE_INLINE bool any(const Flags& flags) { return flags.failed; }
