#pragma once
// One sound message per channel, with every array filled.

#include <string>
#include <utility>
#include <vector>

#include "wire/convert.hpp"

namespace nacre::wire::samples {

inline material::ParameterSet parameters() {
  material::ParameterSet set = material::default_parameters();
  set.extensions["machine_compliance"] = {1e-9};
  return set;
}

inline tester::Curve curve() { return {{0.0, 0.01, 0.02, 0.03, 0.04}, {0.0, 2e6, 1e6, 1e6, 0.0}}; }

inline SimulateRequest request() {
  SimulateRequest request;
  request.request_id = "proposal_agent/0/17";
  request.modulus = request.toughness = true;
  request.fidelity = tester::Fidelity::preview;
  request.conditions = {90.0, 1e-3, 3.2};
  request.parameters = material::default_parameters();
  request.parameters.criterion = {.kind = material::CriterionKind::neighbourhood, .radius_m = 5e-4};
  request.parameters.strength_cv = 0.1;
  request.first_specimen = 3;
  request.specimens = 8;
  request.curve_points = 100;
  request.designs = {pattern::Pattern(0x577fffe9fffdef), pattern::Mixture{0.65}, pattern::Mixture{0.0}};
  return request;
}

inline SimulateResult result() {
  SimulateResult result{"proposal_agent/0/17", 0, 2, 0, {}};
  result.results.push_back(
      {pattern::Pattern(0x3ffc9b4ad4d2d9), "", 1.5e9, 2e6, 3e5, 8, 3e7, 0.25, {{0.0, 0.5}, {0.0, 1024.0}}});
  result.results.push_back({pattern::Mixture{1.0}, "J <= 0 at element 7", 0.0, 0.0, 0.0, 0, 0.0, 0.0, {}});
  return result;
}

inline Fracture fracture() {
  Fracture fracture;
  fracture.request_id = "analyser/r1/films";
  fracture.design_index = 2;
  fracture.design = pattern::Pattern(0x3ffc9b4ad4d2d9);
  fracture.crack = {.columns = 4,
                    .rows = 2,
                    .order = {{5, 0.25}, {6, 0.5}, {7, 0.5}},
                    .path = crack::CrackPath{.elements = {5, 6, 7},
                                             .length_m = 3e-3,
                                             .straight_length_m = 2e-3,
                                             .bridged_share = 0.0,
                                             .material = {0.25, 0.5, 0.25},
                                             .crosses = true},
                    .branches = 1,
                    .separate_cracks = 2};
  fracture.broken = 3;
  fracture.film = "0123456789abcdef0123456789abcdef.film";
  return fracture;
}

inline Measurement measurement() {
  Measurement m;
  m.round = 1;
  m.order_id = "1/rigid/modulus";
  m.record.specimen = "S-001";
  m.record.design = pattern::Mixture{0.65};
  m.record.test = tester::TestKind::toughness;
  m.record.batch = "B1";
  m.record.print_order = 3;
  m.record.toughness_pa = 1.1e6;
  m.record.curve = curve();
  m.record.note = "slipped a little";
  return m;
}

inline AdoptedModel model() {
  AdoptedModel model;
  model.round = 2;
  model.parameters = material::default_parameters();
  model.before = {4, 0.1, 0.3, 5, 0.2, 0.5, 0.7};
  model.simulations = 77;
  model.benchmark = {{1e8, 2e6}, {1e9, 1e6}};
  model.measured = {pattern::Pattern(5), pattern::Pattern(9)};
  model.provenance.search = "posterior";
  model.provenance.modulus_objective = 0.02;
  model.provenance.toughness_objective = 0.4;
  model.provenance.modulus_fit = {
      .count = 18, .freedom = 14, .chi_squared = 15.5, .chi_squared_replicates = 30.0, .p_value = 0.35};
  model.provenance.estimates = {{"modulus.e_vw_pa", 2.6e9, 2.5e9, 2.7e9, true},
                                {"toughness.nu_tb", 0.45, 0.4, 0.5, false}};
  return model;
}

inline GamutChunk gamut() {
  return {
      1, -1, 2, tester::Fidelity::tiny, 0, 1, {{pattern::Pattern(7), {1e9, 2e6}}, {pattern::Pattern(8), {2e9, 1e6}}}};
}

inline FamilyGamut family_gamut() {
  return {2, tester::Fidelity::preview, 0, 1, {{pattern::Pattern(0x577fffe9fffdef), {1.5e9, 4e5}}}};
}

inline CalibratedFamily family() {
  CalibratedFamily family;
  family.round = 4;
  family.fidelity = tester::Fidelity::preview;
  family.number = 1;
  family.count = 3;
  family.name = "family-2";
  family.is_validated = true;
  family.parameters = parameters();
  family.simulations = 170;
  family.samples = 300;
  family.designs = {{pattern::Pattern(0x577fffe9fffdef), true, {1.5e9, 4e5}, {1.6e9, 3e5}, {1.5e9, 4.1e5}},
                    {pattern::Pattern(0x3ffc9b4ad4d2d9), false, {1.4e9, {}}, {1.3e9, 3e5}, {1.2e9, {}}}};
  return family;
}

inline Proposal proposal() {
  Proposal proposal;
  proposal.round = 1;
  proposal.designs = {{pattern::Pattern(0x577fffe9fffdef), 1e9, 2e6, 1e5, 8, 3, "radial bin 3"}};
  return proposal;
}

inline TestOrder order() {
  TestOrder order;
  order.order_id = "1/mix:0.65/toughness";
  order.design = pattern::Mixture{0.65};
  order.test = tester::TestKind::toughness;
  order.replicates = 3;
  order.batch = "round-1";
  order.reason = "mixture";
  return order;
}

inline RoundSummary round() {
  RoundSummary summary;
  summary.round = 1;
  summary.gap = 0.25;
  summary.signed_gap = -0.125;
  summary.held_out = {3, 0.1, 0.2, 3, 0.2, 0.4, 0.5};
  summary.decided_by = "gap above the bootstrap error";
  return summary;
}

inline Diagnosis diagnosis() {
  Diagnosis m;
  m.round = 1;
  m.verdict = "named";
  m.summary = "the machine gives way";
  m.effects.push_back({"machine_compliance", "machine", 1e-9, 0.0, 2e-9, "m/N"});
  m.candidates.push_back({"droplet_mixing", "excluded", 0.1, 0.9, 0.2});
  m.gain = DiagnosedGain{0.2, 0.1, 0.5, 0.3, 0.6};
  m.next_experiments.push_back({pattern::Mixture{0.65}, tester::TestKind::modulus, {}, 2, {}, "thick against thin"});
  return m;
}

inline RunStart run() { return {1, "0123456789abcdef0123456789abcdef", 1}; }
inline DiagnoseRequest diagnose() {
  return {1,
          tester::Fidelity::full,
          material::default_parameters(),
          {{material::default_parameters(), 1003}},
          {{"a", 0}, {"b", 2}}};
}
inline Approval approval() { return {1, pattern::Pattern(0x577fffe9fffdef), true, "someone", "a reason"}; }
inline Withdrawal withdrawal() { return {"r1/mix:0.65/toughness", 2, true, "someone", "cannot be printed"}; }
inline Review review() { return {"S-001", 2, false, "someone", "broke at the grip"}; }
inline Reveal reveal() {
  return {
      material::default_parameters(), 0.015, 0.08, {{"corner_debonding", "strength lost at corners", false, {0.88}}}};
}
inline Ack ack() {
  const std::string hash = "0123456789abcdef0123456789abcdef";
  return {7, {hash, std::string(32, 'f')}, {{hash, "specimen S-001 is refused"}}};
}
inline Ask ask() { return {"TEST_ORDER"}; }
inline NodeStatus status() {
  NodeStatus status;
  status.phase = "search";
  status.progress = 0.5;
  return status;
}

/// (channel, payload) of every row of the table.
inline std::vector<std::pair<std::string, std::string>> payloads() {
  return {{"RUN", write(run())},
          {"PARAMETERS", write(model())},
          {"SIMULATE", write(request())},
          {"SIMULATED", write(result())},
          {"FRACTURE", write(fracture())},
          {"GAMUT", write(gamut())},
          {"PROPOSAL", write(proposal())},
          {"APPROVAL", write(approval())},
          {"TEST_ORDER", write(order())},
          {"MEASUREMENT", write(measurement())},
          {"REVIEW", write(review())},
          {"DIAGNOSE", write(diagnose())},
          {"DIAGNOSIS", write(diagnosis())},
          {"ROUND", write(round())},
          {"FAMILY", write(family())},
          {"FAMILY_GAMUT", write(family_gamut())},
          {"ACK", write(ack())},
          {"STATUS", write(status())},
          {"REVEAL", write(reveal())},
          {"ASK", write(ask())},
          {"WITHDRAWAL", write(withdrawal())}};
}

}  // namespace nacre::wire::samples
