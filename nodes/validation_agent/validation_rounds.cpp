// Part of ValidationCore (validation_core.hpp): the course of a round, from its orders to its ROUND.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/counted.hpp"
#include "base/random.hpp"
#include "game/budget.hpp"
#include "game/model.hpp"
#include "game/standings.hpp"
#include "runtime/round_history.hpp"
#include "sysid/errors.hpp"
#include "sysid/provenance.hpp"
#include "validation_agent/validation_core.hpp"
#include "wire/schema.hpp"

namespace nacre::validation_agent {

using runtime::LogLevel;

void ValidationCore::begin_round(int round) {
  round_ = round;
  before_ = after_ = out_of_sample_ = {};
  simulations_ = 0;
  if (round == 0) {
    send_orders(desk_.open_game());
    calibration_set_ = start_.base_materials;
    if (calibration_set_.empty()) return begin_unfitted();
    return begin_calibration(model_);
  }
  take_early_measurements();
  if (trial_ && !proposals_.at(round - 1).designs.empty()) return predict_for_trial();
  order();
}

void ValidationCore::take_early_measurements() {
  const auto early = early_measurements_.extract(round_);
  if (!early) return;
  for (const std::string& payload : early.mapped()) accept_measurement(payload);
  outputs_.refusal.clear();  // of messages that were acknowledged long ago
}

void ValidationCore::begin_unfitted() {
  provenance_ = {};
  provenance_.search = "begun_with";
  say(LogLevel::info, "round 0: no base materials to fit, the model is used as given");
  publish_model();
}

std::vector<game::DiscriminationTest> ValidationCore::experiments() const {
  std::vector<game::DiscriminationTest> experiments;
  if (!diagnosis_ || model_holds(*diagnosis_)) return experiments;
  for (const wire::NextExperiment& next : diagnosis_->next_experiments)
    experiments.push_back({.design = next.design,
                           .test = next.test,
                           .conditions = next.conditions,
                           .loading = next.loading,
                           .replicates = next.replicates});
  return experiments;
}

void ValidationCore::order() {
  std::vector<pattern::Design> designs;
  for (const wire::ProposedDesign& proposed : proposals_.at(round_ - 1).designs) designs.push_back(proposed.design);
  phase_ = Phase::measuring;
  if (const std::string given_up = game::budget_in_words(scenario_, round_); !given_up.empty())
    say(LogLevel::info, given_up);
  send_orders(desk_.open_round(round_, std::move(designs), experiments()));
  measure_on();
}

wire::TestOrder ValidationCore::message_of(const game::Order& order) const {
  return {.round = order.round,
          .order_id = order.id,
          .design = order.design,
          .test = order.test,
          .fidelity = scenario_.fidelity,
          .replicates = order.replicates,
          .conditions = order.conditions,
          .loading = order.loading,
          .batch = order.batch,
          .reason = std::string(game::to_string(order.reason))};
}

void ValidationCore::send_orders(const std::vector<game::Order>& orders) {
  for (const game::Order& order : orders) send("TEST_ORDER", message_of(order));
  if (!orders.empty())
    say(LogLevel::info,
        fmt::format("round {}: {} for the laboratory", orders.front().round, counted(std::ssize(orders), "order")));
}

void ValidationCore::measure_on() {
  const auto [complete, all] = desk_.completed(book_);
  if (desk_.awaiting_approval() > 0 || complete < all) return;
  if (families_) return finish_families();
  specimens_ = book_.specimens();
  revisions_ = book_.revisions();
  calibration_set_ = game::calibration_set(specimens_);
  say(LogLevel::info,
      fmt::format("round {}: measured, {} to calibrate on", round_, counted(std::ssize(calibration_set_), "design")));
  predict_out_of_sample();
}

void ValidationCore::predict_out_of_sample() {
  std::map<std::string, sysid::Prediction> proposed;
  for (const wire::ProposedDesign& each : proposals_.at(round_ - 1).designs) {
    if (!calibrated_designs_.contains(each.design.name()))
      proposed[each.design.name()] = {.modulus_pa = each.modulus_pa, .toughness_pa = each.toughness_pa, .curve = {}};
  }
  game::PredictedDesigns predicted = game::predicted_among(calibration_set_, proposed);
  predicted_set_ = std::move(predicted.measured);
  proposed_ = std::move(predicted.predicted);
  if (predicted_set_.empty() || !game::has_measurement_side(model_)) return finish_out_of_sample(proposed_);
  // A prediction as recorded by the testing machine needs its curve, which a proposal does not carry: requested again,
  // and taken from the farm's cache.
  sysid::WantedEvaluation evaluation =
      sysid::as_prediction({.id = "0", .parameters = model_, .modulus = true, .toughness = true, .items = {}});
  for (std::size_t item = 0; item < predicted_set_.size(); ++item) evaluation.items.push_back(item);
  phase_ = Phase::predicting;
  ask_farm("h", {evaluation}, predicted_set_);
}

void ValidationCore::finish_out_of_sample(const std::vector<sysid::Prediction>& predictions) {
  std::vector<sysid::Prediction> observed;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    observed.push_back(game::through_machine(predictions[i], model_));
    // The curve is one simulation's, what was proposed may be the mean of several.
    auto& toughness_pa = observed.back().toughness_pa;
    if (toughness_pa && predictions[i].toughness_pa.value_or(0.0) > 0.0)
      *toughness_pa *= *proposed_[i].toughness_pa / *predictions[i].toughness_pa;
  }
  out_of_sample_ = sysid::prediction_errors(predicted_set_, observed);
  if (trial_) {
    std::map<std::string, sysid::Prediction> adopted;
    for (std::size_t i = 0; i < predicted_set_.size(); ++i)
      adopted.emplace(predicted_set_[i].design.name(), observed[i]);
    adopted.merge(trial_->adopted);
    trial_->errors.add(round_, game::under_standard_conditions(calibration_set_), adopted, trial_->predicted);
  }
  extending_ = false;
  begin_calibration(model_);
}

