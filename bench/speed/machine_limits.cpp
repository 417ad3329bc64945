#include "machine_limits.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <immintrin.h>

#include "cpu_time.hpp"

namespace nacre::bench {
namespace {

constexpr int kRounds = 200'000;
constexpr int kRepeats = 7;

/// Operations in flight: enough to hide a latency of 4 at two per cycle.
constexpr int kChains = 12;

#define NACRE_CHAINS(OPERATION) \
  OPERATION(0)                  \
  OPERATION(1)                  \
  OPERATION(2)                  \
  OPERATION(3) OPERATION(4) OPERATION(5) OPERATION(6) OPERATION(7) OPERATION(8) OPERATION(9) OPERATION(10) OPERATION(11)
#define NACRE_CLOBBERS "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11"

/// Seconds that `rounds` rounds of one assembler text take: the compiler cannot shorten them. Registers 12 and 13 hold
/// ones.
#define NACRE_TIME(WIDTH, TEXT)                                                         \
  least_seconds_of(kRepeats, [] {                                                       \
    asm volatile(                                                                       \
        "vpcmpeqd %%ymm12, %%ymm12, %%ymm12\n vpsrld $25, %%ymm12, %%ymm12\n"           \
        "vpslld $23, %%ymm12, %%ymm12\n" WIDTH(12) WIDTH(13)::                          \
            : "xmm12", "xmm13");                                                        \
    for (int round = 0; round < kRounds; ++round) asm volatile(TEXT::: NACRE_CLOBBERS); \
  })
#define NACRE_SPREAD_512(r) "vshuff64x2 $0, %%zmm12, %%zmm12, %%zmm" #r "\n"
#define NACRE_SPREAD_256(r) "vmovaps %%ymm12, %%ymm" #r "\n"
#define NACRE_SPREAD_128(r) "movaps %%xmm12, %%xmm" #r "\n"
#define FUSED_512(r) "vfmadd231ps %%zmm12, %%zmm13, %%zmm" #r "\n"
#define FUSED_256(r) "vfmadd231ps %%ymm12, %%ymm13, %%ymm" #r "\n"
#define PAIR_512(r) "vmulps %%zmm12, %%zmm13, %%zmm" #r "\n vaddps %%zmm12, %%zmm13, %%zmm" #r "\n"
#define PAIR_256(r) "vmulps %%ymm12, %%ymm13, %%ymm" #r "\n vaddps %%ymm12, %%ymm13, %%ymm" #r "\n"
#define DIVIDE_512(r) "vdivps %%zmm12, %%zmm13, %%zmm" #r "\n"
#define DIVIDE_256(r) "vdivps %%ymm12, %%ymm13, %%ymm" #r "\n"

double clock_hz() {
  constexpr int kAdditions = 8;
  const double seconds = least_seconds_of(kRepeats, [] {
    long x = 0;
    for (int round = 0; round < kRounds; ++round)
      asm volatile("add $1,%0\n add $1,%0\n add $1,%0\n add $1,%0\n add $1,%0\n add $1,%0\n add $1,%0\n add $1,%0"
                   : "+r"(x));
  });
  return kAdditions * static_cast<double>(kRounds) / seconds;
}

/// Sums the array with loads alone.
__attribute__((target("avx512f"))) void read_512(const float* from, std::size_t count) {
  __m512 a = _mm512_setzero_ps(), b = a, c = a, d = a;
  for (std::size_t i = 0; i < count; i += 64) {
    a = _mm512_add_ps(a, _mm512_load_ps(from + i));
    b = _mm512_add_ps(b, _mm512_load_ps(from + i + 16));
    c = _mm512_add_ps(c, _mm512_load_ps(from + i + 32));
    d = _mm512_add_ps(d, _mm512_load_ps(from + i + 48));
  }
  asm volatile("" ::"v"(a), "v"(b), "v"(c), "v"(d));
}
__attribute__((target("avx512f"))) void update_512(float* at, std::size_t count) {
  const __m512 one = _mm512_set1_ps(1.0f);
  for (std::size_t i = 0; i < count; i += 32) {
    _mm512_store_ps(at + i, _mm512_add_ps(_mm512_load_ps(at + i), one));
    _mm512_store_ps(at + i + 16, _mm512_add_ps(_mm512_load_ps(at + i + 16), one));
  }
}
__attribute__((target("avx2"))) void read_256(const float* from, std::size_t count) {
  __m256 a = _mm256_setzero_ps(), b = a, c = a, d = a;
  for (std::size_t i = 0; i < count; i += 32) {
    a = _mm256_add_ps(a, _mm256_load_ps(from + i));
    b = _mm256_add_ps(b, _mm256_load_ps(from + i + 8));
    c = _mm256_add_ps(c, _mm256_load_ps(from + i + 16));
    d = _mm256_add_ps(d, _mm256_load_ps(from + i + 24));
  }
  asm volatile("" ::"x"(a), "x"(b), "x"(c), "x"(d));
}
__attribute__((target("avx2"))) void update_256(float* at, std::size_t count) {
  const __m256 one = _mm256_set1_ps(1.0f);
  for (std::size_t i = 0; i < count; i += 16) {
    _mm256_store_ps(at + i, _mm256_add_ps(_mm256_load_ps(at + i), one));
    _mm256_store_ps(at + i + 8, _mm256_add_ps(_mm256_load_ps(at + i + 8), one));
  }
}

Bandwidth bandwidth(const std::string& level, std::size_t bytes, bool wide) {
  struct alignas(64) Line {
    float number[16] = {};
  };
  std::vector<Line> lines(bytes / sizeof(Line));
  float* const numbers = lines.data()->number;
  const std::size_t count = lines.size() * 16;
  const int rounds = std::max(1, static_cast<int>((std::size_t{1} << 28) / bytes));
  const double read = least_seconds_of(kRepeats, [&] {
    for (int round = 0; round < rounds; ++round) (wide ? read_512 : read_256)(numbers, count);
  });
  const double update = least_seconds_of(kRepeats, [&] {
    for (int round = 0; round < rounds; ++round) (wide ? update_512 : update_256)(numbers, count);
  });
  const double moved = static_cast<double>(bytes) * rounds;
  return {.level = level, .bytes = bytes, .read_per_s = moved / read, .update_per_s = 2.0 * moved / update};
}

}  // namespace

MachineLimits measure_limits(fem::SimdLevel level) {
  const bool wide = level == fem::SimdLevel::avx512;
  const double operations = static_cast<double>(kRounds) * kChains * (wide ? 16 : 8);
  MachineLimits limits{};
  limits.clock_hz = clock_hz();
  const double fused = wide ? NACRE_TIME(NACRE_SPREAD_512, NACRE_CHAINS(FUSED_512))
                            : NACRE_TIME(NACRE_SPREAD_256, NACRE_CHAINS(FUSED_256));
  const double pairs = wide ? NACRE_TIME(NACRE_SPREAD_512, NACRE_CHAINS(PAIR_512))
                            : NACRE_TIME(NACRE_SPREAD_256, NACRE_CHAINS(PAIR_256));
  const double divisions = wide ? NACRE_TIME(NACRE_SPREAD_512, NACRE_CHAINS(DIVIDE_512))
                                : NACRE_TIME(NACRE_SPREAD_256, NACRE_CHAINS(DIVIDE_256));
  limits.fused_per_s = 2.0 * operations / fused;
  limits.multiply_and_add_per_s = 2.0 * operations / pairs;
  limits.divisions_per_s = operations / divisions;
  limits.memory = {bandwidth("L1", std::size_t{16} << 10, wide), bandwidth("L2", std::size_t{512} << 10, wide),
                   bandwidth("L3", std::size_t{8} << 20, wide), bandwidth("DRAM", std::size_t{256} << 20, wide)};
  return limits;
}

std::string core_name() {
  std::ifstream lines("/proc/cpuinfo");
  std::string line, name, family, model;
  const auto value = [&] { return line.substr(std::min(line.size(), line.find(':') + 2)); };
  while (std::getline(lines, line) && !line.empty()) {
    if (line.starts_with("model name")) name = value();
    if (line.starts_with("cpu family")) family = value();
    if (line.starts_with("model\t")) model = value();
  }
  return fmt::format("{}, family {}, model {}", name, family, model);
}

}  // namespace nacre::bench
