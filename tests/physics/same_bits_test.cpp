// The testers give the same bits on every instruction set, for any number of threads and in any order of a batch.

#include <cstdio>

#include <gtest/gtest.h>

#include "../output_of.hpp"
#include "specimens.hpp"
#include "tester/modulus.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

// The same bits from every instruction set this machine has; the wide ones on a whole test, the slow baseline on its
// start.
TEST(SameBits, EveryInstructionSet) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  std::vector<tester::ToughnessResult> results;
  for (const fem::SimdLevel level : {fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(level)) continue;
    test.settings.simd = level;
    results.push_back(tester::run_fracture_test<float>(test).value());
    EXPECT_EQ(results.back().curve, results.front().curve);
    EXPECT_EQ(results.back().toughness_pa, results.front().toughness_pa);
  }
  // The baseline has to agree from before the first failure until after the crack has run.
  test.settings.strain_rate_per_s *= 4.0;
  const auto pulled_results = verification::pulled_by_every_simd_level(test, 4000);
  for (const auto& pulled : pulled_results) {
    EXPECT_GT(pulled.failed, 10);
    EXPECT_EQ(pulled.stresses_pa, pulled_results.front().stresses_pa) << fem::to_string(pulled.level);
  }
}

/// E and T of some specimens, exactly, with the instruction set in use.
std::string exact_results() {
  std::string text(fem::to_string(fem::best_simd_level()));
  for (const pattern::Design& design : patterns(2))
    text += fmt::format(" {:a} {:a}", tester::test_modulus(specimen(design)).value().modulus_pa,
                        tester::test_toughness(specimen(design)).value().toughness_pa);
  return text;
}

/// Not a test: the output of the other processes that SimdLevelForcedFromOutside starts.
TEST(SameBits, DISABLED_SayExactResults) { std::printf("RESULTS %s\n", exact_results().c_str()); }

/// The results of this program run anew under an environment setting; the instruction set comes first.
std::string results_of_process(const std::string& environment) {
  const std::string output =
      output_of(environment + " '" + std::string(testing::internal::GetArgvs().front()) +
                "' --gtest_also_run_disabled_tests --gtest_filter=SameBits.DISABLED_SayExactResults");
  const std::size_t start = output.find("RESULTS ");
  if (start == std::string::npos) return output;
  return output.substr(start + 8, output.find('\n', start) - start - 8);
}

// NACRE_SIMD=avx2 really runs that instruction set in every part of the testers, and no bit of E or T changes. (The
// baseline is too slow for whole tests; EveryInstructionSet covers it.)
TEST(SameBits, InstructionSetForcedFromOutside) {
  if (!fem::has_simd_level(fem::SimdLevel::avx2)) GTEST_SKIP() << "this processor has no AVX2";
  const std::string own = exact_results(), forced = results_of_process("NACRE_SIMD=avx2");
  ASSERT_EQ(forced.substr(0, 5), "avx2 ") << forced;
  EXPECT_EQ(forced.substr(forced.find(' ')), own.substr(own.find(' ')));
}

/// E and T of designs in the order given, on `threads` threads.
std::vector<std::pair<double, double>> batch_results(const std::vector<pattern::Design>& designs, int threads) {
  std::vector<std::pair<double, double>> results(designs.size());
  parallel_for(
      static_cast<int>(designs.size()),
      [&](int i) {
        const tester::Simulation simulation = specimen(designs[i]);
        results[i] = {tester::test_modulus(simulation).value().modulus_pa,
                      tester::test_toughness(simulation).value().toughness_pa};
      },
      threads);
  return results;
}

TEST(SameBits, AnyNumberOfThreadsAndAnyOrderOfTheBatch) {
  std::vector<pattern::Design> designs = patterns(5);
  designs.emplace_back(pattern::Mixture{0.8});
  const auto alone = batch_results(designs, 1);
  EXPECT_EQ(batch_results(designs, 3), alone);
  std::vector<pattern::Design> backwards(designs.rbegin(), designs.rend());
  auto results = batch_results(backwards, 2);
  std::reverse(results.begin(), results.end());
  EXPECT_EQ(results, alone);
}

}  // namespace
}  // namespace nacre