material::FitTarget ValidationCore::fit_target() const {
  return round_ == 0 ? material::FitTarget::base : material::FitTarget::microstructures;
}

void ValidationCore::begin_calibration(const material::ParameterSet& start) {
  sysid::CalibrationSettings settings;
  settings.target = fit_target();
  settings.ranges = start_.ranges;
  settings.start = start;
  settings.modulus_budget = scenario_.validation.modulus_evaluations;
  settings.toughness_budget = scenario_.validation.calibration_evaluations;
  settings.batch = scenario_.validation.calibration_batch;
  settings.strength_variation = !extending_;  // an extension is compared at the variation of the model it extends
  settings.floor = start_.floor;
  settings.seed = RandomStream(scenario_.seed, fmt::format("calibration of round {}", round_)).bits();
  fitting_.emplace(calibration_set_, settings);
  phase_ = Phase::calibrating;
  calibrate_on();
}

void ValidationCore::ask_farm(const std::string& label, const std::vector<sysid::WantedEvaluation>& wanted,
                              const std::vector<measurement::Replicates>& measured) {
  for (const wire::SimulateRequest& request : farm_.ask({.requester = "validation_agent",
                                              .label = fmt::format("r{}/{}", round_, label),
                                              .wanted = wanted,
                                              .measured = measured,
                                              .fidelity = scenario_.fidelity})) {
    send("SIMULATE", request);
  }
}

void ValidationCore::calibrate_on() {
  if (fitting_->calibration().finished()) return finish_calibration();
  ask_farm(extending_ ? "x" : "c", fitting_->calibration().wanted(), fitting_->measured());
}

void ValidationCore::finish_calibration() {
  const sysid::Calibrated result = fitting_->calibration().result();
  std::vector<sysid::EvaluatedModel> evaluated = fitting_->evaluated();
  fitting_.reset();
  simulations_ += result.simulations;
  if (extending_) return finish_trial(result);
  evaluated_ = std::move(evaluated);
  before_ = result.before;
  take_over(result);
  for (const measurement::Replicates& measured : calibration_set_) calibrated_designs_.insert(measured.design.name());
  say(LogLevel::info, fmt::format("round {}: calibrated with {} simulations, mean errors E {:.1f} %, T {:.1f} %",
                                  round_, simulations_, 100.0 * after_.modulus_mean, 100.0 * after_.toughness_mean));
  const bool something_to_diagnose = round_ > 0 && !calibration_set_.empty();
  if (scenario_.diagnosis.enabled && something_to_diagnose) return diagnose();
  publish_model();
}

