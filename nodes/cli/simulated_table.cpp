#include "simulated_table.hpp"

#include <fmt/format.h>

#include "output.hpp"

namespace nacre::cli {
namespace {

using offline::end_of, offline::mean_of, offline::steps_of;
using offline::SimulatedDesign, offline::SimulateSettings;

std::string_view in_words(tester::EndReason reason) {
  switch (reason) {
    case tester::EndReason::stress_drop:
      return "the specimen separated";
    case tester::EndReason::strain_limit:
      return "unbroken at the largest strain";
    case tester::EndReason::no_failure:
      return "the soft material did not break";
    case tester::EndReason::step_limit:
      return "unbroken at the last step";
  }
  return "";
}

/// Behind the numbers: how the test ended, or how far a mean over specimens can be trusted.
std::string remark_on(const tester::ExpectedToughness& toughness, const SimulateSettings& settings) {
  if (!settings.tells_mean()) return fmt::format("{} after {} steps", in_words(end_of(toughness)), steps_of(toughness));
  if (!toughness.toughness_se_pa) return fmt::format("{}, one specimen", in_words(end_of(toughness)));
  return fmt::format("T +- {:.2g} MPa (standard error), scatter {:.0f} %, {} specimens",
                     1e-6 * *toughness.toughness_se_pa, 100.0 * *toughness.toughness_sd_pa / toughness.toughness_pa,
                     toughness.specimens.size());
}

}  // namespace

void print_table(const std::vector<SimulatedDesign>& designs, const SimulateSettings& settings) {
  fmt::print("{:<24} {:>10} {:>10} {:>10} {:>14}  {}\n", "pattern", "E / GPa", "T / MPa", "peak / MPa",
             "failure strain", settings.tells_mean() ? "mean over specimens" : "how the test ended");
  for (const SimulatedDesign& simulated : designs) {
    const std::string name =
        simulated.argument.size() <= 24 ? simulated.argument : simulated.design.name().substr(0, 24);
    if (const std::string failure = simulated.failure(); !failure.empty()) {
      fmt::print("{:<24} {}\n", name, failure);
      continue;
    }
    fmt::print("{:<24} {:>10}", name, simulated.modulus ? shown(1e-9 * (*simulated.modulus)->modulus_pa) : "");
    if (simulated.toughness) {
      const tester::ExpectedToughness& toughness = *simulated.toughness;
      fmt::print(" {:>10} {:>10.3f} {:>14.4f}  {}", shown(1e-6 * toughness.toughness_pa),
                 1e-6 * mean_of(toughness, &tester::ToughnessResult::peak_stress_pa),
                 mean_of(toughness, &tester::ToughnessResult::failure_strain), remark_on(toughness, settings));
    }
    fmt::print("\n");
  }
}

}  // namespace nacre::cli
