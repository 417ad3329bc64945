#pragma once
// Messages of the simulator farm: requests, results and fractures.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crack/crack_record.hpp"
#include "nacre/fracture_t.hpp"
#include "nacre/simulate_request_t.hpp"
#include "nacre/simulate_result_t.hpp"
#include "pattern/design.hpp"
#include "wire/parts.hpp"

namespace nacre::wire {

inline constexpr std::size_t kMaximumDesigns = 64;   ///< of a simulate request
inline constexpr int kMaximumSpecimens = 1000;       ///< of a design of a simulate request
inline constexpr std::size_t kMaximumBreaks = 4000;  ///< of a FRACTURE

/// An id that begins with its requester: a node's name and '/'.
inline constexpr auto kRequestId = [](std::string_view id) {
  if (id.find('/') == std::string_view::npos || id.starts_with('/'))
    return fmt::format("\"{}\" does not begin with a node's name and '/'", id);
  return kName(id);
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
  int first_specimen = 0;  ///< T is the mean over `specimens` from this one on; curve, crack and film are of this one
  int specimens = 1;
  int curve_points = 0;
  bool crack = false;  ///< a FRACTURE per design is wanted; with toughness only
  bool film = false;   ///< and the film of it, in the run's folder; with toughness only
  std::vector<pattern::Design> designs;
  bool operator==(const SimulateRequest&) const = default;

  static void fields(auto& field, auto& m) {
    field("request_id", m.request_id, kRequestId);
    field.bits("tests", m.modulus, m.toughness, m.crack, m.film);
    field("fidelity", m.fidelity);
    field("conditions", m.conditions);
    field("parameters", m.parameters);
    field("first_specimen", m.first_specimen, kCounted);
    field("specimens", m.specimens, Range{1, kMaximumSpecimens});
    field("curve_points", m.curve_points, Range{0, kMaximumCurvePoints});
    field.count("n_designs", m.designs, Range{1, kMaximumDesigns});
    field("designs", m.designs);
  }
  std::string contradiction() const;
};

/// The farm's result for one design.
struct SimulatedDesign {
  pattern::Design design;
  std::string failure;  ///< empty, or why there is no number
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;     ///< mean over specimens
  double toughness_sd_pa = 0.0;  ///< scatter between specimens, over n - 1; 0 with one
  int specimens = 0;             ///< 0 where no fracture test was requested
  double peak_stress_pa = 0.0;   ///< mean over specimens
  double failure_strain = 0.0;   ///< mean over specimens
  tester::Curve curve;           ///< of the first specimen
  bool operator==(const SimulatedDesign&) const = default;

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field.failure("ok", "reason", m.failure);
    field("modulus_pa", m.modulus_pa, kPressurePa);
    field("toughness_pa", m.toughness_pa, kPressurePa);
    field("toughness_sd_pa", m.toughness_sd_pa, kPressurePa);
    field("specimens", m.specimens, Range{0, kMaximumSpecimens});
    field("peak_stress_pa", m.peak_stress_pa, kPressurePa);
    field("failure_strain", m.failure_strain, kStrain);
    field.count("n_points", m.curve.strain, Range{0, kMaximumCurvePoints});
    field.single("strain", m.curve.strain);  // half the bytes, and far more digits than a tester resolves
    field.single("stress_pa", m.curve.stress_pa);
  }
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

  static void fields(auto& field, auto& m) {
    field("request_id", m.request_id, kRequestId);
    field("chunk", m.chunk);
    field("chunks", m.chunks, Range{1, kMaximumDesigns});
    field("first", m.first, Range{0, kMaximumDesigns - 1});
    field.count("n_results", m.results, Range{1, kMaximumDesigns});
    field("results", m.results);
  }
  std::string contradiction() const;
};

/// Whoever opens a film looks in RUN/films and nowhere else; empty: there is none.
std::string film_fault(std::string_view name);

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

  static void fields(auto& field, auto& m) {
    constexpr Range kSide{1, 4096};
    field("request_id", m.request_id, kRequestId);
    field("design_index", m.design_index, Range{0, kMaximumDesigns - 1});
    field("design", m.design);
    field("film", m.film, film_fault);
    field("columns", m.crack.columns, kSide);
    field("rows", m.crack.rows, kSide);
    field("branches", m.crack.branches, kCounted);
    field("separate_cracks", m.crack.separate_cracks, kCounted);
    field.part("has_path", "path", m.crack.path);
    field("broken", m.broken, kCounted);
    field.first("n_order", m.crack.order, Range{0, kMaximumBreaks});
    field.columns(m.crack.order, [](auto& column, auto& broken) {
      column("element", broken.element);
      column.single("strain", broken.strain, kStrain);
    });
  }
  std::string contradiction() const;
};

/// The request under an id of its own: `analyser/r1/films` becomes `analyser/r1/films#0123456789abcdef`, the hash of
/// all that is requested. A restarted requester may come to request something else at the same place; the response to
/// its earlier request has an id that it does not know, and is never taken for the new one's.
SimulateRequest with_content_id(SimulateRequest request);

/// The response to a request as messages below kMaximumPayload. `results` stand in the order of the request's designs.
std::vector<SimulateResult> simulate_response(const std::string& request_id,
                                              const std::vector<SimulatedDesign>& results);

/// Joins the chunks of responses, in any order and any number of times.
class ResponseCollector {
 public:
  /// The whole response when this chunk completes it (once), nothing otherwise.
  std::optional<std::vector<SimulatedDesign>> add(SimulateResult part);

 private:
  std::map<std::string, std::map<int, SimulateResult>> parts_;
};

}  // namespace nacre::wire