void ValidationCore::take_over(const sysid::Calibrated& result) {
  after_ = result.after;
  model_ = result.parameters;
  provenance_ = sysid::provenance_of(
      result, round_ == 0 ? "base_materials" : sysid::to_string(sysid::CalibrationSettings{}.toughness_search));
  for (const auto& [what, fit] : {std::pair{"E", provenance_.modulus_fit}, std::pair{"T", provenance_.toughness_fit}}) {
    if (fit.misfit())
      say(LogLevel::warning, fmt::format("round {}: the model misfits {}: chi squared {:.1f} at {} degrees of freedom",
                                         round_, what, fit.chi_squared, fit.freedom));
  }
  if (const auto& scatter = result.strength_variation)
    say(LogLevel::info, fmt::format("round {}: replicates scatter by {:.1f} % in T, {:.1f} % by the model", round_,
                                    100.0 * scatter->measured_sd, 100.0 * scatter->predicted_sd));
  for (const sysid::ParameterEstimate& each : sysid::at_an_end(result, start_.ranges, fit_target())) {
    // The fracture tester has moduli of its own, at bounds that the thesis' inks reach; what the data do not tell may
    // end anywhere. Base materials alone determine each modulus by its own test.
    const bool telling = each.determined || round_ == 0 || provenance_.modulus_fit.misfit();
    say(each.name.starts_with("modulus.e_") && telling ? LogLevel::warning : LogLevel::info,
        fmt::format("round {}: {} is at its bound: other inks need other ranges (ranges_file)", round_, each.name));
  }
}

/// As many as a message may hold beside the names of specimens: the search ends near what it found.
std::vector<sysid::EvaluatedModel> ValidationCore::latest_evaluated() const {
  constexpr std::size_t kMost = 60;
  const std::size_t first = evaluated_.size() - std::min(kMost, evaluated_.size());
  return {evaluated_.begin() + static_cast<std::ptrdiff_t>(first), evaluated_.end()};
}

void ValidationCore::diagnose() {
  wire::DiagnoseRequest request{.round = round_,
                                .fidelity = scenario_.fidelity,
                                .parameters = model_,
                                .evaluated = latest_evaluated(),
                                .specimens = {}};
  const std::size_t room = wire::kMaximumBlankPayload - wire::write(request).size();
  for (std::string& name : game::specimens_to_name(specimens_, room)) {
    const int revision = revisions_.at(name);
    request.specimens.push_back({std::move(name), revision});
  }
  const auto valid = std::ranges::count_if(specimens_, &measurement::SpecimenRecord::valid);
  if (std::cmp_less(request.specimens.size(), valid)) {
    say(LogLevel::warning,
        fmt::format("round {}: the diagnosis rests on {} of {} valid specimens, equally many replicates of each test: "
                    "more names do not fit into one message",
                    round_, request.specimens.size(), valid));
  }
  phase_ = Phase::diagnosing;
  send("DIAGNOSE", request);
  if (const auto early = early_diagnoses_.extract(round_)) take_diagnosis(early.mapped());
}

void ValidationCore::publish_model() {
  wire::AdoptedModel adopted;
  adopted.round = round_;
  adopted.fidelity = scenario_.fidelity;
  adopted.parameters = model_;
  adopted.before = before_;
  adopted.after = after_;
  adopted.simulations = simulations_;
  adopted.provenance = provenance_;
  adopted.benchmark = benchmark();
  const std::set<pattern::Pattern> settled = settled_patterns();
  const std::size_t room = (wire::kMaximumBlankPayload - wire::write(adopted).size()) / sizeof(std::int64_t);
  if (settled.size() > room)
    say(LogLevel::warning, fmt::format("round {}: a message has room for {} of {} patterns that were measured: others "
                                       "may be proposed again",
                                       round_, room, settled.size()));
  adopted.measured.assign(settled.begin(), std::next(settled.begin(), std::min(room, settled.size())));
  phase_ = Phase::waiting_for_proposal;
  send("PARAMETERS", adopted);
  close_round_when_proposed();  // where both were sent before this agent's journal was lost
}

std::vector<optimize::Performance> ValidationCore::benchmark() const {
  // The proposal agent compares its gamut with the line, and knows the material side alone.
  std::vector<optimize::Performance> line = game::benchmark_line(specimens_);
  if (line.empty()) line = start_.benchmark;
  for (optimize::Performance& measured : line) measured = game::behind_machine(measured, model_);
  return line;
}

