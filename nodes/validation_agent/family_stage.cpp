#include "validation_agent/family_stage.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

#include <fmt/format.h>

#include "base/counted.hpp"
#include "base/random.hpp"
#include "game/model.hpp"
#include "game/standings.hpp"
#include "select/select.hpp"
#include "sysid/errors.hpp"
#include "sysid/objective.hpp"
#include "validation_agent/family_work.hpp"

namespace nacre::validation_agent {
namespace {

using runtime::LogLevel;

constexpr const char* kGroupingId = "families/group";

pattern::Pattern pattern_of(const measurement::Replicates& measured) {
  return game::eightfold_pattern(measured.design).value();
}

/// The measurements of a pattern itself, not of a twin pulled faster or thinner; null where there are none.
const measurement::Replicates* measured_of(const std::vector<measurement::Replicates>& measured,
                                           const pattern::Pattern& pattern) {
  const auto found = std::ranges::find_if(measured, [&](const measurement::Replicates& each) {
    return each.design == pattern::Design(pattern) && game::is_standard(each.conditions);
  });
  return found == measured.end() ? nullptr : &*found;
}

std::vector<families::MeasuredPattern> members_of(const std::vector<measurement::Replicates>& measured) {
  std::vector<families::MeasuredPattern> members;
  for (const measurement::Replicates& each : measured)
    members.push_back({pattern_of(each), {each.modulus_pa, each.toughness_pa}});
  return members;
}

void say(runtime::Outputs& outputs, LogLevel level, std::string text) {
  outputs.log.push_back({level, std::move(text)});
}

/// Both tests of patterns that nobody measured.
std::vector<measurement::Replicates> unmeasured(const std::vector<pattern::Pattern>& patterns) {
  std::vector<measurement::Replicates> all;
  for (const pattern::Pattern& pattern : patterns) {
    all.emplace_back().design = pattern;
    all.back().modulus_count = all.back().toughness_count = 1;
  }
  return all;
}

sysid::WantedEvaluation evaluation_of_all(const std::string& id, const material::ParameterSet& parameters,
                                          std::size_t count) {
  sysid::WantedEvaluation evaluation{
      .id = id, .parameters = parameters, .modulus = true, .toughness = true, .items = {}};
  for (std::size_t item = 0; item < count; ++item) evaluation.items.push_back(item);
  return sysid::as_prediction(std::move(evaluation));
}

/// As recorded by the testing machine.
game::DesignValues recorded(const sysid::Prediction& prediction, const material::Extensions& extensions) {
  const sysid::Prediction observed = sysid::observed(prediction, extensions);
  return {observed.modulus_pa, observed.toughness_pa};
}

std::string errors_in_words(const sysid::PredictionErrors& errors) {
  return fmt::format("E {:.1f} %, T {:.1f} %", 100.0 * errors.modulus_mean, 100.0 * errors.toughness_mean);
}

}  // namespace

FamilyStage::FamilyStage(const game::Scenario& scenario, StageBeginning beginning)
    : scenario_(scenario), beginning_(std::move(beginning)) {}

void FamilyStage::begin(runtime::Outputs& outputs) {
  outputs.computes.push_back({.id = kGroupingId,
                              .kind = "group_families",
                              .spec = grouping_spec(members_of(beginning_.measured), scenario_.families.rank)});
}

void FamilyStage::accept_work(const runtime::WorkDone& work, runtime::Outputs& outputs) {
  if (step_ == Step::grouping && work.id == kGroupingId) {
    Grouping grouping = grouping_from(work.result);
    say(outputs, grouping.file_is_faulty ? LogLevel::warning : LogLevel::info, "family stage: " + grouping.remark);
    groups_ = std::move(grouping.families);
    // What families are calibrated on: near-Pareto designs, and whatever a person made a seed.
    const auto near = families::near_pareto(members_of(beginning_.measured), scenario_.families.rank);
    std::erase_if(beginning_.measured, [&](const measurement::Replicates& each) {
      const pattern::Pattern pattern = pattern_of(each);
      return std::ranges::count(near, pattern, &families::MeasuredPattern::pattern) == 0 &&
             std::ranges::none_of(
                 groups_, [&](const families::SeedFamily& f) { return std::ranges::count(f.seeds, pattern) > 0; });
    });
    begin_family(outputs);
  } else if (step_ == Step::sampling && work.id == label("sample")) {
    variants_ = sample_from(work.result);
    simulate_variants(outputs);
  } else {
    say(outputs, LogLevel::warning, "the result of " + work.id + " is ignored: it is not awaited");
  }
}

void FamilyStage::accept_response(wire::SimulateResult part, runtime::Outputs& outputs) {
  if (!farm_.take(std::move(part))) return;
  if (step_ == Step::calibrating) {
    fitting_->tell(farm_.predictions());
    calibrate_on(outputs);
  } else if (step_ == Step::simulating) {
    choose(outputs);
  } else if (step_ == Step::predicting) {
    finish_family(outputs);
  }
}

std::string FamilyStage::label(const char* what) const {
  return fmt::format("families/{}/{}", families_.size() - 1, what);
}

void FamilyStage::ask(const runtime::FarmBatch& batch, runtime::Outputs& outputs) {
  for (const wire::SimulateRequest& request : farm_.ask(batch))
    outputs.messages.push_back({"SIMULATE", wire::write(request)});
}

void FamilyStage::begin_family(runtime::Outputs& outputs) {
  if (families_.size() == groups_.size()) {
    step_ = Step::done;
    has_chosen_ = true;
    return;
  }
  const families::SeedFamily& group = groups_[families_.size()];
  wire::CalibratedFamily& family = families_.emplace_back();
  family.round = beginning_.round;
  family.fidelity = scenario_.fidelity;
  family.number = static_cast<int>(families_.size()) - 1;
  family.count = groups_.size();
  family.name = group.name;
  const std::size_t room = wire::kMostFamilyDesigns - static_cast<std::size_t>(scenario_.families.designs);
  if (group.seeds.size() > room)
    say(outputs, LogLevel::warning,
        fmt::format("{}: the first {} of its {} seeds, which a message has room for", family.name, room,
                    group.seeds.size()));
  for (const pattern::Pattern& seed : group.seeds | std::views::take(static_cast<std::ptrdiff_t>(room)))
    family.designs.push_back(
        {.pattern = seed, .is_seed = true, .measured = measured_values(seed), .global_model = {}, .family_model = {}});
  sysid::CalibrationSettings settings;
  settings.ranges = beginning_.ranges;
  settings.start = beginning_.model;
  settings.modulus_budget = scenario_.families.modulus_evaluations;
  settings.toughness_budget = scenario_.families.calibration_evaluations;
  settings.strength_variation = false;  // few designs: that of the whole
  settings.batch = scenario_.validation.calibration_batch;
  settings.floor = beginning_.floor;
  settings.seed = RandomStream(scenario_.seed, "calibration of " + group.name).bits();
  for (const measurement::Replicates& each : beginning_.measured)
    settings.weights.push_back(families::calibration_weight(group, pattern_of(each)));
  fitting_.emplace(beginning_.measured, settings);
  step_ = Step::calibrating;
  calibrate_on(outputs);
}

void FamilyStage::calibrate_on(runtime::Outputs& outputs) {
  if (!fitting_->calibration().finished()) {
    return ask({.requester = "validation_agent",
                .label = label("c"),
                .wanted = fitting_->calibration().wanted(),
                .measured = fitting_->measured(),
                .fidelity = scenario_.fidelity},
               outputs);
  }
  families_.back().parameters = fitting_->calibration().result().parameters;
  families_.back().simulations = fitting_->calibration().result().simulations;
  fitting_.reset();
  sample(outputs);
}

void FamilyStage::sample(runtime::Outputs& outputs) {
  const families::SeedFamily& group = groups_[families_.size() - 1];
  step_ = Step::sampling;
  outputs.computes.push_back(
      {.id = label("sample"),
       .kind = "sample_family",
       .spec = sampling_spec(group, scenario_.families.samples,
                             RandomStream(scenario_.seed, "dense sampling of " + group.name).bits())});
}

void FamilyStage::simulate_variants(runtime::Outputs& outputs) {
  asked_ = unmeasured(variants_);
  step_ = Step::simulating;
  ask({.requester = "validation_agent",
       .label = label("v"),
       .wanted = {evaluation_of_all("0", families_.back().parameters, asked_.size())},
       .measured = asked_,
       .fidelity = scenario_.fidelity,
       .curve_points = 0},
      outputs);
}

void FamilyStage::choose(runtime::Outputs& outputs) {
  wire::CalibratedFamily& family = families_.back();
  gamut_.clear();
  const std::vector<sysid::Prediction>& predictions = farm_.predictions().front();
  for (std::size_t i = 0; i < variants_.size(); ++i) {
    if (predictions[i].modulus_pa && predictions[i].toughness_pa)
      gamut_.push_back({variants_[i], {*predictions[i].modulus_pa, *predictions[i].toughness_pa}});
  }
  family.samples = gamut_.size();
  for (const select::Selected& each :
       select::select_with_reserve(gamut_, beginning_.settled, beginning_.benchmark, scenario_.families.designs)) {
    family.designs.push_back(
        {.pattern = each.pattern, .is_seed = false, .measured = {}, .global_model = {}, .family_model = {}});
    beginning_.settled.push_back(each.pattern);  // families may overlap
    say(outputs, LogLevel::info, fmt::format("{}: {} chosen, {}", family.name, each.pattern.key(), each.reason));
  }
  std::vector<pattern::Pattern> designs;
  for (const game::FamilyDesign& design : family.designs) designs.push_back(design.pattern);
  asked_ = unmeasured(designs);
  step_ = Step::predicting;
  ask({.requester = "validation_agent",
       .label = label("p"),
       .wanted = {evaluation_of_all("global", beginning_.model, asked_.size()),
                  evaluation_of_all("family", family.parameters, asked_.size())},
       .measured = asked_,
       .fidelity = scenario_.fidelity},
      outputs);
}

void FamilyStage::finish_family(runtime::Outputs& outputs) {
  wire::CalibratedFamily& family = families_.back();
  const auto& predictions = farm_.predictions();
  for (std::size_t i = 0; i < family.designs.size(); ++i) {
    family.designs[i].global_model = recorded(predictions[0][i], beginning_.model.extensions);
    family.designs[i].family_model = recorded(predictions[1][i], family.parameters.extensions);
  }
  const game::FamilyErrors errors = game::family_errors(family.designs);
  say(outputs, LogLevel::info,
      fmt::format("{}: {}, {}; errors on the seeds: global model {}, its own model {}", family.name,
                  counted(std::ssize(groups_[families_.size() - 1].seeds), "seed"), counted(family.samples, "variant"),
                  errors_in_words(errors.seeds_global), errors_in_words(errors.seeds_family)));
  for (const wire::FamilyGamut& chunk : wire::family_gamut_chunks(family.number, family.fidelity, gamut_))
    outputs.messages.push_back({"FAMILY_GAMUT", wire::write(chunk)});
  outputs.messages.push_back({"FAMILY", wire::write(family)});
  begin_family(outputs);
}

std::vector<pattern::Design> FamilyStage::chosen() const {
  std::vector<pattern::Design> designs;
  for (const wire::CalibratedFamily& family : families_) {
    for (const game::FamilyDesign& design : family.designs)
      if (!design.is_seed) designs.emplace_back(design.pattern);
  }
  return designs;
}

game::DesignValues FamilyStage::measured_values(const pattern::Pattern& pattern) const {
  const measurement::Replicates* found = measured_of(beginning_.measured, pattern);
  if (found == nullptr) return {};
  return {found->modulus_pa, found->toughness_pa};
}

void FamilyStage::conclude(const std::vector<measurement::Replicates>& measured, runtime::Outputs& outputs) {
  for (wire::CalibratedFamily& family : families_) {
    for (game::FamilyDesign& design : family.designs) {
      if (design.is_seed) continue;
      const measurement::Replicates* found = measured_of(measured, design.pattern);
      if (found == nullptr) continue;  // refused, or no specimen was valid
      if (found->modulus_count > 0) design.measured.modulus_pa = found->modulus_pa;
      if (found->toughness_count > 0) design.measured.toughness_pa = found->toughness_pa;
    }
    family.is_validated = true;
    outputs.messages.push_back({"FAMILY", wire::write(family)});
    const game::FamilyErrors errors = game::family_errors(family.designs);
    say(outputs, LogLevel::info,
        fmt::format("{}: errors on its measured variants: global model {}, its own model {}", family.name,
                    errors_in_words(errors.chosen_global), errors_in_words(errors.chosen_family)));
    for (const auto& [over_fits, what] :
         {std::pair{errors.over_fits_modulus(), "E"}, std::pair{errors.over_fits_toughness(), "T"}}) {
      if (over_fits)
        say(outputs, LogLevel::warning,
            fmt::format("{}: its own model over-fits {}: it is more accurate than the global one on the seeds, less on "
                        "the variants",
                        family.name, what));
    }
  }
}

std::string FamilyStage::phase() const {
  if (step_ == Step::grouping || families_.empty()) return "grouping the best designs into families";
  const wire::CalibratedFamily& family = families_.back();
  const std::string which = fmt::format("family {} of {}: ", family.number + 1, family.count);
  switch (step_) {
    case Step::calibrating:
      return which + "calibrating its own model";
    case Step::sampling:
      return which + "drawing variants";
    case Step::simulating:
      return which + "simulating " + counted(std::ssize(variants_), "variant");
    default:
      return which + "predicting seeds and chosen designs";
  }
}

double FamilyStage::progress() const { return fitting_ ? fitting_->calibration().progress() : -1.0; }

}  // namespace nacre::validation_agent
