#pragma once
// Messages of the game: models, gamuts, proposals, orders, measurements, rounds and families.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "game/family_errors.hpp"
#include "measurement/specimen_record.hpp"
#include "nacre/family_gamut_t.hpp"
#include "nacre/family_t.hpp"
#include "nacre/gamut_t.hpp"
#include "nacre/measurement_t.hpp"
#include "nacre/parameters_t.hpp"
#include "nacre/proposal_t.hpp"
#include "nacre/round_summary_t.hpp"
#include "nacre/test_order_t.hpp"
#include "sysid/errors.hpp"
#include "sysid/provenance.hpp"
#include "tester/loading.hpp"
#include "wire/parts.hpp"

namespace nacre::wire {

inline constexpr std::size_t kGamutChunk = 1000;  ///< samples in one gamut_t
inline constexpr Range kChunks{1.0, 1'000'000.0};
inline constexpr Range kReplicates{1.0, 1000.0};

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

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("fidelity", m.fidelity);
    field("parameters", m.parameters);
    field("before", m.before);
    field("after", m.after);
    field("simulations", m.simulations, kCounted);
    field("search", m.provenance.search);
    field("modulus_objective", m.provenance.modulus_objective, kSquaredResiduals);
    field("toughness_objective", m.provenance.toughness_objective, kSquaredResiduals);
    field("modulus_fit", m.provenance.modulus_fit);
    field("toughness_fit", m.provenance.toughness_fit);
    field.count("n_estimates", m.provenance.estimates, Range{0, 64});
    field("estimates", m.provenance.estimates);
    field.count("n_benchmark", m.benchmark);
    field.columns(m.benchmark, [](auto& column, auto& point) {
      column("benchmark_modulus_pa", point.modulus_pa, kPressurePa);
      column("benchmark_toughness_pa", point.toughness_pa, kPressurePa);
    });
    field.count("n_measured", m.measured);
    field("measured_pattern", m.measured);
  }
};

/// What chunks of samples have in common.
void chunk_fields(auto& field, auto& m) {
  field("fidelity", m.fidelity);
  field("chunk", m.chunk);
  field("chunks", m.chunks, kChunks);
  field.count("n", m.samples, Range{0, kGamutChunk});
  field.columns(m.samples, kSampleColumns);
}

/// GAMUT: one chunk of a gamut, or of what it has more than that of an earlier round and otherwise.
struct GamutChunk {
  using Wire = gamut_t;
  int round = 0;
  int base = -1;  ///< round whose gamut this one adds to, explore::with_changes(); -1: none
  int total = 0;  ///< samples of the whole gamut
  tester::Fidelity fidelity = tester::Fidelity::full;
  int chunk = 0;
  int chunks = 1;
  std::vector<explore::Evaluated> samples;
  bool operator==(const GamutChunk&) const = default;

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("base", m.base, Range{-1, kRoundNumber.most});
    field("total", m.total, kCounted);
    chunk_fields(field, m);
  }
  std::string contradiction() const;
};

struct ProposedDesign {
  pattern::Design design;
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;     ///< mean over specimens that did not choose it
  double toughness_sd_pa = 0.0;  ///< between them, over n - 1; 0 where T is that of the selection
  int specimens = 0;             ///< 0 where T is that of the selection
  int bin = -1;
  std::string reason;
  bool operator==(const ProposedDesign&) const = default;

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("modulus_pa", m.modulus_pa, kPressurePa);
    field("toughness_pa", m.toughness_pa, kPressurePa);
    field("toughness_sd_pa", m.toughness_sd_pa, kPressurePa);
    field("specimens", m.specimens, kCounted);
    field("bin", m.bin, Range{-1, 10'000});
    field("reason", m.reason);
  }
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

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("fidelity", m.fidelity);
    field("gamut_hypervolume_staircase", m.gamut_hypervolume_staircase, kArea);
    field("gamut_hypervolume_polygon", m.gamut_hypervolume_polygon, kArea);
    field("simulations", m.simulations, kCounted);
    field.count("n_designs", m.designs, Range{0, 1000});
    field("designs", m.designs);
  }
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

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("order_id", m.order_id, kName);
    field("design", m.design);
    field("test", m.test);
    field("fidelity", m.fidelity);
    field("replicates", m.replicates, kReplicates);
    field("conditions", m.conditions);
    field("loading", m.loading);
    field("batch", m.batch);
    field("reason", m.reason);
  }
};

/// Strains of a measured curve.
std::string strain_fault(double strain);

