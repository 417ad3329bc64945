#pragma once
// The laboratory's work.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"
#include "dashboard/json_parts.hpp"
#include "fabricate/specimen.hpp"

namespace nacre::dashboard {

/// What a specimen gave, among the fields of its row: E or T of its test from the curve where no value was entered.
void value_fields(auto& field, const measurement::SpecimenRecord& record) {
  using tester::TestKind;
  field("modulus_pa", record.test == TestKind::modulus ? measurement::modulus_of(record) : record.modulus_pa);
  field("toughness_pa", record.test == TestKind::toughness ? measurement::toughness_of(record) : record.toughness_pa);
}

/// What was reported of a specimen before it was amended.
struct EarlierReportRow {
  static constexpr std::string_view kPageName = "EarlierReport";
  game::Report report;

  static void fields(auto& field, auto& m) {
    const measurement::SpecimenRecord& r = m.report.record;
    field("revision", m.report.amendment.revision);
    field("design", r.design);
    field("test", r.test);
    condition_fields(field, r.conditions);
    value_fields(field, r);
    field("by", m.report.amendment.by);
    field("why", m.report.amendment.why);
  }
};

struct LaboratorySpecimenRow {
  static constexpr std::string_view kPageName = "LaboratorySpecimen";
  measurement::SpecimenRecord record;
  game::Review review;        ///< the last one; by nobody: there is none
  game::Amendment amendment;  ///< the last one
  std::vector<EarlierReportRow> earlier = {};

  static void fields(auto& field, auto& m) {
    const measurement::SpecimenRecord& r = m.record;
    field("specimen", r.specimen);
    field("design", r.design);
    field("test", r.test);
    condition_fields(field, r.conditions);
    field("batch", r.batch);
    value_fields(field, r);
    field("points", r.curve.size());
    field("valid", r.valid);
    field("note", r.note);
    field("by", m.review.by);
    field("why", m.review.why);
    field("amended_by", m.amendment.by);
    field("amended_why", m.amendment.why);
    field("earlier", m.earlier);
  }
};

struct OrderRow {
  static constexpr std::string_view kPageName = "Order";
  game::Order order;
  game::OrderProgress progress;
  game::Withdrawal withdrawal;  ///< that counts; by nobody: there is none

  static void fields(auto& field, auto& m) {
    const game::Order& order = m.order;
    const fabricate::SpecimenGeometry nominal = fabricate::geometry_of(fabricate::specimen_kind(order.test));
    field("order", order.id);
    field("round", order.round);
    field("design", order.design);
    field("test", order.test);
    condition_fields(field, order.conditions);
    field("width_mm", nominal.test_width_mm);
    field("gauge_mm", nominal.gauge_mm);
    field("loading", order.loading);
    field("batch", order.batch);
    field("replicates", order.replicates);
    field("arrived", m.progress.arrived);
    field("valid", m.progress.valid);
    field("complete", m.progress.complete);
    field("reason", game::to_string(order.reason));
    field("withdrawn", !m.withdrawal.by.empty() && m.withdrawal.withdrawn);
    field("by", m.withdrawal.by);
    field("why", m.withdrawal.why);
  }
};

struct PrintedRow {
  static constexpr std::string_view kPageName = "Printed";
  game::PrintedSpecimen printed;

  static void fields(auto& field, auto& m) {
    field("label", m.printed.label);
    field("design", m.printed.design);
    field("test", m.printed.test);
    field("orientation_deg", m.printed.orientation_deg);
    field("order", m.printed.order_id);
  }
};

struct OutlierRow {
  static constexpr std::string_view kPageName = "ProposedOutlier";
  const measurement::ProposedOutlier* outlier = &nothing<measurement::ProposedOutlier>();

  static void fields(auto& field, auto& m) {
    std::vector<std::string> reasons;
    for (const auto& reason : m.outlier->reasons) reasons.push_back(reason.text);
    field("specimen", m.outlier->specimen);
    field("reasons", reasons);
  }
};

/// Replicates. Means are null where no specimen is valid, scatters also where only one is.
struct GroupRow {
  static constexpr std::string_view kPageName = "Group";
  measurement::ReplicateGroup group;

  static void fields(auto& field, auto& m) {
    const measurement::ReplicateGroup& g = m.group;
    field("design", g.design);
    field("test", g.test);
    condition_fields(field, g.conditions);
    field("state", to_string(g.state));
    field("tested", g.tested);
    field("valid", g.valid);
    field("proposed_outliers", rows_of<OutlierRow>(g.proposed));
    field("wanted", g.wanted);
    field("mean_pa", g.mean_pa);
    field("scatter", g.scatter);
    field("mean_without_pa", g.mean_without_pa);
    field("scatter_without", g.scatter_without);
    field("representative", g.representative);
  }
};

struct OpenProposalRow {
  static constexpr std::string_view kPageName = "OpenProposal";
  wire::Proposal proposal;

  static void fields(auto& field, auto& m) {
    field("round", m.proposal.round);
    field("simulations", m.proposal.simulations);
    field("designs", m.proposal.designs);
  }
};

/// The newest proposal, what the round costs, designs with their state, orders, what is printed, specimens, groups of
/// replicates with proposed outliers.
struct LaboratoryRow {
  static constexpr std::string_view kPageName = "Laboratory";
  std::optional<OpenProposalRow> proposal;
  std::optional<RoundPrice> price;
  std::vector<game::DesignState> designs;
  std::vector<OrderRow> orders;
  std::vector<PrintedRow> printed;
  std::vector<LaboratorySpecimenRow> specimens;
  std::vector<GroupRow> groups;

  static void fields(auto& field, auto& m) {
    field("proposal", m.proposal);
    field("price", m.price);
    field("designs", m.designs);
    field("orders", m.orders);
    field("printed", m.printed);
    field("specimens", m.specimens);
    field("groups", m.groups);
  }
};
LaboratoryRow laboratory_row(const Laboratory& laboratory);

}  // namespace nacre::dashboard
