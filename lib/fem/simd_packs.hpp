// Packs of numbers for the kernels: GCC vector types plus the few operations that need an instruction of their
// own. Included once per instruction set, inside namespace nacre::fem::NACRE_SIMD. No include guard on purpose.
//
// Every operation rounds the same way at every width, so results do not depend on the instruction set. The fused
// multiply-add is exact too: the baseline, which has none, forms it in double precision with rounding to odd.

#if defined(__AVX512F__)
inline constexpr int kPackBytes = 64;
#elif defined(__FMA__)
inline constexpr int kPackBytes = 32;
#else
inline constexpr int kPackBytes = 16;
#endif

template <class Real>
struct PackTypes;
template <>
struct PackTypes<float> {
  typedef float Pack __attribute__((vector_size(kPackBytes)));
  typedef std::int32_t Bits __attribute__((vector_size(kPackBytes)));
  static constexpr int kMantissaBits = 23;
  static constexpr std::int32_t kSqrtHalfBits = 0x3f3504f3;
};
template <>
struct PackTypes<double> {
  typedef double Pack __attribute__((vector_size(kPackBytes)));
  typedef std::int64_t Bits __attribute__((vector_size(kPackBytes)));
  static constexpr int kMantissaBits = 52;
  static constexpr std::int64_t kSqrtHalfBits = 0x3fe6a09e667f3bcd;
};
template <class Real>
using Pack = typename PackTypes<Real>::Pack;
template <class Real>
using Bits = typename PackTypes<Real>::Bits;
template <class Real>
inline constexpr int kLanes = kPackBytes / static_cast<int>(sizeof(Real));

#define NACRE_INLINE [[gnu::always_inline]] inline

template <class Real>
NACRE_INLINE Pack<Real> load(const Real* from) {
  Pack<Real> pack;
  __builtin_memcpy(&pack, from, kPackBytes);
  return pack;
}
template <class Real>
NACRE_INLINE void store(Real* to, Pack<Real> pack) {
  __builtin_memcpy(to, &pack, kPackBytes);
}
template <class Real>
NACRE_INLINE Pack<Real> broadcast(Real value) {
  return value - Pack<Real>{};
}

/// The bits of a pack, a pack of bits, and whole numbers as numbers.
template <class Real>
NACRE_INLINE Bits<Real> bits_of(Pack<Real> pack) {
  return (Bits<Real>)pack;
}
template <class Real>
NACRE_INLINE Pack<Real> pack_of(Bits<Real> bits) {
  return (Pack<Real>)bits;
}
template <class Real>
NACRE_INLINE Pack<Real> converted(Bits<Real> bits) {
  return __builtin_convertvector(bits, Pack<Real>);
}

/// Absolute value.
template <class Real>
NACRE_INLINE Pack<Real> magnitude(Pack<Real> pack) {
  return pack_of<Real>(bits_of<Real>(pack) & ~bits_of<Real>(-Pack<Real>{}));
}

