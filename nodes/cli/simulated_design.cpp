#include "simulated_design.hpp"

#include <fmt/format.h>

#include "output.hpp"

namespace nacre::cli {
namespace {

nlohmann::ordered_json to_json(const crack::CrackRecord& crack, const crack::Mechanisms& mechanisms) {
  nlohmann::ordered_json entry = {{"columns", crack.columns},
                                  {"rows", crack.rows},
                                  {"broken", crack.order.size()},
                                  {"branches", crack.branches},
                                  {"separate_cracks", crack.separate_cracks}};
  entry["path_ratio"] = nullptr;
  if (crack.path) {
    entry["path_ratio"] = crack.path->ratio();
    entry["path_length_m"] = crack.path->length_m;
    entry["straight_length_m"] = crack.path->straight_length_m;
    entry["bridged_share"] = crack.path->bridged_share;
    entry["soft_share"] = crack.path->material[0];
    entry["rigid_share"] = crack.path->material[1];
    entry["interface_share"] = crack.path->material[2];
    entry["crosses"] = crack.path->crosses;
    entry["path"] = crack.path->elements;
  }
  const auto names = crack::mechanism_names();
  const auto values = crack::values_of(mechanisms);
  for (std::size_t k = 0; k < names.size(); ++k) entry["mechanisms"][std::string(names[k].name)] = values[k];
  entry["order"] = nlohmann::ordered_json::array();
  for (const tester::Break& broken : crack.order) entry["order"].push_back(broken.element);
  return entry;
}

/// A mean over specimens of a number that each has.
double mean_of(const tester::ExpectedToughness& toughness, double tester::ToughnessResult::*number) {
  double sum = 0.0;
  for (const tester::ToughnessResult& specimen : toughness.specimens) sum += specimen.*number;
  return sum / static_cast<double>(toughness.specimens.size());
}

/// Time steps of all specimens.
std::int64_t steps_of(const tester::ExpectedToughness& toughness) {
  std::int64_t steps = 0;
  for (const tester::ToughnessResult& specimen : toughness.specimens) steps += specimen.steps;
  return steps;
}

/// Separation, unless a specimen's test ended otherwise: the first such reason.
tester::EndReason end_of(const tester::ExpectedToughness& toughness) {
  for (const tester::ToughnessResult& specimen : toughness.specimens)
    if (specimen.end != tester::EndReason::stress_drop) return specimen.end;
  return tester::EndReason::stress_drop;
}

/// The fields of a fracture test.
void add_toughness(nlohmann::ordered_json& entry, const SimulatedDesign& simulated) {
  const tester::ExpectedToughness& toughness = *simulated.toughness;
  entry["toughness_pa"] = toughness.toughness_pa;
  entry["peak_stress_pa"] = mean_of(toughness, &tester::ToughnessResult::peak_stress_pa);
  entry["failure_strain"] = mean_of(toughness, &tester::ToughnessResult::failure_strain);
  entry["end"] = tester::to_string(end_of(toughness));
  entry["steps"] = steps_of(toughness);
  double kernel_s = 0.0;
  for (const double each_s : simulated.kernel_s) kernel_s += each_s;
  entry["element_steps_per_s"] = static_cast<double>(steps_of(toughness)) *
                                 static_cast<double>(toughness.specimens.front().element_count) / kernel_s;
}

/// The fields of a mean over specimens.
void add_specimens(nlohmann::ordered_json& entry, const tester::ExpectedToughness& toughness, double strength_cv) {
  entry["toughness_se_pa"] = or_null(toughness.toughness_se_pa);
  entry["toughness_sd_pa"] = or_null(toughness.toughness_sd_pa);
  entry["specimens"] = toughness.specimens.size();
  entry["strength_cv"] = strength_cv;
  entry["by_specimen"] = nlohmann::ordered_json::array();
  for (const tester::ToughnessResult& specimen : toughness.specimens)
    entry["by_specimen"].push_back({{"toughness_pa", specimen.toughness_pa},
                                    {"peak_stress_pa", specimen.peak_stress_pa},
                                    {"failure_strain", specimen.failure_strain},
                                    {"end", tester::to_string(specimen.end)},
                                    {"steps", specimen.steps}});
}

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
std::string remark_on(const tester::ExpectedToughness& toughness, const SpecimenChoice& choice) {
  if (!choice.tells_mean()) return fmt::format("{} after {} steps", in_words(end_of(toughness)), steps_of(toughness));
  if (!toughness.toughness_se_pa) return fmt::format("{}, one specimen", in_words(end_of(toughness)));
  return fmt::format("T +- {:.2g} MPa (standard error), scatter {:.0f} %, {} specimens",
                     1e-6 * *toughness.toughness_se_pa, 100.0 * *toughness.toughness_sd_pa / toughness.toughness_pa,
                     toughness.specimens.size());
}

}  // namespace

std::string SimulatedDesign::failure() const {
  if (modulus && !*modulus) return "modulus: " + modulus->error().message;
  for (std::size_t i = 0; i < pulled.size(); ++i) {
    const std::string which = pulled.size() > 1 ? fmt::format(" of specimen {}", i) : "";
    if (!pulled[i]) return fmt::format("toughness{}: {}", which, pulled[i].error().message);
  }
  return "";
}

nlohmann::ordered_json to_json(const SimulatedDesign& simulated, const SpecimenChoice& choice) {
  nlohmann::ordered_json entry = {{"pattern", simulated.argument}, {"key", simulated.design.name()}};
  if (const std::string failure = simulated.failure(); !failure.empty()) {
    entry["error"] = failure;
    return entry;
  }
  for (const char* field :
       {"modulus_pa", "toughness_pa", "peak_stress_pa", "failure_strain", "end", "steps", "element_steps_per_s"}) {
    entry[field] = nullptr;
  }
  if (simulated.modulus) entry["modulus_pa"] = (*simulated.modulus)->modulus_pa;
  if (simulated.toughness) add_toughness(entry, simulated);
  if (simulated.toughness && choice.tells_mean()) add_specimens(entry, *simulated.toughness, choice.strength_cv);
  if (simulated.toughness && choice.tells_criterion()) entry["criterion"] = material::to_string(choice.criterion.kind);
  entry["crack"] = simulated.crack ? to_json(*simulated.crack, simulated.mechanisms) : nlohmann::ordered_json(nullptr);
  return entry;
}

void print_table(const std::vector<SimulatedDesign>& designs, const SpecimenChoice& choice) {
  fmt::print("{:<24} {:>10} {:>10} {:>10} {:>14}  {}\n", "pattern", "E / GPa", "T / MPa", "peak / MPa",
             "failure strain", choice.tells_mean() ? "mean over specimens" : "how the test ended");
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
                 mean_of(toughness, &tester::ToughnessResult::failure_strain), remark_on(toughness, choice));
    }
    fmt::print("\n");
  }
}

}  // namespace nacre::cli
