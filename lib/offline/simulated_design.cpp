#include "offline/simulated_design.hpp"

#include <fmt/format.h>

#include "offline/json_parts.hpp"

namespace nacre::offline {
namespace {

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

}  // namespace

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

double mean_of(const tester::ExpectedToughness& toughness, double tester::ToughnessResult::*number) {
  double sum = 0.0;
  for (const tester::ToughnessResult& specimen : toughness.specimens) sum += specimen.*number;
  return sum / static_cast<double>(toughness.specimens.size());
}

std::int64_t steps_of(const tester::ExpectedToughness& toughness) {
  std::int64_t steps = 0;
  for (const tester::ToughnessResult& specimen : toughness.specimens) steps += specimen.steps;
  return steps;
}

tester::EndReason end_of(const tester::ExpectedToughness& toughness) {
  for (const tester::ToughnessResult& specimen : toughness.specimens)
    if (specimen.end != tester::EndReason::stress_drop) return specimen.end;
  return tester::EndReason::stress_drop;
}

std::string SimulatedDesign::failure() const {
  if (modulus && !*modulus) return "modulus: " + modulus->error().message;
  for (std::size_t i = 0; i < pulled.size(); ++i) {
    const std::string which = pulled.size() > 1 ? fmt::format(" of specimen {}", i) : "";
    if (!pulled[i]) return fmt::format("toughness{}: {}", which, pulled[i].error().message);
  }
  return "";
}

nlohmann::ordered_json to_json(const SimulatedDesign& simulated, const SimulateSettings& settings) {
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
  if (simulated.toughness && settings.tells_mean())
    add_specimens(entry, *simulated.toughness, settings.parameters.strength_cv);
  if (simulated.toughness && settings.tells_criterion())
    entry["criterion"] = material::to_string(settings.parameters.criterion.kind);
  entry["crack"] = simulated.crack ? to_json(*simulated.crack, simulated.mechanisms) : nlohmann::ordered_json(nullptr);
  return entry;
}

}  // namespace nacre::offline
