#pragma once
// The tables of the fields of a procedure (base/fields.hpp); that no field is missing is checked when this is compiled.

#include "base/fields.hpp"
#include "diagnosis/procedure.hpp"

namespace nacre::diagnosis {

constexpr void CurveReading::fields(auto& field, auto& m) {
  field("fracture_points", m.fracture_points);
  field("drop_offset", m.drop_offset);
  field("carried_share", m.carried_share);
  field("turned_share", m.turned_share);
  field("parted_share", m.parted_share);
  field("fewest_readings", m.fewest_readings);
  field("fewest_pieces", m.fewest_pieces);
  field("most_pieces", m.most_pieces);
  field("fewest_per_knot", m.fewest_per_knot);
  field("quiet_scatter", m.quiet_scatter);
  field("knot_scatter", m.knot_scatter);
}

constexpr void NoiseRules::fields(auto& field, auto& m) {
  field("assumed_sd", m.assumed_sd);
  field("assumed_toe", m.assumed_toe);
  field("enough_dof", m.enough_dof);
  field("own_dof", m.own_dof);
  field("least_modulus_sd", m.least_modulus_sd);
  field("least_curve_sd", m.least_curve_sd);
  field("least_strain_sd", m.least_strain_sd);
  field("stresses_together", m.stresses_together);
  field("dof_per_batch", m.dof_per_batch);
  field("fewest_for_history", m.fewest_for_history);
  field("constant_sd", m.constant_sd);
  field("crack_scatter_sd", m.crack_scatter_sd);
  field("piece_sd", m.piece_sd);
  field("unlike_scatter", m.unlike_scatter);
  field("assumed_worth", m.assumed_worth);
  field("exponent_sd", m.exponent_sd);
  field("level_sd", m.level_sd);
}

constexpr void ConstantRules::fields(auto& field, auto& m) {
  field("widening", m.widening);
  field("other_material", m.other_material);
  field("least_ratio", m.least_ratio);
  field("most_ratio", m.most_ratio);
  field("prior_sd", m.prior_sd);
  field("eta_reach", m.eta_reach);
  field("eta_sd", m.eta_sd);
  field("start_margin", m.start_margin);
  field("at_bound", m.at_bound);
}

constexpr void EmulatorRules::fields(auto& field, auto& m) {
  field("pairs", m.pairs);
  field("spread", m.spread);
  field("effect_sizes", m.effect_sizes);
  field("jitter", m.jitter);
  field("models_in_turn", m.models_in_turn);
  field("near_pairs", m.near_pairs);
  field("sizes_in_turn", m.sizes_in_turn);
  field("kept_pairs", m.kept_pairs);
  field("kept_spread", m.kept_spread);
  field("kept_sizes", m.kept_sizes);
  field("kept_jitter", m.kept_jitter);
  field("components", m.components);
  field("runs_of_component", m.runs_of_component);
  field("level_sd", m.level_sd);
  field("curved_length", m.curved_length);
  field("effect_length", m.effect_length);
  field("own_shares", m.own_shares);
  field("no_effect", m.no_effect);
  field("least_amplitude", m.least_amplitude);
  field("kernel", m.kernel);
  field("kernel_sd", m.kernel_sd);
  field("nearest", m.nearest);
  field("refinements", m.refinements);
  field("refined_effects", m.refined_effects);
  field("well_known", m.well_known);
  field("refined_layouts", m.refined_layouts);
  field("refined_specimens", m.refined_specimens);
  field("floor_log_sd", m.floor_log_sd);
  field("floor_worth", m.floor_worth);
}

constexpr void FitRules::fields(auto& field, auto& m) {
  field("iterations", m.iterations);
  field("converged", m.converged);
  field("sizes", m.sizes);
  field("typical", m.typical);
  field("probes", m.probes);
  field("far_behind", m.far_behind);
  field("restart_sizes", m.restart_sizes);
  field("nothing", m.nothing);
  field("better", m.better);
  field("noise_sd", m.noise_sd);
  field("mesh_passes", m.mesh_passes);
}

constexpr void Levels::fields(auto& field, auto& m) {
  field("name", m.name);
  field("unexplained", m.unexplained);
  field("exclusion", m.exclusion);
  field("discrepancy", m.discrepancy);
  field("contrast", m.contrast);
  field("matters", m.matters);
}

constexpr void NameRules::fields(auto& field, auto& m) {
  field("visible_signal", m.visible_signal);
  field("distinct", m.distinct);
  field("left_by_collinear", m.left_by_collinear);
  field("lead", m.lead);
  field("certain_lead", m.certain_lead);
  field("contrast_tie", m.contrast_tie);
  field("even_lead", m.even_lead);
  field("imitated", m.imitated);
  field("powers", m.powers);
  field("pair_anchors", m.pair_anchors);
  field("pair_share", m.pair_share);
  field("amplitudes", m.amplitudes);
  field("carried", m.carried);
  field("along_contrasts", m.along_contrasts);
  field("discrepancy_draws", m.discrepancy_draws);
}

constexpr void SizeRules::fields(auto& field, auto& m) {
  field("shares", m.shares);
  field("of_interest", m.of_interest);
  field("step", m.step);
  field("caught", m.caught);
  field("rounds", m.rounds);
  field("beyond", m.beyond);
}

constexpr void GainRules::fields(auto& field, auto& m) {
  field("folds", m.folds);
  field("interval_draws", m.interval_draws);
  field("set_apart", m.set_apart);
  field("law_share", m.law_share);
}

constexpr void TestRules::fields(auto& field, auto& m) {
  field("count", m.count);
  field("replicates", m.replicates);
  field("second_rate", m.second_rate);
  field("second_thickness", m.second_thickness);
  field("condition_twins", m.condition_twins);
  field("holds_s", m.holds_s);
  field("far_apart", m.far_apart);
  field("most_errors", m.most_errors);
  field("least_errors", m.least_errors);
  field("least_fall", m.least_fall);
  field("same_errors", m.same_errors);
  field("broken_specimens", m.broken_specimens);
  field("bundle", m.bundle);
  field("worth_telling", m.worth_telling);
  field("planned_sizes", m.planned_sizes);
  field("planned_typical", m.planned_typical);
}

constexpr void CautionRules::fields(auto& field, auto& m) {
  field("numerical", m.numerical);
  field("equal_replicates", m.equal_replicates);
}

constexpr void Procedure::fields(auto& field, auto& m) {
  field("curves", m.curves);
  field("noise", m.noise);
  field("constants", m.constants);
  field("emulator", m.emulator);
  field("fit", m.fit);
  field("levels", m.levels);
  field("names", m.names);
  field("sizes", m.sizes);
  field("gain", m.gain);
  field("tests", m.tests);
  field("cautions", m.cautions);
}

/// Stands for a value of any type; never made.
struct AnyValue {
  template <class T>
  constexpr operator T() const noexcept;
};

/// How many members an aggregate has.
template <class T, class... Given>
consteval int member_count() {
  if constexpr (requires { T{Given{}..., AnyValue{}}; }) {
    return member_count<T, Given..., AnyValue>();
  } else {
    return sizeof...(Given);
  }
}

/// Whether a table lists every member.
template <class T>
consteval bool lists_every_member() {
  int listed = 0;
  auto count = [&](std::string_view, const auto&) { ++listed; };
  const T values{};
  T::fields(count, values);
  return listed == member_count<T>();
}

static_assert(lists_every_member<CurveReading>() && lists_every_member<NoiseRules>() &&
              lists_every_member<ConstantRules>() && lists_every_member<EmulatorRules>() &&
              lists_every_member<FitRules>() && lists_every_member<Levels>() && lists_every_member<NameRules>() &&
              lists_every_member<SizeRules>() && lists_every_member<GainRules>() && lists_every_member<TestRules>() &&
              lists_every_member<CautionRules>() && lists_every_member<Procedure>());

}  // namespace nacre::diagnosis
