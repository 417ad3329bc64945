#include "validation_agent/validation_core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/counted.hpp"
#include "game/reference_tables.hpp"
#include "game/starting_point.hpp"

namespace nacre::validation_agent {

using runtime::LogLevel;

ValidationCore::ValidationCore(const game::Scenario& scenario, StartingPoint start)
    : scenario_(scenario), start_(std::move(start)), desk_(scenario), model_(start_.model) {}

runtime::Outputs ValidationCore::step(const runtime::Input& input) {
  outputs_ = {};
  if (const auto* message = std::get_if<runtime::Message>(&input)) accept_message(*message);
  if (const auto* work = std::get_if<runtime::WorkDone>(&input)) accept_work(*work);
  return std::exchange(outputs_, {});
}

void ValidationCore::refuse(const std::string& why) {
  say(LogLevel::warning, why);
  outputs_.refusal = why;
}

std::vector<runtime::Message> ValidationCore::open(std::string_view channel) const {
  std::vector<runtime::Message> messages;
  if (phase_ != Phase::measuring && round_ > 0) return messages;
  if (channel == "TEST_ORDER")
    for (const game::Order& order : desk_.open(book_))
      messages.push_back({"TEST_ORDER", wire::write(message_of(order))});
  const auto proposal = proposals_.find(round_ - 1);
  if (channel == "PROPOSAL" && desk_.awaiting_approval() > 0 && proposal != proposals_.end())
    messages.push_back({"PROPOSAL", wire::write(proposal->second)});
  return messages;
}

void ValidationCore::accept_message(const runtime::Message& message) {
  using Accept = void (ValidationCore::*)(const std::string&);
  static const std::map<std::string, Accept> kAccept = {
      {"RUN", &ValidationCore::accept_run},
      {"SIMULATED", &ValidationCore::accept_response},
      {"GAMUT", &ValidationCore::accept_gamut},
      {"PROPOSAL", &ValidationCore::accept_proposal},
      {"DIAGNOSIS", &ValidationCore::accept_diagnosis},
      {"MEASUREMENT", &ValidationCore::accept_measurement},
      {"REVIEW", &ValidationCore::accept_review},
      {"APPROVAL", &ValidationCore::accept_approval},
      {"WITHDRAWAL", &ValidationCore::accept_withdrawal},
  };
  if (const auto accept = kAccept.find(message.channel); accept != kAccept.end())
    (this->*accept->second)(message.payload);
}

void ValidationCore::accept_run(const std::string& payload) {
  const auto run = wire::read<wire::RunStart>(payload);
  if (!run) return say(LogLevel::warning, "a RUN is ignored: " + run.error().message);
  if (phase_ != Phase::waiting_for_run) return;
  if (static_cast<std::uint64_t>(run->seed) != scenario_.seed) {
    return say(LogLevel::error,
               fmt::format("RUN announces seed {}, this node's scenario has {}: both must come from the same run",
                           run->seed, scenario_.seed));
  }
  begin_round(0);
}

void ValidationCore::accept_response(const std::string& payload) {
  auto part = wire::read<wire::SimulateResult>(payload);
  if (!part) return say(LogLevel::warning, "a SIMULATED is ignored: " + part.error().message);
  if (phase_ == Phase::working_out_families) {
    families_->accept_response(*std::move(part), outputs_);
    return measure_families_when_chosen();
  }
  if (!farm_.take(*std::move(part))) return;
  if (phase_ == Phase::predicting_trial) {
    finish_trial_predictions();
  } else if (phase_ == Phase::predicting) {
    finish_out_of_sample(farm_.predictions().front());
  } else if (phase_ == Phase::calibrating) {
    fitting_->tell(farm_.predictions());
    calibrate_on();
  }
}

void ValidationCore::accept_work(const runtime::WorkDone& work) {
  if (phase_ != Phase::working_out_families)
    return say(LogLevel::warning, "the result of " + work.id + " is ignored: it is not awaited");
  families_->accept_work(work, outputs_);
  measure_families_when_chosen();
}

void ValidationCore::accept_gamut(const std::string& payload) {
  auto chunk = wire::read<wire::GamutChunk>(payload);
  if (!chunk) return say(LogLevel::warning, "a GAMUT is ignored: " + chunk.error().message);
  // Of a later round, too: after a lost journal the others offer again what belongs to rounds still to come.
  if (chunk->fidelity != scenario_.fidelity || chunk->round < round_) return;
  gamuts_.add(*std::move(chunk));
  close_round_when_proposed();
}

void ValidationCore::accept_proposal(const std::string& payload) {
  auto proposal = wire::read<wire::Proposal>(payload);
  if (!proposal) return say(LogLevel::warning, "a PROPOSAL is ignored: " + proposal.error().message);
  if (proposal->fidelity != scenario_.fidelity || proposal->round < round_) return;
  proposals_.emplace(proposal->round, *std::move(proposal));
  close_round_when_proposed();
}

void ValidationCore::accept_diagnosis(const std::string& payload) {
  const auto diagnosis = wire::read<wire::Diagnosis>(payload);
  if (!diagnosis) return say(LogLevel::warning, "a DIAGNOSIS is ignored: " + diagnosis.error().message);
  if (diagnosis->round < round_) return;
  const bool is_awaited = phase_ == Phase::diagnosing && diagnosis->round == round_;
  if (is_awaited) return take_diagnosis(*diagnosis);
  if (!diagnosis_ || diagnosis_->round < diagnosis->round) early_diagnoses_.emplace(diagnosis->round, *diagnosis);
}

void ValidationCore::take_diagnosis(const wire::Diagnosis& diagnosis) {
  diagnosis_ = diagnosis;
  say(LogLevel::info, fmt::format("round {}: diagnosis {}: {}", round_, diagnosis.verdict, diagnosis.summary));
  weigh(diagnosis);
}

namespace {

std::string conflict_in_words(const wire::Measurement& measured) {
  const std::string revision = measured.revision == 0 ? "it" : fmt::format("revision {} of it", measured.revision);
  return fmt::format("specimen {} is refused: {} was reported before with other content", measured.record.specimen,
                     revision);
}

}  // namespace

void ValidationCore::accept_measurement(const std::string& payload) {
  const auto measured = wire::read<wire::Measurement>(payload);
  if (!measured) return say(LogLevel::warning, "a MEASUREMENT is ignored: " + measured.error().message);
  const measurement::SpecimenRecord& record = measured->record;
  if (measured->fidelity != scenario_.fidelity) {
    return refuse(fmt::format("specimen {} is refused: measured at fidelity {}, the game is played at {}",
                              record.specimen, tester::to_string(measured->fidelity),
                              tester::to_string(scenario_.fidelity)));
  }
  if (measured->round > round_) {  // this agent's journal was lost, and the order is yet to be given again
    early_measurements_[measured->round].push_back(payload);
    return say(LogLevel::info, fmt::format("specimen {} waits for round {}", record.specimen, measured->round));
  }
  switch (book_.enter(record, measured->order_id, {measured->revision, measured->by, measured->why})) {
    case game::MeasurementBook::Receipt::repeated:
      return;
    case game::MeasurementBook::Receipt::superseded:
      return say(LogLevel::info, fmt::format("specimen {}: revision {} is kept, a later one counts", record.specimen,
                                             measured->revision));
    case game::MeasurementBook::Receipt::conflicting:
      return refuse(conflict_in_words(*measured));
    case game::MeasurementBook::Receipt::accepted:
      break;
  }
  if (measured->revision > 0)
    say(LogLevel::info, fmt::format("{} amends specimen {} (revision {}): {}", measured->by, record.specimen,
                                    measured->revision, measured->why));
  const std::string what =
      fmt::format("specimen {} of {}, {} test", record.specimen, record.design.name(), tester::to_string(record.test));
  if (record.valid) {
    say(LogLevel::info, what);
  } else {
    say(LogLevel::warning, fmt::format("{}: not valid ({}), not used", what, record.note));
  }
  if (auto mislabelled = desk_.against_label(record, measured->order_id))
    say(LogLevel::warning, *std::move(mislabelled));
  if (phase_ == Phase::measuring) measure_on();
}

void ValidationCore::accept_review(const std::string& payload) {
  const auto review = wire::read<wire::Review>(payload);
  if (!review) return say(LogLevel::warning, "a REVIEW is ignored: " + review.error().message);
  if (!book_.review(review->specimen, {review->revision, review->valid, review->why})) return;
  say(LogLevel::info, fmt::format("{} says that specimen {} is {}valid: {}", review->by, review->specimen,
                                  review->valid ? "" : "not ", review->why));
  if (phase_ == Phase::measuring) measure_on();
}

void ValidationCore::accept_approval(const std::string& payload) {
  const auto approval = wire::read<wire::Approval>(payload);
  if (!approval) return say(LogLevel::warning, "an APPROVAL is ignored: " + approval.error().message);
  if (approval->round < 0) return add_own_design(*approval);
  const pattern::Design& design = approval->design;
  if (const auto proposal = proposals_.find(approval->round); proposal != proposals_.end()) {
    const auto& designs = proposal->second.designs;
    if (std::none_of(designs.begin(), designs.end(), [&](const auto& each) { return each.design == design; })) {
      return refuse(
          fmt::format("an APPROVAL is ignored: {} is not in the proposal of round {}", design.name(), approval->round));
    }
  }
  if (families_ && approval->round == round_) {
    const std::vector<pattern::Design> chosen = families_->chosen();
    if (std::find(chosen.begin(), chosen.end(), design) == chosen.end())
      return refuse(fmt::format("an APPROVAL is ignored: {} is not chosen of any family", design.name()));
  }
  const auto orders = desk_.take_approval(approval->round, design, {approval->approved, approval->by, approval->why});
  if (!orders) return refuse("an APPROVAL changes nothing: " + orders.error().message);
  say(LogLevel::info, fmt::format("{} {} {}: {}", approval->by, approval->approved ? "approves" : "refuses",
                                  design.name(), approval->why));
  send_orders(*orders);
  if (phase_ == Phase::measuring) measure_on();
}

void ValidationCore::accept_withdrawal(const std::string& payload) {
  const auto said = wire::read<wire::Withdrawal>(payload);
  if (!said) return say(LogLevel::warning, "a WITHDRAWAL is ignored: " + said.error().message);
  const bool is_measured = phase_ != Phase::measuring && phase_ != Phase::predicting_trial;
  const auto orders = desk_.take_withdrawal(said->order_id, {said->revision, said->withdrawn, said->by, said->why},
                                            is_measured ? round_ : round_ - 1);
  if (!orders) return refuse("a WITHDRAWAL changes nothing: " + orders.error().message);
  say(LogLevel::info, fmt::format("{} {} order {}: {}", said->by, said->withdrawn ? "withdraws" : "gives again",
                                  said->order_id, said->why));
  send_orders(*orders);
  if (phase_ == Phase::measuring) measure_on();
}

void ValidationCore::add_own_design(const wire::Approval& approval) {
  if (phase_ == Phase::finished)
    return refuse(fmt::format("an APPROVAL changes nothing: no round follows in which {} could be measured",
                              approval.design.name()));
  const auto orders = desk_.add_own(approval.design, phase_ == Phase::measuring);
  if (!orders) return refuse("an APPROVAL changes nothing: " + orders.error().message);
  say(LogLevel::info, fmt::format("{} adds {}: {}", approval.by, approval.design.name(), approval.why));
  send_orders(*orders);
}

namespace {

/// What people have to do comes first; where nothing else is left, it is all.
std::string phase_of_measuring(int complete, int all, int awaiting_approval) {
  std::string phase;
  if (awaiting_approval > 0) {
    phase = fmt::format("waits for you: {} to approve", counted(awaiting_approval, "design"));
    if (complete == all) return phase;
    phase += "; ";
  }
  return phase + fmt::format("measuring, {} of {} complete", complete, counted(all, "order"));
}

}  // namespace

runtime::Status ValidationCore::status() const {
  runtime::Status status{.phase = "", .round = round_, .progress = -1.0, .finished = phase_ == Phase::finished};
  switch (phase_) {
    case Phase::waiting_for_run:
      status.phase = "waiting for all nodes";
      break;
    case Phase::predicting_trial:
      status.phase = "predicting the proposed designs with the extension on trial";
      break;
    case Phase::measuring: {
      const auto [complete, all] = desk_.completed(book_);
      status.phase = phase_of_measuring(complete, all, desk_.awaiting_approval());
      status.progress = all == 0 ? 1.0 : static_cast<double>(complete) / all;
      break;
    }
    case Phase::predicting:
      status.phase = "comparing predictions with measurements";
      break;
    case Phase::calibrating:
      status.phase = extending_ ? "calibrating the extended model" : "calibrating";
      status.progress = fitting_->calibration().progress();
      break;
    case Phase::diagnosing:
      status.phase = "waiting for the diagnosis";
      break;
    case Phase::waiting_for_proposal:
      status.phase = "waiting for the search and its proposal";
      break;
    case Phase::working_out_families:
      status.phase = families_->phase();
      status.progress = families_->progress();
      break;
    case Phase::finished:
      status.phase = "the game is over";
      break;
  }
  return status;
}

std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario) {
  StartingPoint start;
  if (!scenario.base_materials_file.empty())
    start.base_materials = game::read_base_materials(scenario.base_materials_file);
  if (!scenario.benchmark_file.empty()) start.benchmark = game::read_benchmark_line(scenario.benchmark_file);
  material::StartingModel model = game::starting_model(scenario);
  start.ranges = model.ranges;
  start.model = std::move(model.parameters);
  start.floor = scenario.discretisation_floor_file.empty()
                    ? sysid::DiscretisationFloor::none()
                    : sysid::read_discretisation_floor(scenario.discretisation_floor_file, scenario.fidelity);
  return std::make_unique<ValidationCore>(scenario, std::move(start));
}

}  // namespace nacre::validation_agent
