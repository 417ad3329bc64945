// Part of the conversions (convert.hpp): PARAMETERS, the model that the validation agent adopted, and its provenance.

#include "wire/checks.hpp"
#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

constexpr double kLargestChiSquared = 1e30;
constexpr std::size_t kMostEstimates = 64;

goodness_of_fit_t to_wire(const sysid::GoodnessOfFit& fit) {
  return {fit.count, fit.freedom, fit.chi_squared, fit.chi_squared_replicates, fit.p_value};
}

Result<sysid::GoodnessOfFit> from_wire(const goodness_of_fit_t& message) {
  const Result<void> sound =
      all_of(expect_range("n_designs", message.n_designs, 0, kLargestCount),
             expect_range("freedom", message.freedom, 0, kLargestCount),
             expect_range("chi_squared", message.chi_squared, 0.0, kLargestChiSquared),
             expect_range("chi_squared_replicates", message.chi_squared_replicates, 0.0, kLargestChiSquared),
             expect_range("p_value", message.p_value, 0.0, 1.0));
  if (!sound) return tl::unexpected(sound.error());
  return sysid::GoodnessOfFit{.count = message.n_designs,
                              .freedom = message.freedom,
                              .chi_squared = message.chi_squared,
                              .chi_squared_replicates = message.chi_squared_replicates,
                              .p_value = message.p_value};
}

void write_provenance(const sysid::Provenance& provenance, parameters_t& message) {
  message.search = provenance.search;
  message.modulus_objective = provenance.modulus_objective;
  message.toughness_objective = provenance.toughness_objective;
  message.modulus_fit = to_wire(provenance.modulus_fit);
  message.toughness_fit = to_wire(provenance.toughness_fit);
  for (const sysid::ParameterEstimate& estimate : provenance.estimates) {
    parameter_estimate_t each{};
    each.name = estimate.name;
    each.value = estimate.value;
    each.low90 = estimate.low90;
    each.high90 = estimate.high90;
    each.determined = estimate.determined;
    message.estimates.push_back(each);
  }
}

Result<sysid::Provenance> read_provenance(const parameters_t& message) {
  sysid::Provenance provenance;
  provenance.search = message.search;
  provenance.modulus_objective = message.modulus_objective;
  provenance.toughness_objective = message.toughness_objective;
  const Result<void> sound =
      all_of(expect_range("modulus_objective", message.modulus_objective, 0.0, kLargestChiSquared),
             expect_range("toughness_objective", message.toughness_objective, 0.0, kLargestChiSquared),
             expect_range("n_estimates", message.n_estimates, 0, static_cast<int>(kMostEstimates)));
  if (!sound) return tl::unexpected(sound.error());
  const Result<sysid::GoodnessOfFit> modulus_fit = from_wire(message.modulus_fit),
                                     toughness_fit = from_wire(message.toughness_fit);
  if (!modulus_fit) return tl::unexpected(modulus_fit.error());
  if (!toughness_fit) return tl::unexpected(toughness_fit.error());
  provenance.modulus_fit = *modulus_fit;
  provenance.toughness_fit = *toughness_fit;
  for (const parameter_estimate_t& each : message.estimates) {
    const Result<void> physical = all_of(expect_range("value", each.value, 0.0, kLargestPressurePa),
                                         expect_range("low90", each.low90, 0.0, kLargestPressurePa),
                                         expect_range("high90", each.high90, each.low90, kLargestPressurePa));
    if (!physical) return tl::unexpected(physical.error());
    provenance.estimates.push_back({each.name, each.value, each.low90, each.high90, each.determined != 0});
  }
  return provenance;
}

}  // namespace

parameters_t to_wire(const AdoptedModel& model) {
  parameters_t message{};
  message.round = model.round;
  message.fidelity = to_wire(model.fidelity);
  message.parameters = to_wire(model.parameters);
  message.before = to_wire(model.before);
  message.after = to_wire(model.after);
  message.simulations = model.simulations;
  write_provenance(model.provenance, message);
  for (const optimize::Performance& point : model.benchmark) {
    message.benchmark_modulus_pa.push_back(point.modulus_pa);
    message.benchmark_toughness_pa.push_back(point.toughness_pa);
  }
  for (const pattern::Pattern& pattern : model.measured) {
    message.measured_pattern.push_back(static_cast<std::int64_t>(pattern.bits()));
  }
  return message;
}

Result<AdoptedModel> from_wire(const parameters_t& message) {
  constexpr std::string_view type = "parameters_t";
  AdoptedModel model;
  model.round = message.round;
  model.simulations = message.simulations;
  const Result<void> sound =
      all_of(expect_round(message.round), expect_range("simulations", message.simulations, 0, kLargestCount));
  if (!sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  model.fidelity = *fidelity;
  const Result<material::ParameterSet> parameters = from_wire(message.parameters);
  if (!parameters) return in_type(type, parameters.error());
  model.parameters = *parameters;
  const Result<sysid::PredictionErrors> before = from_wire(message.before), after = from_wire(message.after);
  if (!before) return in_type(type, before.error());
  if (!after) return in_type(type, after.error());
  model.before = *before;
  model.after = *after;
  const Result<sysid::Provenance> provenance = read_provenance(message);
  if (!provenance) return in_type(type, provenance.error());
  model.provenance = *provenance;
  for (std::size_t i = 0; i < message.benchmark_modulus_pa.size(); ++i) {
    const optimize::Performance point{message.benchmark_modulus_pa[i], message.benchmark_toughness_pa[i]};
    const Result<void> physical = all_of(expect_pressure("benchmark_modulus_pa", point.modulus_pa),
                                         expect_pressure("benchmark_toughness_pa", point.toughness_pa));
    if (!physical) return in_type(type, physical.error());
    model.benchmark.push_back(point);
  }
  for (const std::int64_t bits : message.measured_pattern) {
    const Result<pattern::Pattern> pattern = pattern_from_bits(bits);
    if (!pattern) return in_type(type, pattern.error());
    model.measured.push_back(*pattern);
  }
  return model;
}

}  // namespace nacre::wire