/// MEASUREMENT: one specimen, or its amendment; of a name the highest revision counts.
struct Measurement {
  using Wire = measurement_t;
  int round = -1;                 ///< of the order, -1 when nobody ordered it
  std::string order_id;           ///< empty when nobody ordered it
  int revision = 0;               ///< 0: the first report
  std::string by = {}, why = {};  ///< of an amendment
  tester::Fidelity fidelity = tester::Fidelity::full;
  measurement::SpecimenRecord record;
  bool operator==(const Measurement&) const = default;

  static void fields(auto& field, auto& m) {
    constexpr Range kStressPa{measurement::kStressPa.least, measurement::kStressPa.most};
    field("round", m.round, Range{-1, kRoundNumber.most});
    field("order_id", m.order_id);
    field("specimen", m.record.specimen, kName);
    field("revision", m.revision, kCounted);
    field("by", m.by);
    field("why", m.why);
    field("design", m.record.design);
    field("test", m.record.test);
    field("fidelity", m.fidelity);
    field("conditions", m.record.conditions);
    field("batch", m.record.batch);
    field("print_order", m.record.print_order);
    field.maybe("has_modulus", "modulus_pa", m.record.modulus_pa, kPressurePa);
    field.maybe("has_toughness", "toughness_pa", m.record.toughness_pa, kPressurePa);
    field("valid", m.record.valid);
    field("note", m.record.note);
    field.count("n_points", m.record.curve.strain, Range{0, kMaximumCurvePoints});
    field("strain", m.record.curve.strain, strain_fault);
    field("stress_pa", m.record.curve.stress_pa, kStressPa);
  }
  /// A valid specimen carries a result, an amendment its author and reason.
  std::string contradiction() const;
};

/// The specimen as a message holds it: of a curve beyond kMaximumCurvePoints every n-th point, both ends kept, and T as
/// the area under the whole one.
measurement::SpecimenRecord fit_to_send(measurement::SpecimenRecord specimen);

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

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("fidelity", m.fidelity);
    field("n_calibration", m.calibration_count, kCounted);
    field("measured_hypervolume_staircase", m.measured_hypervolume_staircase, kArea);
    field("measured_hypervolume_polygon", m.measured_hypervolume_polygon, kArea);
    field("gamut_hypervolume_staircase", m.gamut_hypervolume_staircase, kArea);
    field("gamut_hypervolume_polygon", m.gamut_hypervolume_polygon, kArea);
    field("gap", m.gap, kArea);
    field("signed_gap", m.signed_gap, Range{-kArea.most, kArea.most});
    field("hypervolume_error", m.hypervolume_error, kArea);
    field("before", m.before);
    field("after", m.after);
    field("held_out", m.held_out);
    field("equilibrium", m.equilibrium);
    field("last", m.last);
    field("decided_by", m.decided_by);
  }
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

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("fidelity", m.fidelity);
    field("number", m.number);
    field("count", m.count, Range{1, 1000});
    field("name", m.name, kName);
    field("is_validated", m.is_validated);
    field("parameters", m.parameters);
    field("simulations", m.simulations, kCounted);
    field("samples", m.samples, kCounted);
    field.count("n_designs", m.designs, Range{0, kMostFamilyDesigns});
    field("designs", m.designs);
  }
  std::string contradiction() const { return index_fault("number", number, count); }
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

  static void fields(auto& field, auto& m) {
    field("number", m.number, kRoundNumber);
    chunk_fields(field, m);
  }
  std::string contradiction() const { return index_fault("chunk", chunk, chunks); }
};

/// Cuts a gamut into chunks of at most kGamutChunk samples; an empty gamut is one empty chunk.
std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity, std::span<const explore::Evaluated> samples);

/// The gamut as changes of that of an earlier round, where it is that with changes; else whole.
std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity, std::span<const explore::Evaluated> samples,
                                     int base, std::span<const explore::Evaluated> base_samples);

/// Cuts the variants of a family into chunks as gamut_chunks() does.
std::vector<FamilyGamut> family_gamut_chunks(int number, tester::Fidelity fidelity,
                                             std::span<const explore::Evaluated> samples);

/// Joins the chunks of gamuts and their bases, in any order and any number of times.
class GamutCollector {
 public:
  void add(GamutChunk part);
  /// The gamut of a round; nullptr until all of it and of its bases has come.
  const std::vector<explore::Evaluated>* whole(int round);
  /// Earlier rounds are not asked for any more. That of `round` stays: the next one may add to it.
  void forget_before(int round);

 private:
  std::map<int, std::map<int, GamutChunk>> parts_;  ///< by round and chunk, until it is whole
  std::map<int, std::vector<explore::Evaluated>> whole_;
};

}  // namespace nacre::wire
