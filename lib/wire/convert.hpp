#pragma once
// LCM types <-> domain types. Everything that comes in is validated: enumerations, physical ranges, lengths, design
// names. Cores use two calls: write(domain) -> payload, read<Domain>(payload) -> Result<Domain>.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "crack/crack_record.hpp"
#include "explore/search.hpp"
#include "game/family_errors.hpp"
#include "material/parameters.hpp"
#include "pattern/design.hpp"
#include "sysid/errors.hpp"
#include "sysid/provenance.hpp"
#include "tester/loading.hpp"
#include "wire/codec.hpp"

namespace nacre::wire {

inline constexpr std::size_t kMaximumDesigns = 64;        ///< of a simulate request
inline constexpr std::size_t kMaximumCurvePoints = 1500;  ///< of a measured curve
inline constexpr std::size_t kMaximumBreaks = 4000;       ///< of a FRACTURE
inline constexpr std::size_t kGamutChunk = 1000;          ///< samples in one gamut_t

/// PARAMETERS: the adopted model of a round.
struct AdoptedModel {
  using Wire = parameters_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  material::ParameterSet parameters;
  sysid::PredictionErrors before, after;
  int simulations = 0;
  sysid::Provenance provenance;
  std::vector<optimize::Performance> benchmark;  ///< measured homogeneous line l1, by rigid fraction
  std::vector<pattern::Pattern> measured;        ///< patterns not worth proposing again, by increasing bits
  bool operator==(const AdoptedModel&) const = default;
};

/// SIMULATE: designs to simulate with one parameter set. `request_id` starts with the requester's node name and a '/',
/// and ends in the hash of its content (with_content_id()).
struct SimulateRequest {
  using Wire = simulate_request_t;
  std::string request_id;
  bool modulus = false;
  bool toughness = false;
  tester::Fidelity fidelity = tester::Fidelity::full;
  tester::TestConditions conditions;
  material::ParameterSet parameters;
  int curve_points = 0;
  bool crack = false;  ///< a FRACTURE per design is wanted; with toughness only
  bool film = false;   ///< and the film of it, in the run's folder; with toughness only
  std::vector<pattern::Design> designs;
  bool operator==(const SimulateRequest&) const = default;
};

/// The farm's result for one design.
struct SimulatedDesign {
  pattern::Design design;
  std::string failure;  ///< empty, or why there is no number
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;
  double peak_stress_pa = 0.0;
  double failure_strain = 0.0;
  tester::Curve curve;
  bool operator==(const SimulatedDesign&) const = default;
};

/// SIMULATED: part of the response to a request. simulate_response() cuts a whole response into messages,
/// ResponseCollector joins them.
struct SimulateResult {
  using Wire = simulate_result_t;
  std::string request_id;
  int chunk = 0;
  int chunks = 1;
  int first = 0;
  std::vector<SimulatedDesign> results;
  bool operator==(const SimulateResult&) const = default;
};

/// FRACTURE: how one design of a request broke.
struct Fracture {
  using Wire = fracture_t;
  std::string request_id;
  int design_index = 0;  ///< among the request's designs
  pattern::Design design;
  crack::CrackRecord crack;  ///< of its order, a message keeps the first kMaximumBreaks
  int broken = 0;            ///< elements that failed
  std::string film;          ///< file in RUN/films; empty when none was asked for, or none shows this fracture
  bool operator==(const Fracture&) const = default;
};

/// GAMUT: one chunk of a gamut.
struct GamutChunk {
  using Wire = gamut_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int chunk = 0;
  int chunks = 1;
  std::vector<explore::Evaluated> samples;
  bool operator==(const GamutChunk&) const = default;
};

struct ProposedDesign {
  pattern::Design design;
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;
  int bin = -1;
  std::string reason;
  bool operator==(const ProposedDesign&) const = default;
};

/// PROPOSAL: the designs selected from the gamut of a round.
struct Proposal {
  using Wire = proposal_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  double gamut_hypervolume_staircase = 0.0;  ///< GPa MPa
  double gamut_hypervolume_polygon = 0.0;
  int simulations = 0;
  std::vector<ProposedDesign> designs;
  bool operator==(const Proposal&) const = default;
};

/// TEST_ORDER: replicates of one design to print and test.
struct TestOrder {
  using Wire = test_order_t;
  int round = 0;
  std::string order_id;
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int replicates = 1;
  tester::TestConditions conditions;
  tester::Loading loading = {};
  std::string batch;
  std::string reason;
  bool operator==(const TestOrder&) const = default;
};

/// MEASUREMENT: one specimen.
struct Measurement {
  using Wire = measurement_t;
  int round = -1;        ///< of the order, -1 when nobody ordered it
  std::string order_id;  ///< empty when nobody ordered it
  tester::Fidelity fidelity = tester::Fidelity::full;
  measurement::SpecimenRecord record;
  bool operator==(const Measurement&) const = default;
};

/// DIAGNOSE: the measurements meant and the calibrated parameters.
struct DiagnoseRequest {
  using Wire = diagnose_request_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  material::ParameterSet parameters;
  std::vector<std::string> specimens;  ///< sorted
  bool operator==(const DiagnoseRequest&) const = default;
};

inline constexpr std::size_t kMostFamilyDesigns = 500;  ///< of a message below 60 kB

/// FAMILY: a family of the stage after the game (thesis 2.4.1).
struct CalibratedFamily {
  using Wire = family_t;
  int round = 0;  ///< that its designs are ordered in
  tester::Fidelity fidelity = tester::Fidelity::full;
  int number = 0;  ///< 0..count - 1
  int count = 1;
  std::string name;
  bool is_validated = false;                ///< the chosen designs are measured
  material::ParameterSet parameters;        ///< of the family's own model
  int simulations = 0;                      ///< spent on its calibration
  int samples = 0;                          ///< patterns simulated around the seeds
  std::vector<game::FamilyDesign> designs;  ///< seeds, then chosen ones; at most kMostFamilyDesigns
  bool operator==(const CalibratedFamily&) const = default;
};

/// FAMILY_GAMUT: one chunk of a family's variants.
struct FamilyGamut {
  using Wire = family_gamut_t;
  int number = 0;  ///< of the family
  tester::Fidelity fidelity = tester::Fidelity::full;
  int chunk = 0;
  int chunks = 1;
  std::vector<explore::Evaluated> samples;
  bool operator==(const FamilyGamut&) const = default;
};

/// ROUND: hypervolumes and gap in GPa MPa.
struct RoundSummary {
  using Wire = round_summary_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  int calibration_count = 0;
  double measured_hypervolume_staircase = 0.0, measured_hypervolume_polygon = 0.0;
  double gamut_hypervolume_staircase = 0.0, gamut_hypervolume_polygon = 0.0;
  double gap = 0.0, signed_gap = 0.0, hypervolume_error = 0.0;
  sysid::PredictionErrors before, after, held_out;
  bool equilibrium = false;
  bool last = false;
  std::string decided_by;
  bool operator==(const RoundSummary&) const = default;
};

// One pair per type; from_wire's error names the member.
parameter_set_t to_wire(const material::ParameterSet& parameters);
Result<material::ParameterSet> from_wire(const parameter_set_t& message);
prediction_error_t to_wire(const sysid::PredictionErrors& errors);
Result<sysid::PredictionErrors> from_wire(const prediction_error_t& message);
test_conditions_t to_wire(const tester::TestConditions& conditions);
Result<tester::TestConditions> from_wire(const test_conditions_t& message);
parameters_t to_wire(const AdoptedModel& model);
Result<AdoptedModel> from_wire(const parameters_t& message);
simulate_request_t to_wire(const SimulateRequest& request);
Result<SimulateRequest> from_wire(const simulate_request_t& message);
simulate_result_t to_wire(const SimulateResult& result);
fracture_t to_wire(const Fracture& fracture);
Result<Fracture> from_wire(const fracture_t& message);
Result<SimulateResult> from_wire(const simulate_result_t& message);
family_t to_wire(const CalibratedFamily& family);
Result<CalibratedFamily> from_wire(const family_t& message);
family_gamut_t to_wire(const FamilyGamut& gamut);
Result<FamilyGamut> from_wire(const family_gamut_t& message);
gamut_t to_wire(const GamutChunk& chunk);
Result<GamutChunk> from_wire(const gamut_t& message);
proposal_t to_wire(const Proposal& proposal);
Result<Proposal> from_wire(const proposal_t& message);
test_order_t to_wire(const TestOrder& order);
Result<TestOrder> from_wire(const test_order_t& message);
measurement_t to_wire(const Measurement& measurement);
Result<Measurement> from_wire(const measurement_t& message);
diagnose_request_t to_wire(const DiagnoseRequest& request);
Result<DiagnoseRequest> from_wire(const diagnose_request_t& message);
round_summary_t to_wire(const RoundSummary& summary);
Result<RoundSummary> from_wire(const round_summary_t& message);

std::int8_t to_wire(tester::Fidelity fidelity);
std::int8_t to_wire(tester::TestKind kind);
Result<tester::Fidelity> fidelity_from_wire(std::int8_t code);
Result<tester::TestKind> test_kind_from_wire(std::int8_t code);

/// Checks of the types that are used as they are (RUN, APPROVAL, REVIEW, ACK, STATUS, DIAGNOSIS).
Result<void> validate(const run_t& message);
Result<void> validate(const approval_t& message);
Result<void> validate(const review_t& message);
Result<void> validate(const ack_t& message);
Result<void> validate(const node_status_t& message);
Result<void> validate(const diagnosis_t& message);

/// Payload of a domain value.
template <class Domain>
std::string write(const Domain& value) {
  return encode(to_wire(value));
}

/// Domain value of a payload, validated; never throws.
template <class Domain>
Result<Domain> read(std::string_view payload) {
  const Result<typename Domain::Wire> message = decode_safe<typename Domain::Wire>(payload);
  if (!message) return tl::unexpected(message.error());
  return from_wire(*message);
}

/// The request under an id of its own: `analyser/r1/films` becomes `analyser/r1/films#0123456789abcdef`, the hash of
/// all that is requested. A restarted requester may come to request something else at the same place; the response to
/// its earlier request has an id that it does not know, and is never taken for the new one's.
SimulateRequest with_content_id(SimulateRequest request);

/// The response to a request as messages below kMaximumPayload. `results` stand in the order of the request's designs.
std::vector<SimulateResult> simulate_response(const std::string& request_id,
                                              const std::vector<SimulatedDesign>& results);

/// Cuts a gamut into chunks of at most kGamutChunk samples; an empty gamut is one empty chunk.
std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity, std::span<const explore::Evaluated> samples);

/// Cuts the variants of a family into chunks as gamut_chunks() does.
std::vector<FamilyGamut> family_gamut_chunks(int number, tester::Fidelity fidelity,
                                             std::span<const explore::Evaluated> samples);

/// Joins the chunks of responses, in any order and any number of times.
class ResponseCollector {
 public:
  /// The whole response when this chunk completes it (once), nothing otherwise.
  std::optional<std::vector<SimulatedDesign>> add(SimulateResult part);

 private:
  std::map<std::string, std::map<int, SimulateResult>> parts_;
};

/// Joins the chunks of gamuts, in any order and any number of times.
class GamutCollector {
 public:
  /// The whole gamut of the chunk's round when this chunk completes it (once), nothing otherwise.
  std::optional<std::vector<explore::Evaluated>> add(GamutChunk part);

 private:
  std::map<int, std::map<int, GamutChunk>> parts_;
};

}  // namespace nacre::wire
