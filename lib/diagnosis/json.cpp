#include <nlohmann/json.hpp>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

using nlohmann::ordered_json;

namespace {

ordered_json json_of(const NamedEffect& e) {
  return {{"name", e.name}, {"family", e.family}, {"parameter", e.parameter}, {"interval90", {e.interval_low, e.interval_high}}, {"unit", e.unit}};
}

ordered_json json_of(const Candidate& c) {
  return {{"name", c.name},           {"status", c.status},         {"statistic", c.statistic}, {"p_family_wise", c.p_family_wise},
          {"absorption", c.absorption}, {"signal_to_noise", c.signal_to_noise}, {"parameter", c.parameter}, {"p_fit", c.p_fit}};
}

ordered_json json_of(const Contrast& c) { return {{"name", c.name}, {"statistic", c.statistic}, {"p_family_wise", c.p_family_wise}}; }

ordered_json json_of(const Gain& g) {
  return {{"held_out_error_before", g.held_out_error_before},
          {"held_out_error_after", g.held_out_error_after},
          {"relative_reduction", g.relative_reduction},
          {"interval90", {g.interval_low, g.interval_high}}};
}

ordered_json json_of(const NextExperiment& e) {
  return {{"design", e.design.name()},
          {"test", tester::to_string(e.test)},
          {"orientation_deg", e.conditions.orientation_deg},
          {"strain_rate_per_s", e.conditions.strain_rate_per_s},
          {"thickness_mm", e.conditions.thickness_mm},
          {"replicates", e.replicates},
          {"reason", e.reason}};
}

ordered_json json_of(const ResidualRow& r) {
  return {{"design", r.design},     {"orientation_deg", r.orientation_deg}, {"measured_pa", r.measured_pa},
          {"base_pa", r.base_pa}, {"extended_pa", r.extended_pa},         {"standard_error", r.standard_error}};
}

template <class T>
ordered_json array_of(const std::vector<T>& items) {
  ordered_json array = ordered_json::array();
  for (const T& item : items) array.push_back(json_of(item));
  return array;
}

}  // namespace

std::string to_json(const Diagnosis& d) {
  const ordered_json document = {{"verdict", to_string(d.verdict)},
                                 {"summary", d.summary},
                                 {"effects", array_of(d.effects)},
                                 {"candidates", array_of(d.candidates)},
                                 {"contrasts", array_of(d.contrasts)},
                                 {"gain", d.gain ? json_of(*d.gain) : ordered_json(nullptr)},
                                 {"next_experiments", array_of(d.next_experiments)},
                                 {"p_misfit", d.p_misfit},
                                 {"replicate_sd", d.replicate_sd},
                                 {"numerics_sd", d.numerics_sd},
                                 {"numerics_shared_sd", d.numerics_shared_sd},
                                 {"noise_known", d.noise_known},
                                 {"residuals", array_of(d.residuals)}};
  return document.dump(2);
}

}  // namespace nacre::diagnosis
