// Part of the conversions (convert.hpp): the messages of the game, which are gamuts, proposals, orders, measurements
// and rounds.

#include <algorithm>
#include <cmath>

#include "measurement/specimen_checks.hpp"
#include "wire/checks.hpp"
#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

// Nothing that is measured within measurement::kModulusPa and kToughnessPa exceeds these: an agent whose own message is
// refused cannot go on. GPa MPa; and the most that a tester may return, over the least that a specimen may have.
constexpr double kLargestArea = 1e13;
constexpr double kLargestError = kLargestPressurePa / measurement::kToughnessPa.least;

Result<void> expect_area(std::string_view member, double area) { return expect_range(member, area, 0.0, kLargestArea); }

/// Rank correlation and errors of a comparison of `count` designs.
Result<void> expect_errors(std::string_view member, int count, double mean, double maximum) {
  return all_of(expect_range(member, count, 0, kLargestCount), expect_range(member, mean, 0.0, kLargestError),
                expect_range(member, maximum, 0.0, kLargestError));
}

Result<std::vector<explore::Evaluated>> samples_of(const gamut_t& message) {
  std::vector<explore::Evaluated> samples;
  for (std::size_t i = 0; i < message.pattern.size(); ++i) {
    const Result<pattern::Pattern> pattern = pattern_from_bits(message.pattern[i]);
    if (!pattern) return tl::unexpected(pattern.error());
    const Result<void> sound = all_of(expect_pressure("modulus_pa", message.modulus_pa[i]),
                                      expect_pressure("toughness_pa", message.toughness_pa[i]));
    if (!sound) return tl::unexpected(sound.error());
    samples.push_back({*pattern, {message.modulus_pa[i], message.toughness_pa[i]}});
  }
  return samples;
}

Result<tester::Curve> measured_curve(const measurement_t& message) {
  if (const Result<void> sound = expect_count("strain", message.strain.size(), kMaximumCurvePoints); !sound) {
    return tl::unexpected(sound.error());
  }
  for (std::size_t i = 0; i < message.strain.size(); ++i) {
    if (message.strain[i] <= -1.0) return fail("strain is {}, expected above -1", message.strain[i]);
    const Result<void> sound =
        all_of(expect_range("strain", message.strain[i], -kLargestStrain, kLargestStrain),
               expect_range("stress_pa", message.stress_pa[i], -kLargestPressurePa, kLargestPressurePa));
    if (!sound) return tl::unexpected(sound.error());
  }
  return tester::Curve{message.strain, message.stress_pa};
}

}  // namespace

prediction_error_t to_wire(const sysid::PredictionErrors& errors) {
  return {errors.modulus_count,  errors.modulus_mean,  errors.modulus_max,       errors.toughness_count,
          errors.toughness_mean, errors.toughness_max, errors.toughness_spearman};
}

Result<sysid::PredictionErrors> from_wire(const prediction_error_t& message) {
  const Result<void> sound =
      all_of(expect_errors("modulus errors", message.n_modulus, message.modulus_mean, message.modulus_max),
             expect_errors("toughness errors", message.n_toughness, message.toughness_mean, message.toughness_max),
             expect_range("toughness_spearman", message.toughness_spearman, -1.000001, 1.000001));
  if (!sound) return tl::unexpected(sound.error());
  return sysid::PredictionErrors{.modulus_count = message.n_modulus,
                                 .modulus_mean = message.modulus_mean,
                                 .modulus_max = message.modulus_max,
                                 .toughness_count = message.n_toughness,
                                 .toughness_mean = message.toughness_mean,
                                 .toughness_max = message.toughness_max,
                                 .toughness_spearman = message.toughness_spearman};
}

gamut_t to_wire(const GamutChunk& chunk) {
  gamut_t message{};
  message.round = chunk.round;
  message.fidelity = to_wire(chunk.fidelity);
  message.chunk = chunk.chunk;
  message.chunks = chunk.chunks;
  for (const explore::Evaluated& sample : chunk.samples) {
    message.pattern.push_back(static_cast<std::int64_t>(sample.pattern.bits()));
    message.modulus_pa.push_back(sample.performance.modulus_pa);
    message.toughness_pa.push_back(sample.performance.toughness_pa);
  }
  return message;
}

