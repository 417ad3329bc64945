#include "wire/convert.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "wire/channels.hpp"
#include "wire/checks.hpp"

namespace nacre::wire {
namespace {

/// Curves travel as float: half the bytes, and far more digits than a tester resolves.
std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }
std::vector<double> to_doubles(const std::vector<float>& values) { return {values.begin(), values.end()}; }

simulated_t to_wire(const SimulatedDesign& result) {
  simulated_t message{};
  message.design = result.design.name();
  message.ok = result.failure.empty();
  message.reason = result.failure.substr(0, kMaximumText);
  message.modulus_pa = result.modulus_pa;
  message.toughness_pa = result.toughness_pa;
  message.peak_stress_pa = result.peak_stress_pa;
  message.failure_strain = result.failure_strain;
  message.strain = to_floats(result.curve.strain);
  message.stress_pa = to_floats(result.curve.stress_pa);
  message.n_points = static_cast<std::int32_t>(result.curve.size());
  return message;
}

Result<SimulatedDesign> from_wire(const simulated_t& message) {
  const Result<pattern::Design> design = pattern::design_from_name(message.design);
  if (!design) return tl::unexpected(design.error());
  if ((message.ok != 0) != message.reason.empty()) return fail("ok and reason contradict each other");
  const Result<void> sound =
      all_of(expect_pressure("modulus_pa", message.modulus_pa), expect_pressure("toughness_pa", message.toughness_pa),
             expect_pressure("peak_stress_pa", message.peak_stress_pa),
             expect_range("failure_strain", message.failure_strain, 0.0, kLargestStrain),
             expect_count("strain", message.strain.size(), kMaximumCurvePoints));
  if (!sound) return tl::unexpected(sound.error());
  return SimulatedDesign{.design = *design,
                         .failure = message.reason,
                         .modulus_pa = message.modulus_pa,
                         .toughness_pa = message.toughness_pa,
                         .peak_stress_pa = message.peak_stress_pa,
                         .failure_strain = message.failure_strain,
                         .curve = {to_doubles(message.strain), to_doubles(message.stress_pa)}};
}

}  // namespace

std::int8_t to_wire(tester::Fidelity fidelity) { return static_cast<std::int8_t>(fidelity); }
std::int8_t to_wire(tester::TestKind kind) { return static_cast<std::int8_t>(kind); }

Result<tester::Fidelity> fidelity_from_wire(std::int8_t code) {
  if (code < 0 || code > static_cast<std::int8_t>(tester::Fidelity::full))
    return fail("fidelity: there is no {}", code);
  return static_cast<tester::Fidelity>(code);
}

Result<tester::TestKind> test_kind_from_wire(std::int8_t code) {
  if (code < 0 || code > static_cast<std::int8_t>(tester::TestKind::tensile)) return fail("test: there is no {}", code);
  return static_cast<tester::TestKind>(code);
}

parameter_set_t to_wire(const material::ParameterSet& parameters) {
  parameter_set_t message{};
  std::ranges::copy(material::to_vector(parameters.modulus), message.modulus);
  std::ranges::copy(material::to_vector(parameters.toughness), message.toughness);
  for (const auto& [name, values] : parameters.extensions) {
    message.extensions.push_back({name, static_cast<std::int32_t>(values.size()), values});
  }
  message.n_extensions = static_cast<std::int32_t>(message.extensions.size());
  return message;
}

Result<material::ParameterSet> from_wire(const parameter_set_t& message) {
  material::ModulusVector modulus;
  material::ToughnessVector toughness;
  std::copy_n(message.modulus, modulus.size(), modulus.begin());
  std::copy_n(message.toughness, toughness.size(), toughness.begin());
  material::ParameterSet parameters{
      material::modulus_from_vector(modulus), material::toughness_from_vector(toughness), {}};
  for (const extension_t& extension : message.extensions) {
    if (!parameters.extensions.emplace(extension.name, extension.values).second) {
      return fail("parameters: extension {} twice", extension.name);
    }
  }
  if (const std::string fault = material::parameter_fault(parameters); !fault.empty())
    return fail("parameters: {}", fault);
  return parameters;
}

test_conditions_t to_wire(const tester::TestConditions& conditions) {
  return {conditions.orientation_deg, conditions.strain_rate_per_s, conditions.thickness_mm};
}

Result<tester::TestConditions> from_wire(const test_conditions_t& message) {
  if (message.orientation_deg != 0.0 && message.orientation_deg != 90.0) {
    return fail("conditions: orientation {} degrees, expected 0 or 90", message.orientation_deg);
  }
  const Result<void> sound =
      all_of(expect_range("strain_rate_per_s", message.strain_rate_per_s, measurement::kStrainRatePerS),
             expect_range("thickness_mm", message.thickness_mm, measurement::kThicknessMm));
  if (!sound) return in_type("conditions", sound.error());
  return tester::TestConditions{message.orientation_deg, message.strain_rate_per_s, message.thickness_mm};
}

