#include "explore/exact_modulus.hpp"

#include "base/parallel.hpp"

namespace nacre::explore {

ModulusOf modulus_by_tester(const material::ParameterSet& parameters, tester::Fidelity fidelity, int threads) {
  return [=](std::span<const pattern::Pattern> patterns) {
    std::vector<std::optional<double>> moduli(patterns.size());
    parallel_for(
        static_cast<int>(patterns.size()),
        [&](int i) {
          const auto index = static_cast<std::size_t>(i);
          if (const auto result = tester::test_modulus({patterns[index], parameters, {}, fidelity}))
            moduli[index] = result->modulus_pa;
        },
        threads);
    return moduli;
  };
}

}  // namespace nacre::explore
