#include "tester/expected_toughness.hpp"

#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "base/statistics.hpp"

namespace nacre::tester {

ExpectedToughness expected_toughness_of(std::vector<ToughnessResult> specimens) {
  assert(!specimens.empty());
  std::vector<double> values_pa;
  for (const ToughnessResult& specimen : specimens) values_pa.push_back(specimen.toughness_pa);
  ExpectedToughness expected{
      .toughness_pa = mean(values_pa), .toughness_sd_pa = {}, .toughness_se_pa = {}, .specimens = std::move(specimens)};
  if (values_pa.size() < 2) return expected;
  expected.toughness_sd_pa = standard_deviation(values_pa);
  expected.toughness_se_pa = *expected.toughness_sd_pa / std::sqrt(static_cast<double>(values_pa.size()));
  return expected;
}

Result<ExpectedToughness> expected_toughness(const Simulation& simulation, int count,
                                             const Discretisation& discretisation, int threads) {
  assert(count >= 1);
  std::vector<Result<ToughnessResult>> tested(count, fail("not tested"));
  parallel_for(
      count,
      [&](int i) {
        Simulation own = simulation;
        own.specimen = i;
        tested[static_cast<std::size_t>(i)] = test_toughness(own, discretisation);
      },
      threads);
  std::vector<ToughnessResult> specimens;
  for (std::size_t i = 0; i < tested.size(); ++i) {
    if (!tested[i]) return fail("specimen {}: {}", i, tested[i].error().message);
    specimens.push_back(*std::move(tested[i]));
  }
  return expected_toughness_of(std::move(specimens));
}

}  // namespace nacre::tester
