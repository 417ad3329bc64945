#pragma once
// Sets the counts of variable arrays from the arrays themselves: lcm-gen's encode() reads out of bounds when they
// differ.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "nacre/ack_t.hpp"
#include "nacre/approval_t.hpp"
#include "nacre/diagnose_request_t.hpp"
#include "nacre/diagnosis_t.hpp"
#include "nacre/family_gamut_t.hpp"
#include "nacre/family_t.hpp"
#include "nacre/fracture_t.hpp"
#include "nacre/gamut_t.hpp"
#include "nacre/measurement_t.hpp"
#include "nacre/node_status_t.hpp"
#include "nacre/parameters_t.hpp"
#include "nacre/proposal_t.hpp"
#include "nacre/review_t.hpp"
#include "nacre/round_summary_t.hpp"
#include "nacre/run_t.hpp"
#include "nacre/simulate_request_t.hpp"
#include "nacre/simulate_result_t.hpp"
#include "nacre/test_order_t.hpp"

namespace nacre::wire {

/// Length of arrays that share one count; throws std::logic_error when they differ.
template <class First, class... Rest>
std::int32_t common_length(const char* what, const First& first, const Rest&... rest) {
  if (((rest.size() != first.size()) || ...))
    throw std::logic_error(std::string(what) + ": arrays of different length");
  return static_cast<std::int32_t>(first.size());
}

inline void set_counts(parameter_set_t& m) {
  for (extension_t& e : m.extensions) e.n_values = common_length("extension_t", e.values);
  m.n_extensions = common_length("parameter_set_t", m.extensions);
}
inline void set_counts(simulated_t& m) { m.n_points = common_length("simulated_t", m.strain, m.stress_pa); }
inline void set_counts(ack_t& m) { m.n_hashes = common_length("ack_t", m.hashes); }
inline void set_counts(approval_t&) {}
inline void set_counts(diagnose_request_t& m) {
  set_counts(m.parameters);
  m.n_specimens = common_length("diagnose_request_t", m.specimens);
}
inline void set_counts(diagnosis_t& m) {
  m.n_effects = common_length("diagnosis_t", m.effects);
  m.n_candidates = common_length("diagnosis_t", m.candidates);
  m.n_next_experiments = common_length("diagnosis_t", m.next_experiments);
}
inline void set_counts(family_gamut_t& m) {
  m.n = common_length("family_gamut_t", m.pattern, m.modulus_pa, m.toughness_pa);
}
inline void set_counts(family_t& m) {
  set_counts(m.parameters);
  m.n_designs = common_length("family_t", m.designs);
}
inline void set_counts(fracture_t& m) {
  m.n_path = common_length("fracture_t path", m.path);
  m.n_order = common_length("fracture_t order", m.element, m.strain);
}
inline void set_counts(gamut_t& m) { m.n = common_length("gamut_t", m.pattern, m.modulus_pa, m.toughness_pa); }
inline void set_counts(measurement_t& m) { m.n_points = common_length("measurement_t", m.strain, m.stress_pa); }
inline void set_counts(node_status_t&) {}
inline void set_counts(parameters_t& m) {
  set_counts(m.parameters);
  m.n_estimates = common_length("parameters_t estimates", m.estimates);
  m.n_benchmark = common_length("parameters_t benchmark", m.benchmark_modulus_pa, m.benchmark_toughness_pa);
  m.n_measured = common_length("parameters_t measured", m.measured_pattern);
}
inline void set_counts(proposal_t& m) { m.n_designs = common_length("proposal_t", m.designs); }
inline void set_counts(review_t&) {}
inline void set_counts(round_summary_t&) {}
inline void set_counts(run_t&) {}
inline void set_counts(simulate_request_t& m) {
  set_counts(m.parameters);
  m.n_designs = common_length("simulate_request_t", m.designs);
}
inline void set_counts(simulate_result_t& m) {
  for (simulated_t& result : m.results) set_counts(result);
  m.n_results = common_length("simulate_result_t", m.results);
}
inline void set_counts(test_order_t&) {}

}  // namespace nacre::wire
