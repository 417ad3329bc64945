#include "crack/mechanisms.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "tester/fracture_test.hpp"

namespace nacre::crack {
namespace {

fem::Phase phase_of(const fem::Grid& grid, int element) { return grid.phase[element]; }

/// The tip passes an element of the path when that and all failed ones before it have failed. It was arrested by the
/// element that failed last, soft or not.
double soft_arrest(const fem::Grid& grid, const CrackRecord& record) {
  std::map<int, double> strain_of;
  for (const tester::Break& broken : record.order) strain_of[broken.element] = broken.strain;
  std::optional<double> first;
  for (const int element : record.path->elements) {
    const auto failed = strain_of.find(element);
    if (failed != strain_of.end()) first = std::min(first.value_or(failed->second), failed->second);
  }
  if (!first) return 0.0;
  double tip = *first, waited = 0.0;
  for (const int element : record.path->elements) {
    const auto failed = strain_of.find(element);
    if (failed == strain_of.end() || failed->second <= tip) continue;
    if (phase_of(grid, element) == fem::Phase::soft) waited += failed->second - tip;
    tip = failed->second;
  }
  return tip > *first ? waited / (tip - *first) : 0.0;
}

/// Share of the specimen's elements that are soft or interface.
double weak_share(const fem::Grid& grid) {
  int weak = 0, all = 0;
  for (const fem::Phase phase : grid.phase) {
    if (phase == fem::Phase::empty) continue;
    ++all;
    weak += phase != fem::Phase::rigid;
  }
  return static_cast<double>(weak) / all;
}

}  // namespace

std::array<Mechanism, 5> mechanism_names() {
  return {{{"deflection", "the crack's path is longer than a straight crack"},
           {"branching", "the crack splits, or separate cracks open"},
           {"bridging", "intact ligaments bridge the crack when the test ends"},
           {"soft_arrest", "the tip waits in front of soft material"},
           {"guidance", "the path prefers soft material and interfaces"}}};
}

std::array<double, 5> values_of(const Mechanisms& m) {
  return {m.deflection, m.branching, m.bridging, m.soft_arrest, m.guidance};
}

Mechanisms mechanisms_of(const fem::Grid& notched, const CrackRecord& record) {
  if (!record.path) return {};
  const CrackPath& path = *record.path;
  return {.deflection = path.ratio() - 1.0,
          .branching = static_cast<double>(record.branches + record.separate_cracks),
          .bridging = path.bridged_share,
          .soft_arrest = soft_arrest(notched, record),
          .guidance = path.material[0] + path.material[2] - weak_share(notched)};
}

Mechanisms mechanisms_of(const tester::Simulation& simulation, const CrackRecord& record) {
  return mechanisms_of(tester::fracture_test(simulation).grid, record);
}

}  // namespace nacre::crack