std::set<pattern::Pattern> ValidationCore::settled_patterns() const {
  std::set<pattern::Pattern> settled = desk_.settled_patterns();
  for (const auto& [pattern, values] : game::measured_values(specimens_)) settled.insert(pattern);
  return settled;
}

void ValidationCore::close_round_when_proposed() {
  if (phase_ != Phase::waiting_for_proposal || !gamuts_.whole(round_) || !proposals_.contains(round_)) return;
  wire::RoundSummary round = summary();
  history_.push_back({.round = round_,
                      .measured_hypervolume = round.measured_hypervolume_staircase,
                      .hypervolume_error = round.hypervolume_error,
                      .signed_gap = round.signed_gap});
  const game::EquilibriumCheck check = game::judge_equilibrium(history_);
  round.equilibrium = check.equilibrium;
  round.last = round_ >= scenario_.rounds || (check.equilibrium && scenario_.stop_at_equilibrium);
  round.decided_by = check.decided_by;
  if (round.last && !check.equilibrium)
    round.decided_by += fmt::format("; the limit of {} is reached", counted(scenario_.rounds, "round"));
  gamuts_.forget_before(round_);
  StageBeginning beginning = stage_beginning();
  const bool families_follow = round.last && scenario_.families.enabled && FamilyStage::is_possible(beginning);
  if (families_follow) {
    last_round_ = round;
    round.last = false;
    round.decided_by += "; families follow";
  }
  send("ROUND", round);
  const bool has_news = round_ > 0 || round.last || families_follow;  // of round 0 the sentence says it all
  say(LogLevel::info, runtime::in_words(round) + (has_news ? "; " + round.decided_by : ""));
  if (families_follow) {
    phase_ = Phase::working_out_families;
    families_.emplace(scenario_, std::move(beginning));
    families_->begin(outputs_);
  } else if (round.last) {
    phase_ = Phase::finished;
    for (const pattern::Design& each : desk_.own())
      say(LogLevel::warning, fmt::format("{} is not measured: no round follows", each.name()));
  } else {
    begin_round(round_ + 1);
  }
}

StageBeginning ValidationCore::stage_beginning() const {
  const std::set<pattern::Pattern> settled = settled_patterns();
  return {.round = round_ + 1,
          .model = model_,
          .measured = game::patterns_with_both(specimens_),
          .benchmark = benchmark(),
          .settled = {settled.begin(), settled.end()},
          .ranges = start_.ranges,
          .floor = start_.floor};
}

void ValidationCore::measure_families_when_chosen() {
  if (!families_->has_chosen()) return;
  ++round_;
  take_early_measurements();
  phase_ = Phase::measuring;
  send_orders(desk_.open_family_round(round_, families_->chosen()));
  measure_on();
}

void ValidationCore::finish_families() {
  families_->conclude(game::calibration_set(book_.specimens()), outputs_);
  phase_ = Phase::finished;
  send("ROUND", last_round_);
}

wire::RoundSummary ValidationCore::summary() {
  const auto values = game::measured_values(specimens_);
  const auto measured = game::measured_performances(values);
  std::vector<optimize::Performance> gamut;
  for (const explore::Evaluated& sample : *gamuts_.whole(round_))
    gamut.push_back(game::through_machine(sample.performance, model_));
  wire::RoundSummary round;
  round.round = round_;
  round.fidelity = scenario_.fidelity;
  round.calibration_count = static_cast<int>(calibration_set_.size());
  round.measured_hypervolume_staircase = optimize::hypervolume_staircase_gpa_mpa(measured);
  round.measured_hypervolume_polygon = optimize::hypervolume_polygon_gpa_mpa(measured);
  round.gamut_hypervolume_staircase = optimize::hypervolume_staircase_gpa_mpa(gamut);
  round.gamut_hypervolume_polygon = optimize::hypervolume_polygon_gpa_mpa(gamut);
  round.gap = optimize::front_gap_gpa_mpa(gamut, measured);
  round.signed_gap = round.gamut_hypervolume_staircase - round.measured_hypervolume_staircase;
  round.hypervolume_error = game::hypervolume_error(values, scenario_.seed);
  round.before = before_;
  round.after = after_;
  round.held_out = out_of_sample_;
  return round;
}

}  // namespace nacre::validation_agent
