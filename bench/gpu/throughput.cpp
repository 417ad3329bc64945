#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "base/random.hpp"
#include "batch.hpp"
#include "commands.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::gpu_study {

void run_throughput(const Options& options) {
  const auto fidelity = tester::fidelity_from_string(options.fidelity).value();
  RandomStream random(1, "throughput");  // the patterns of bench/speed/throughput
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(20, random);
  std::ofstream csv(options.table);
  fmt::print(csv,
             "batch,specimens,pulling_s,preparing_s,seconds_per_specimen,steps_per_specimen,element_steps_per_s\n");
  for (const int batch : options.batches) {
    // Twice as many as places, so that specimens are replaced.
    std::vector<tester::FractureTest> tests;
    for (int i = 0; i < 2 * batch; ++i) {
      tests.push_back(tester::fracture_test({.design = patterns[static_cast<std::size_t>(i) % patterns.size()],
                                             .parameters = material::default_parameters(),
                                             .conditions = {},
                                             .fidelity = fidelity}));
      tests.back().strain_limit = options.strain_limit;
    }
    if (places_on_device(tests.front(), batch, options.emulated) < batch) {
      fmt::print("a batch of {} does not fit into the device's memory\n", batch);
      break;
    }
    BatchTimes times;
    const auto results = pull_all(device_with(batch, options.emulated), batch, tests, times);
    double steps = 0.0, element_steps = 0.0;
    for (const auto& result : results) {
      steps += static_cast<double>(result.value().steps);
      element_steps += static_cast<double>(result.value().steps * result.value().element_count);
    }
    const double count = static_cast<double>(results.size());
    fmt::print("batch {}: {:.4f} s a specimen, {:.3g} element-steps/s, {:.0f} steps each; preparing {:.4f} s each\n",
               batch, times.pulling_s / count, element_steps / times.pulling_s, steps / count,
               times.preparing_s / count);
    fmt::print(csv, "{},{:.0f},{:.4f},{:.4f},{:.6f},{:.0f},{:.5g}\n", batch, count, times.pulling_s, times.preparing_s,
               times.pulling_s / count, steps / count, element_steps / times.pulling_s);
    csv.flush();
  }
}

}  // namespace nacre::gpu_study