simulate_request_t to_wire(const SimulateRequest& request) {
  simulate_request_t message{};
  message.request_id = request.request_id;
  message.tests = static_cast<std::int8_t>((request.modulus ? 1 : 0) | (request.toughness ? 2 : 0) |
                                           (request.crack ? 4 : 0) | (request.film ? 8 : 0));
  message.fidelity = to_wire(request.fidelity);
  message.conditions = to_wire(request.conditions);
  message.parameters = to_wire(request.parameters);
  message.curve_points = request.curve_points;
  for (const pattern::Design& design : request.designs) message.designs.push_back(design.name());
  return message;
}

Result<SimulateRequest> from_wire(const simulate_request_t& message) {
  constexpr std::string_view type = "simulate_request_t";
  SimulateRequest request;
  request.request_id = message.request_id;
  if (requester_of(message.request_id).empty()) {
    return fail("{}: request_id \"{}\" does not begin with a node's name and '/'", type, message.request_id);
  }
  if (message.tests < 1 || message.tests > 15 || (message.tests & 3) == 0 || (message.tests & 14) == 4 ||
      (message.tests & 10) == 8)
    return fail("{}: tests {}, expected 1, 2 or 3, and with 2 also 4 and 8", type, message.tests);
  request.modulus = (message.tests & 1) != 0;
  request.toughness = (message.tests & 2) != 0;
  request.crack = (message.tests & 4) != 0;
  request.film = (message.tests & 8) != 0;
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  request.fidelity = *fidelity;
  const Result<tester::TestConditions> conditions = from_wire(message.conditions);
  if (!conditions) return in_type(type, conditions.error());
  request.conditions = *conditions;
  const Result<material::ParameterSet> parameters = from_wire(message.parameters);
  if (!parameters) return in_type(type, parameters.error());
  request.parameters = *parameters;
  const Result<void> sound =
      all_of(expect_name("request_id", message.request_id),
             expect_range("curve_points", message.curve_points, 0, static_cast<double>(kMaximumCurvePoints)),
             expect_range("n_designs", message.n_designs, 1, static_cast<double>(kMaximumDesigns)));
  if (!sound) return in_type(type, sound.error());
  request.curve_points = message.curve_points;
  for (const std::string& name : message.designs) {
    const Result<pattern::Design> design = pattern::design_from_name(name);
    if (!design) return in_type(type, design.error());
    request.designs.push_back(*design);
  }
  return request;
}

simulate_result_t to_wire(const SimulateResult& result) {
  simulate_result_t message{};
  message.request_id = result.request_id;
  message.chunk = result.chunk;
  message.chunks = result.chunks;
  message.first = result.first;
  for (const SimulatedDesign& design : result.results) message.results.push_back(to_wire(design));
  message.n_results = static_cast<std::int32_t>(message.results.size());
  return message;
}

Result<SimulateResult> from_wire(const simulate_result_t& message) {
  constexpr std::string_view type = "simulate_result_t";
  if (requester_of(message.request_id).empty()) {
    return fail("{}: request_id \"{}\" does not begin with a node's name and '/'", type, message.request_id);
  }
  const Result<void> sound =
      all_of(expect_name("request_id", message.request_id), expect_range("chunks", message.chunks, 1, kMaximumDesigns),
             expect_index("chunk", message.chunk, message.chunks),
             expect_range("first", message.first, 0, kMaximumDesigns - 1.0),
             expect_range("n_results", message.n_results, 1, static_cast<double>(kMaximumDesigns) - message.first));
  if (!sound) return in_type(type, sound.error());
  SimulateResult result{message.request_id, message.chunk, message.chunks, message.first, {}};
  for (const simulated_t& simulated : message.results) {
    Result<SimulatedDesign> design = from_wire(simulated);
    if (!design) return in_type(type, design.error());
    result.results.push_back(std::move(*design));
  }
  return result;
}

SimulateRequest with_content_id(SimulateRequest request) {
  const std::string place = std::exchange(request.request_id, {});
  request.request_id = fmt::format("{}#{:016x}", place, content_hash64(write(request)));
  return request;
}

std::vector<SimulateResult> simulate_response(const std::string& request_id,
                                              const std::vector<SimulatedDesign>& results) {
  constexpr std::size_t kRoom = kMaximumBlankPayload - 500;  // the message's own members
  std::vector<SimulateResult> response;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const simulated_t message = to_wire(results[i]);
    const std::size_t size = static_cast<std::size_t>(message.getEncodedSize());
    if (response.empty() || filled + size > kRoom) {
      response.push_back({request_id, static_cast<int>(response.size()), 1, static_cast<int>(i), {}});
      filled = 0;
    }
    filled += size;
    response.back().results.push_back(results[i]);
  }
  for (SimulateResult& part : response) part.chunks = static_cast<int>(response.size());
  return response;
}

std::optional<std::vector<SimulatedDesign>> ResponseCollector::add(SimulateResult part) {
  const std::string request_id = part.request_id;
  const int chunks = part.chunks;
  auto& parts = parts_[request_id];
  parts.insert_or_assign(part.chunk, std::move(part));
  if (static_cast<int>(parts.size()) < chunks) return std::nullopt;
  std::vector<SimulatedDesign> whole;
  for (auto& [chunk, piece] : parts) std::ranges::move(piece.results, std::back_inserter(whole));
  parts_.erase(request_id);
  return whole;
}

}  // namespace nacre::wire
