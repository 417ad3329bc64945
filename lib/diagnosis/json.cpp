#include "diagnosis/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "diagnosis/words.hpp"
#include "material/extensions.hpp"
#include "measurement/held_strain.hpp"

namespace nacre::diagnosis {

using nlohmann::ordered_json;

namespace {

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

/// Numbers that follow from the parameters, as far as the data tell them.
ordered_json parameters_of(const NamedEffect& e, const material::Effect& effect) {
  ordered_json json = ordered_json::object();
  for (std::size_t p = 0; p < e.derived.size(); ++p) {
    const FittedNumber& number = e.derived[p];
    const material::DerivedNumber& derived = effect.derived[p];
    if (is_told(number, derived))
      json[std::string(derived.name)] = {
          {"value", number.value}, {"unit", derived.unit}, {"interval90", {number.interval_low, number.interval_high}}};
  }
  return json;
}

ordered_json json_of(const NamedEffect& e) {
  const material::Effect& effect = *material::find_effect(e.name);
  ordered_json json = {{"name", effect.cause()},
                       {"family", e.family},
                       {"parameter", e.parameter},
                       {"interval90", {e.interval_low, e.interval_high}},
                       {"unit", e.unit}};
  for (const FittedNumber& number : e.further) {
    json["further"].push_back(number.value);
    json["further_interval90"].push_back({number.interval_low, number.interval_high});
  }
  if (!e.each.empty()) json["each"] = e.each;
  if (!effect.form.empty()) json["form"] = effect.form;
  if (!effect.derived.empty()) json["parameters"] = parameters_of(e, effect);
  return json;
}

ordered_json json_of(const CandidateEffect& c) {
  return {{"name", c.name},
          {"status", to_string(c.status)},
          {"statistic", c.statistic},
          {"p_family_wise", c.p_family_wise},
          {"absorption", c.absorption},
          {"signal_to_noise", c.signal_to_noise},
          {"parameter", c.parameter},
          {"p_fit", c.p_fit},
          {"nearest_rival", c.nearest_rival},
          {"rival_cosine", c.rival_cosine},
          {"distance", c.distance},
          {"smallest_seen", or_null(c.smallest_seen)}};
}

ordered_json json_of(const Contrast& c) {
  return {{"name", c.name}, {"statistic", c.statistic}, {"p_family_wise", c.p_family_wise}};
}

ordered_json json_of(const SanityCheck& s) {
  return {{"changed", in_words(s.changed)},
          {"feature", to_string(s.feature)},
          {"largest", s.largest},
          {"allowed", s.allowed},
          {"numerical", s.numerical}};
}

ordered_json json_of(const NextExperiment& e);
ordered_json json_of(const ResidualRow& r);
ordered_json json_of(const MeasuredMean& m);
ordered_json json_of(const ConditionTrend& t);

ordered_json json_of(const FeatureGain& g) {
  return {{"feature", to_string(g.feature)},
          {"before", g.before},
          {"after", g.after},
          {"noise", g.noise},
          {"ranking", {{"pairs", g.ranking.pairs}, {"before", g.ranking.before}, {"after", g.ranking.after}}}};
}

template <class T>
ordered_json array_of(const std::vector<T>& items) {
  ordered_json array = ordered_json::array();
  for (const T& item : items) array.push_back(json_of(item));
  return array;
}

ordered_json json_of(const Gain& g) {
  return {{"held_out_error_before", g.held_out_error_before}, {"held_out_error_after", g.held_out_error_after},
          {"relative_reduction", g.relative_reduction},       {"interval90", {g.interval_low, g.interval_high}},
          {"of", g.of_coupons ? "coupons" : "designs"},       {"features", array_of(g.features)}};
}

ordered_json json_of(const NextExperiment& e) {
  return {{"design", e.design.name()},
          {"test", tester::to_string(e.test)},
          {"orientation_deg", e.conditions.orientation_deg},
          {"strain_rate_per_s", e.conditions.strain_rate_per_s},
          {"thickness_mm", e.conditions.thickness_mm},
          {"replicates", e.replicates},
          {"loading", tester::to_string(e.loading)},
          {"hold_s", or_null(e.hold_s)},
          {"temperature_c", or_null(e.surroundings.temperature_c)},
          {"humidity_pct", or_null(e.surroundings.humidity_pct)},
          {"age_days", or_null(e.surroundings.age_days)},
          {"machines", e.machines},
          {"reason", e.reason}};
}

ordered_json json_of(const ResidualRow& r) {
  return {{"design", r.design},
          {"test", tester::to_string(r.test)},
          {"orientation_deg", r.conditions.orientation_deg},
          {"strain_rate_per_s", r.conditions.strain_rate_per_s},
          {"thickness_mm", r.conditions.thickness_mm},
          {"feature", to_string(r.feature)},
          {"measured", r.measured},
          {"base", r.base},
          {"extended", r.extended},
          {"standard_error", r.standard_error}};
}

ordered_json by_name(std::span<const double> values, std::span<const std::string_view> names) {
  ordered_json object = ordered_json::object();
  for (std::size_t i = 0; i < values.size(); ++i) object[std::string(names[i])] = values[i];
  return object;
}

ordered_json json_of(const MeasuredMean& m) {
  ordered_json json = {{"design", m.design},
                       {"test", tester::to_string(m.test)},
                       {"orientation_deg", m.conditions.orientation_deg},
                       {"strain_rate_per_s", m.conditions.strain_rate_per_s},
                       {"thickness_mm", m.conditions.thickness_mm}};
  const measurement::Surroundings& around = m.surroundings;
  if (around.temperature_c) json["temperature_c"] = *around.temperature_c;
  if (around.humidity_pct) json["humidity_pct"] = *around.humidity_pct;
  if (around.age_days) json["age_days"] = *around.age_days;
  if (!around.machine.empty()) json["machine"] = around.machine;
  if (around.held) json["hold_s"] = measurement::rate_of_hold(m.conditions.strain_rate_per_s);
  json.update({{"quantity", to_string(m.quantity)},
               {"pieces", m.pieces},
               {"mean_pa", m.mean_pa},
               {"interval90_pa", {m.low_pa, m.high_pa}},
               {"scatter", m.scatter}});
  return json;
}

ordered_json json_of(const ConditionTrend& t) {
  return {{"of", t.of},
          {"quantity", to_string(t.quantity)},
          {"condition", t.condition},
          {"from", t.from},
          {"to", t.to},
          {"pieces", t.pieces},
          {"ratio", t.ratio},
          {"interval90", {t.low, t.high}},
          {"exponent", t.exponent},
          {"exponent_interval90", {t.exponent_low, t.exponent_high}},
          {"p_family_wise", t.chance}};
}

/// Models by the causes of their effects, forms of one effect once.
std::vector<std::vector<std::string>> causes_of(const std::vector<std::vector<std::string>>& models) {
  std::vector<std::vector<std::string>> causes;
  for (std::vector<std::string> model : models) {
    for (std::string& effect : model) effect = material::find_effect(effect)->cause();
    if (std::ranges::find(causes, model) == causes.end()) causes.push_back(std::move(model));
  }
  return causes;
}

/// Constants of the kinds of specimens that were included, by name.
ordered_json json_of(const FittedConstants& fit) {
  ordered_json object = ordered_json::object();
  if (fit.modulus) object["modulus"] = by_name(to_vector(*fit.modulus), material::modulus_parameter_names());
  if (fit.toughness) object["toughness"] = by_name(to_vector(*fit.toughness), material::toughness_parameter_names());
  if (fit.coupon) object["coupon"] = by_name(to_vector(*fit.coupon), material::modulus_parameter_names());
  object["extensions"] = fit.extensions;
  return object;
}

}  // namespace

std::string to_json(const Diagnosis& d) {
  const ordered_json document = {{"verdict", to_string(d.verdict)},
                                 {"summary", d.summary},
                                 {"effects", array_of(d.effects)},
                                 {"factors", d.factors},
                                 {"machines", d.machines},
                                 {"candidates", array_of(d.candidates)},
                                 {"contrasts", array_of(d.contrasts)},
                                 {"loudest", in_words(d.loudest)},
                                 {"gain", d.gain ? json_of(*d.gain) : ordered_json(nullptr)},
                                 {"next_experiments", array_of(d.next_experiments)},
                                 {"p_misfit", d.p_misfit},
                                 {"p_outside_library", d.p_outside},
                                 {"replicate_sd", d.replicate_sd},
                                 {"numerics_sd", d.discretisation_sd},
                                 {"numerics_shared_sd", d.discretisation_shared_sd},
                                 {"noise_known", d.noise_known},
                                 {"procedure", d.procedure},
                                 {"possible", causes_of(d.possible)},
                                 {"common_ground", in_words(d.common_ground)},
                                 {"partial_gain", d.partial_gain ? json_of(*d.partial_gain) : ordered_json(nullptr)},
                                 {"base_fit", json_of(d.base_fit)},
                                 {"extended_fit", json_of(d.extended_fit)},
                                 {"simulations", d.simulations},
                                 {"sanity", array_of(d.sanity)},
                                 {"residuals", array_of(d.residuals)},
                                 {"data", {{"means", array_of(d.data.means)}, {"trends", array_of(d.data.trends)}}}};
  return document.dump(2);
}

std::string to_json(const Plan& plan) {
  ordered_json effects = ordered_json::array(), additions = ordered_json::array();
  for (const PlannedEffect& e : plan.effects) {
    effects.push_back({{"name", e.name},
                       {"family", e.family},
                       {"status", to_string(e.status)},
                       {"smallest_seen", or_null(e.smallest_seen)},
                       {"smallest_told_apart", or_null(e.smallest_told_apart)},
                       {"unit", e.unit},
                       {"absorption", e.absorption},
                       {"signal_to_noise", e.signal_to_noise},
                       {"nearest_rival", e.nearest_rival},
                       {"rival_cosine", e.rival_cosine}});
  }
  for (const PlannedAddition& a : plan.additions) {
    ordered_json changes = ordered_json::array();
    for (const auto& c : a.changes)
      changes.push_back({{"effect", c.effect},
                         {"from", to_string(c.from)},
                         {"to", to_string(c.to)},
                         {"smallest_told_apart", or_null(c.told_apart_from)}});
    additions.push_back({{"words", a.words},
                         {"specimens", a.specimens},
                         {"replicates", a.replicates},
                         {"score", a.score},
                         {"changes", changes}});
  }
  return ordered_json{
      {"specimens", plan.specimens}, {"groups", plan.groups}, {"effects", effects}, {"additions", additions}}
      .dump(2);
}

}  // namespace nacre::diagnosis