Result<GamutChunk> from_wire(const gamut_t& message) {
  constexpr std::string_view type = "gamut_t";
  const Result<void> sound = all_of(expect_round(message.round), expect_range("chunks", message.chunks, 1, 1'000'000),
                                    expect_index("chunk", message.chunk, message.chunks),
                                    expect_count("pattern", message.pattern.size(), kGamutChunk));
  if (!sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  Result<std::vector<explore::Evaluated>> samples = samples_of(message);
  if (!samples) return in_type(type, samples.error());
  return GamutChunk{message.round, *fidelity, message.chunk, message.chunks, std::move(*samples)};
}

std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity,
                                     std::span<const explore::Evaluated> samples) {
  const std::size_t count = std::max<std::size_t>(1, (samples.size() + kGamutChunk - 1) / kGamutChunk);
  std::vector<GamutChunk> chunks;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = samples.subspan(i * kGamutChunk, std::min(kGamutChunk, samples.size() - i * kGamutChunk));
    chunks.push_back({round, fidelity, static_cast<int>(i), static_cast<int>(count), {part.begin(), part.end()}});
  }
  return chunks;
}

std::optional<std::vector<explore::Evaluated>> GamutCollector::add(GamutChunk part) {
  const int round = part.round;
  const int chunks = part.chunks;
  auto& parts = parts_[round];
  parts.insert_or_assign(part.chunk, std::move(part));
  if (static_cast<int>(parts.size()) < chunks) return std::nullopt;
  std::vector<explore::Evaluated> whole;
  for (const auto& [chunk, piece] : parts) whole.insert(whole.end(), piece.samples.begin(), piece.samples.end());
  parts_.erase(round);
  return whole;
}

proposal_t to_wire(const Proposal& proposal) {
  proposal_t message{};
  message.round = proposal.round;
  message.fidelity = to_wire(proposal.fidelity);
  message.gamut_hypervolume_staircase = proposal.gamut_hypervolume_staircase;
  message.gamut_hypervolume_polygon = proposal.gamut_hypervolume_polygon;
  message.simulations = proposal.simulations;
  for (const ProposedDesign& design : proposal.designs) {
    message.designs.push_back(
        {design.design.name(), design.modulus_pa, design.toughness_pa, design.bin, design.reason});
  }
  return message;
}

