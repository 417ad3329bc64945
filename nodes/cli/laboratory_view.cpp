#include "laboratory_view.hpp"

#include <algorithm>
#include <map>

#include "base/result.hpp"
#include "game/budget.hpp"
#include "output.hpp"
#include "specimen_messages.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

game::Order order_of(const wire::TestOrder& message) {
  const auto reason = game::order_reason_from_string(message.reason);
  if (!reason) throw InputError::format("order {}: {}", message.order_id, reason.error().message);
  return {.id = message.order_id,
          .round = message.round,
          .design = message.design,
          .test = message.test,
          .conditions = message.conditions,
          .loading = message.loading,
          .replicates = message.replicates,
          .batch = message.batch,
          .reason = *reason};
}

template <class Domain, class Take>
auto each(const Take& take) {
  return [take](const std::string& payload) {
    if (const auto message = wire::read<Domain>(payload)) take(*message);
  };
}

void take_review(const std::string& payload, game::MeasurementBook& book) {
  if (const auto review = wire::read<wire::Review>(payload))
    book.review(review->specimen, {review->revision, review->valid, review->why, review->by});
}

void take_approval(const std::string& payload, game::LaboratoryFacts& facts) {
  const auto approval = wire::read<wire::Approval>(payload);
  if (!approval) return;
  facts.approvals.push_back({approval->round, approval->design, approval->approved, approval->by, approval->why});
}

}  // namespace

LaboratoryReader::LaboratoryReader(RunAccess run) : run_(std::move(run)), journal_(run_.folder, "validation_agent") {}

void LaboratoryReader::read_journal(const std::function<void(const std::string& payload)>& measured) {
  if (journal_.begins_anew()) {
    view_ = nullptr;
    known_ = {};
    proposals_.clear();
    given_again_.clear();
    last_round_ = -1;
  }
  game::LaboratoryFacts& facts = known_.facts;
  const auto take_proposal = [&](const wire::Proposal& proposal) {
    for (const auto& design : proposal.designs) facts.proposed.push_back({proposal.round, design.design});
    proposals_[proposal.round] = proposal;
  };
  const auto take_family = [&](const wire::CalibratedFamily& family) {
    for (const game::FamilyDesign& design : family.designs)
      if (!design.is_seed) facts.proposed.push_back({family.round, design.pattern});
  };
  const auto is_ordered = [&](const std::string& id) {
    return std::ranges::find(facts.orders, id, &game::Order::id) != facts.orders.end();
  };
  // Given again is what the agent sends again: of a round that is measured it does not.
  const auto take_order = [&](const wire::TestOrder& order) {
    if (!is_ordered(order.order_id)) return facts.orders.push_back(order_of(order));
    if (const auto said = given_again_.extract(order.order_id)) facts.withdrawals.enter(order.order_id, said.mapped());
  };
  const auto take_withdrawal = [&](const wire::Withdrawal& said) {
    const game::Withdrawal word{said.revision, said.withdrawn, said.by, said.why};
    if (!said.withdrawn) {
      given_again_.insert_or_assign(said.order_id, word);
    } else if (is_ordered(said.order_id)) {
      facts.withdrawals.enter(said.order_id, word);
    }
  };
  const auto take_measurement = [&](const wire::Measurement& one) {
    if (one.fidelity == run_.scenario.fidelity)
      facts.book.enter(with_history_of_note(one.record), one.order_id, {one.revision, one.by, one.why});
  };
  const auto take_model = [&](const wire::AdoptedModel& model) { known_.model = model.parameters; };
  const auto take_round = [&](const wire::RoundSummary& round) {
    last_round_ = std::max(last_round_, round.round);
    known_.is_over = known_.is_over || round.last;
  };
  const auto noted = [this](auto take) {
    return [this, take](const std::string& payload) {
      view_ = nullptr;
      take(payload);
    };
  };
  journal_.read({{"PROPOSAL", noted(each<wire::Proposal>(take_proposal))},
                 {"MEASUREMENT", noted([&](const std::string& payload) {
                    each<wire::Measurement>(take_measurement)(payload);
                    if (measured) measured(payload);
                  })},
                 {"REVIEW", noted([&](const std::string& payload) { take_review(payload, facts.book); })},
                 {"APPROVAL", noted([&](const std::string& payload) { take_approval(payload, facts); })},
                 {"WITHDRAWAL", noted(each<wire::Withdrawal>(take_withdrawal))}},
                {{"TEST_ORDER", noted(each<wire::TestOrder>(take_order))},
                 {"FAMILY", noted(each<wire::CalibratedFamily>(take_family))},
                 {"PARAMETERS", noted(each<wire::AdoptedModel>(take_model))},
                 {"ROUND", noted(each<wire::RoundSummary>(take_round))}});
}

LaboratoryView LaboratoryReader::make_view() const {
  LaboratoryView view = known_;
  game::LaboratoryFacts& facts = view.facts;
  facts.replicates = game::within_budget(run_.scenario, 1).validation.replicates;
  facts.enough_valid = run_.scenario.validation.enough_valid;
  view.round = std::max(1, last_round_ + 1);
  // Later ones may be there: an agent that begins anew without its journal is offered all of them again.
  if (const auto later = proposals_.upper_bound(last_round_); later != proposals_.begin())
    view.open_proposal = std::prev(later)->second;
  for (const auto& [specimen, by] : printed_) facts.printed.push_back(specimen);
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  const auto printed = game::printed_for(facts.orders, facts.printed);
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    view.orders.push_back({.order = facts.orders[i],
                           .printed = printed[i],
                           .arrived = progress[i].arrived,
                           .valid = progress[i].valid,
                           .complete = progress[i].complete,
                           .withdrawn = facts.withdrawals.is_withdrawn(facts.orders[i].id)});
  }
  return view;
}

std::shared_ptr<const LaboratoryView> LaboratoryReader::view(
    const std::function<void(const std::string& payload)>& measured) {
  read_journal(measured);
  std::vector<PrintedRow> printed = read_printed(run_);
  if (view_ && printed == printed_) return view_;
  printed_ = std::move(printed);
  return view_ = std::make_shared<const LaboratoryView>(make_view());
}

std::optional<dashboard::RoundPrice> price_of_round(const RunAccess& run, const LaboratoryView& view) {
  if (view.is_over || view.round > run.scenario.rounds) return std::nullopt;
  return dashboard::price_of_round(run.scenario, view.facts, view.round);
}

LaboratoryView view_laboratory(const RunAccess& run, const std::function<void(const std::string& payload)>& measured) {
  return *LaboratoryReader(run).view(measured);
}

}  // namespace nacre::cli