/// Lanes seen so far in which a comparison failed. shifted(): the last lane of the pack before, then the others but the
/// last.
#if defined(__AVX512F__)
struct Flags {
  unsigned bits = 0;
};
NACRE_INLINE Pack<float> fma(Pack<float> a, Pack<float> b, Pack<float> c) { return _mm512_fmadd_ps(a, b, c); }
NACRE_INLINE Pack<double> fma(Pack<double> a, Pack<double> b, Pack<double> c) { return _mm512_fmadd_pd(a, b, c); }
NACRE_INLINE Pack<float> larger(Pack<float> a, Pack<float> b) { return _mm512_max_ps(a, b); }
NACRE_INLINE Pack<double> larger(Pack<double> a, Pack<double> b) { return _mm512_max_pd(a, b); }
NACRE_INLINE Pack<float> smaller(Pack<float> a, Pack<float> b) { return _mm512_min_ps(a, b); }
NACRE_INLINE Pack<double> smaller(Pack<double> a, Pack<double> b) { return _mm512_min_pd(a, b); }
NACRE_INLINE Pack<float> square_root(Pack<float> a) { return _mm512_sqrt_ps(a); }
NACRE_INLINE Pack<double> square_root(Pack<double> a) { return _mm512_sqrt_pd(a); }
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<float> a, Pack<float> b) {
  flags.bits |= _mm512_cmp_ps_mask(a, b, _CMP_NLE_UQ);
}
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<double> a, Pack<double> b) {
  flags.bits |= _mm512_cmp_pd_mask(a, b, _CMP_NLE_UQ);
}
NACRE_INLINE bool any(const Flags& flags) { return flags.bits != 0; }
NACRE_INLINE Pack<float> shifted(Pack<float> before, Pack<float> pack) {
  return (Pack<float>)_mm512_alignr_epi32((__m512i)pack, (__m512i)before, 15);
}
NACRE_INLINE Pack<double> shifted(Pack<double> before, Pack<double> pack) {
  return (Pack<double>)_mm512_alignr_epi64((__m512i)pack, (__m512i)before, 7);
}
#elif defined(__FMA__)
struct Flags {
  __m256 bits = _mm256_setzero_ps();
};
NACRE_INLINE Pack<float> fma(Pack<float> a, Pack<float> b, Pack<float> c) { return _mm256_fmadd_ps(a, b, c); }
NACRE_INLINE Pack<double> fma(Pack<double> a, Pack<double> b, Pack<double> c) { return _mm256_fmadd_pd(a, b, c); }
NACRE_INLINE Pack<float> larger(Pack<float> a, Pack<float> b) { return _mm256_max_ps(a, b); }
NACRE_INLINE Pack<double> larger(Pack<double> a, Pack<double> b) { return _mm256_max_pd(a, b); }
NACRE_INLINE Pack<float> smaller(Pack<float> a, Pack<float> b) { return _mm256_min_ps(a, b); }
NACRE_INLINE Pack<double> smaller(Pack<double> a, Pack<double> b) { return _mm256_min_pd(a, b); }
NACRE_INLINE Pack<float> square_root(Pack<float> a) { return _mm256_sqrt_ps(a); }
NACRE_INLINE Pack<double> square_root(Pack<double> a) { return _mm256_sqrt_pd(a); }
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<float> a, Pack<float> b) {
  flags.bits = _mm256_or_ps(flags.bits, _mm256_cmp_ps(a, b, _CMP_NLE_UQ));
}
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<double> a, Pack<double> b) {
  flags.bits = _mm256_or_ps(flags.bits, _mm256_castpd_ps(_mm256_cmp_pd(a, b, _CMP_NLE_UQ)));
}
NACRE_INLINE bool any(const Flags& flags) { return _mm256_movemask_ps(flags.bits) != 0; }
NACRE_INLINE Pack<float> shifted(Pack<float> before, Pack<float> pack) {
  const __m256i middle = _mm256_permute2x128_si256((__m256i)before, (__m256i)pack, 0x21);
  return (Pack<float>)_mm256_alignr_epi8((__m256i)pack, middle, 12);
}
NACRE_INLINE Pack<double> shifted(Pack<double> before, Pack<double> pack) {
  const __m256i middle = _mm256_permute2x128_si256((__m256i)before, (__m256i)pack, 0x21);
  return (Pack<double>)_mm256_alignr_epi8((__m256i)pack, middle, 8);
}
#else
struct Flags {
  __m128 bits = _mm_setzero_ps();
};
/// a b + c rounded once: the product is exact in double; the sum is rounded to odd there, so that the second rounding
/// to single is the only one that has an effect.
NACRE_INLINE float fused(float a, float b, float c) {
  const double product = static_cast<double>(a) * b;
  double sum = product + c;
  const double part = sum - product;
  const double error = (product - (sum - part)) + (c - part);
  std::int64_t bits;
  __builtin_memcpy(&bits, &sum, sizeof bits);
  if (error != 0.0 && (bits & 1) == 0) bits += ((error > 0.0) == (sum > 0.0)) ? 1 : -1;
  __builtin_memcpy(&sum, &bits, sizeof bits);
  return static_cast<float>(sum);
}
NACRE_INLINE Pack<float> fma(Pack<float> a, Pack<float> b, Pack<float> c) {
  Pack<float> result;
  for (int lane = 0; lane < kLanes<float>; ++lane) result[lane] = fused(a[lane], b[lane], c[lane]);
  return result;
}
NACRE_INLINE Pack<double> fma(Pack<double> a, Pack<double> b, Pack<double> c) {
  Pack<double> result;
  for (int lane = 0; lane < kLanes<double>; ++lane) result[lane] = __builtin_fma(a[lane], b[lane], c[lane]);
  return result;
}
NACRE_INLINE Pack<float> larger(Pack<float> a, Pack<float> b) { return _mm_max_ps(a, b); }
NACRE_INLINE Pack<double> larger(Pack<double> a, Pack<double> b) { return _mm_max_pd(a, b); }
NACRE_INLINE Pack<float> smaller(Pack<float> a, Pack<float> b) { return _mm_min_ps(a, b); }
NACRE_INLINE Pack<double> smaller(Pack<double> a, Pack<double> b) { return _mm_min_pd(a, b); }
NACRE_INLINE Pack<float> square_root(Pack<float> a) { return _mm_sqrt_ps(a); }
NACRE_INLINE Pack<double> square_root(Pack<double> a) { return _mm_sqrt_pd(a); }
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<float> a, Pack<float> b) {
  flags.bits = _mm_or_ps(flags.bits, _mm_cmpnle_ps(a, b));
}
NACRE_INLINE void flag_unless_at_most(Flags& flags, Pack<double> a, Pack<double> b) {
  flags.bits = _mm_or_ps(flags.bits, _mm_castpd_ps(_mm_cmpnle_pd(a, b)));
}
NACRE_INLINE bool any(const Flags& flags) { return _mm_movemask_ps(flags.bits) != 0; }
NACRE_INLINE Pack<float> shifted(Pack<float> before, Pack<float> pack) {
  return Pack<float>{before[3], pack[0], pack[1], pack[2]};
}
NACRE_INLINE Pack<double> shifted(Pack<double> before, Pack<double> pack) { return Pack<double>{before[1], pack[0]}; }
#endif