Result<Proposal> from_wire(const proposal_t& message) {
  constexpr std::string_view type = "proposal_t";
  const Result<void> sound = all_of(expect_round(message.round),
                                    expect_area("gamut_hypervolume_staircase", message.gamut_hypervolume_staircase),
                                    expect_area("gamut_hypervolume_polygon", message.gamut_hypervolume_polygon),
                                    expect_range("simulations", message.simulations, 0, kLargestCount),
                                    expect_count("designs", message.designs.size(), 1000));
  if (!sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  Proposal proposal{.round = message.round,
                    .fidelity = *fidelity,
                    .gamut_hypervolume_staircase = message.gamut_hypervolume_staircase,
                    .gamut_hypervolume_polygon = message.gamut_hypervolume_polygon,
                    .simulations = message.simulations,
                    .designs = {}};
  for (const proposed_design_t& proposed : message.designs) {
    const Result<pattern::Design> design = pattern::design_from_name(proposed.design);
    if (!design) return in_type(type, design.error());
    const Result<void> physical =
        all_of(expect_pressure("modulus_pa", proposed.modulus_pa),
               expect_pressure("toughness_pa", proposed.toughness_pa), expect_range("bin", proposed.bin, -1, 10'000));
    if (!physical) return in_type(type, physical.error());
    proposal.designs.push_back({*design, proposed.modulus_pa, proposed.toughness_pa, proposed.bin, proposed.reason});
  }
  return proposal;
}

test_order_t to_wire(const TestOrder& order) {
  test_order_t message{};
  message.round = order.round;
  message.order_id = order.order_id;
  message.design = order.design.name();
  message.test = to_wire(order.test);
  message.fidelity = to_wire(order.fidelity);
  message.replicates = order.replicates;
  message.conditions = to_wire(order.conditions);
  message.loading = tester::to_string(order.loading);
  message.batch = order.batch;
  message.reason = order.reason;
  return message;
}

Result<TestOrder> from_wire(const test_order_t& message) {
  constexpr std::string_view type = "test_order_t";
  const Result<void> sound = all_of(expect_round(message.round), expect_name("order_id", message.order_id),
                                    expect_range("replicates", message.replicates, 1, 1000));
  if (!sound) return in_type(type, sound.error());
  const Result<pattern::Design> design = pattern::design_from_name(message.design);
  if (!design) return in_type(type, design.error());
  const Result<tester::TestKind> test = test_kind_from_wire(message.test);
  if (!test) return in_type(type, test.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  const Result<tester::TestConditions> conditions = from_wire(message.conditions);
  if (!conditions) return in_type(type, conditions.error());
  const Result<tester::Loading> loading = tester::loading_from_string(message.loading);
  if (!loading) return in_type(type, loading.error());
  return TestOrder{message.round,      message.order_id, *design,  *test,         *fidelity,
                   message.replicates, *conditions,      *loading, message.batch, message.reason};
}

measurement_t to_wire(const Measurement& measurement) {
  const measurement::SpecimenRecord& record = measurement.record;
  measurement_t message{};
  message.round = measurement.round;
  message.order_id = measurement.order_id;
  message.specimen = record.specimen;
  message.design = record.design.name();
  message.test = to_wire(record.test);
  message.fidelity = to_wire(measurement.fidelity);
  message.conditions = to_wire(record.conditions);
  message.batch = record.batch;
  message.print_order = record.print_order;
  message.has_modulus = record.modulus_pa.has_value();
  message.modulus_pa = record.modulus_pa.value_or(0.0);
  message.has_toughness = record.toughness_pa.has_value();
  message.toughness_pa = record.toughness_pa.value_or(0.0);
  message.valid = record.valid;
  message.note = record.note;
  message.strain = record.curve.strain;
  message.stress_pa = record.curve.stress_pa;
  return message;
}

Result<Measurement> from_wire(const measurement_t& message) {
  constexpr std::string_view type = "measurement_t";
  const Result<void> sound =
      all_of(expect_round(message.round, -1), expect_name("specimen", message.specimen),
             expect_pressure("modulus_pa", message.modulus_pa), expect_pressure("toughness_pa", message.toughness_pa));
  if (!sound) return in_type(type, sound.error());
  const Result<pattern::Design> design = pattern::design_from_name(message.design);
  if (!design) return in_type(type, design.error());
  const Result<tester::TestKind> test = test_kind_from_wire(message.test);
  if (!test) return in_type(type, test.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  const Result<tester::TestConditions> conditions = from_wire(message.conditions);
  if (!conditions) return in_type(type, conditions.error());
  Result<tester::Curve> curve = measured_curve(message);
  if (!curve) return in_type(type, curve.error());
  measurement::SpecimenRecord record;
  record.specimen = message.specimen;
  record.design = *design;
  record.test = *test;
  record.conditions = *conditions;
  record.batch = message.batch;
  record.print_order = message.print_order;
  record.curve = std::move(*curve);
  record.valid = message.valid != 0;
  record.note = message.note;
  if (message.has_modulus) record.modulus_pa = message.modulus_pa;
  if (message.has_toughness) record.toughness_pa = message.toughness_pa;
  if (!record.valid) return Measurement{message.round, message.order_id, *fidelity, std::move(record)};
  if (const auto fault = measurement::why_unusable(record))
    return fail("{}: specimen {}: {} {}", type, message.specimen, fault->column, fault->reason);
  return Measurement{message.round, message.order_id, *fidelity, std::move(record)};
}

round_summary_t to_wire(const RoundSummary& summary) {
  round_summary_t message{};
  message.round = summary.round;
  message.fidelity = to_wire(summary.fidelity);
  message.n_calibration = summary.calibration_count;
  message.measured_hypervolume_staircase = summary.measured_hypervolume_staircase;
  message.measured_hypervolume_polygon = summary.measured_hypervolume_polygon;
  message.gamut_hypervolume_staircase = summary.gamut_hypervolume_staircase;
  message.gamut_hypervolume_polygon = summary.gamut_hypervolume_polygon;
  message.gap = summary.gap;
  message.signed_gap = summary.signed_gap;
  message.hypervolume_error = summary.hypervolume_error;
  message.before = to_wire(summary.before);
  message.after = to_wire(summary.after);
  message.held_out = to_wire(summary.held_out);
  message.equilibrium = summary.equilibrium;
  message.last = summary.last;
  message.decided_by = summary.decided_by;
  return message;
}

Result<RoundSummary> from_wire(const round_summary_t& message) {
  constexpr std::string_view type = "round_summary_t";
  const Result<void> sound = all_of(
      expect_round(message.round), expect_range("n_calibration", message.n_calibration, 0, kLargestCount),
      expect_area("measured_hypervolume_staircase", message.measured_hypervolume_staircase),
      expect_area("measured_hypervolume_polygon", message.measured_hypervolume_polygon),
      expect_area("gamut_hypervolume_staircase", message.gamut_hypervolume_staircase),
      expect_area("gamut_hypervolume_polygon", message.gamut_hypervolume_polygon), expect_area("gap", message.gap),
      expect_range("signed_gap", message.signed_gap, -kLargestArea, kLargestArea),
      expect_area("hypervolume_error", message.hypervolume_error));
  if (!sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  const Result<sysid::PredictionErrors> before = from_wire(message.before), after = from_wire(message.after),
                                        held_out = from_wire(message.held_out);
  for (const auto* errors : {&before, &after, &held_out}) {
    if (!*errors) return in_type(type, errors->error());
  }
  return RoundSummary{.round = message.round,
                      .fidelity = *fidelity,
                      .calibration_count = message.n_calibration,
                      .measured_hypervolume_staircase = message.measured_hypervolume_staircase,
                      .measured_hypervolume_polygon = message.measured_hypervolume_polygon,
                      .gamut_hypervolume_staircase = message.gamut_hypervolume_staircase,
                      .gamut_hypervolume_polygon = message.gamut_hypervolume_polygon,
                      .gap = message.gap,
                      .signed_gap = message.signed_gap,
                      .hypervolume_error = message.hypervolume_error,
                      .before = *before,
                      .after = *after,
                      .held_out = *held_out,
                      .equilibrium = message.equilibrium != 0,
                      .last = message.last != 0,
                      .decided_by = message.decided_by};
}

Result<void> validate(const run_t& message) {
  if (message.schema_version < 1) return fail("run_t: schema_version {}, expected 1 or more", message.schema_version);
  return expect_name("run_t: scenario_hash", message.scenario_hash);
}

Result<void> validate(const approval_t& message) {
  const Result<pattern::Design> design = pattern::design_from_name(message.design);
  if (!design) return in_type("approval_t", design.error());
  // Round -1: a person's own design, to which only a yes makes sense.
  return expect_round(message.round, message.approved != 0 ? -1 : 0);
}

Result<void> validate(const review_t& message) {
  return all_of(expect_name("review_t: specimen", message.specimen),
                expect_range("review_t: revision", message.revision, 0, kLargestCount));
}

Result<void> validate(const ack_t& message) {
  for (const std::string& hash : message.hashes) {
    const bool hex = hash.size() == 32 && hash.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!hex) return fail("ack_t: \"{}\" is not a hash of 32 hex digits", hash.substr(0, 40));
  }
  return {};
}

Result<void> validate(const node_status_t& message) {
  return all_of(expect_range("node_status_t: progress", message.progress, -1.0, 1.0),
                expect_range("node_status_t: unacknowledged", message.unacknowledged, 0, kLargestCount),
                expect_range("node_status_t: computing", message.computing, 0, kLargestCount));
}

}  // namespace nacre::wire
