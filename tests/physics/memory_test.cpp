// A batch of specimens takes the memory of one: nothing of a simulation outlives it.

#include <malloc.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../instrumented.hpp"
#include "fem/explicit_storage.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"

namespace nacre {
namespace {

tester::Simulation specimen() {
  return {.design = pattern::design_from_name("577fffe9fffdef").value(),
          .parameters = material::thesis_parameters(),
          .conditions = {},
          .fidelity = tester::Fidelity::tiny};
}

/// Bytes in use of all arenas of the heap, large blocks included.
std::size_t bytes_in_use() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

// The first round may keep memory that threads reserve for the next specimen; after it, 1000 more add nothing. The
// pulls end at a strain of 0.001, which leaves out nothing that a longer one would allocate but frames.
TEST(Memory, ThousandSpecimensTakeThatOfOne) {
  tester::FractureTest test = tester::fracture_test(specimen());
  test.strain_limit = 0.001;
  const auto batch = [&](int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(tester::run_fracture_test<float>(test));
      ASSERT_TRUE(tester::test_modulus(specimen()));
    }
  };
  batch(10);
  const std::size_t before = bytes_in_use();
  batch(1000);
  EXPECT_LT(bytes_in_use(), before + 4096);
}

// A search keeps a little of every specimen, which may come to lie where the next one would have fitted: the heap as
// taken from the system, holes and all, stays that of one.
TEST(Memory, WhatIsKeptOfASpecimenLeavesNoHole) {
  if (test::kIsInstrumented) GTEST_SKIP() << "sanitizers bring a heap of their own";
  const tester::Simulation simulation = specimen();
  const auto taken_from_system = [] {
    const struct mallinfo2 heap = mallinfo2();
    return heap.arena + heap.hblkhd;
  };
  std::map<std::string, std::vector<std::string>> kept;
  const auto batch = [&](int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(tester::test_modulus(simulation));
      ASSERT_TRUE(tester::test_toughness(simulation));
      kept[fmt::format("design {}", kept.size())] = {"a modulus of some digits", "a toughness of a few more digits"};
    }
  };
  batch(5);
  const std::size_t before = taken_from_system();
  batch(30);
  EXPECT_LT(taken_from_system(), before + 500'000);
}

// What one full toughness specimen needs, as docs/studies/speed.md states it.
TEST(Memory, ExplicitStateOfAFullSpecimenIsAboutOneMegabyte) {
  EXPECT_LT(fem::ExplicitStorage<float>(200, 160, false).bytes(), 1'200'000u);
  EXPECT_GT(fem::ExplicitStorage<float>(200, 160, false).bytes(), 200u * 160u * 7u * sizeof(float));
}

}  // namespace
}  // namespace nacre
