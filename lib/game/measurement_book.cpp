#include "game/measurement_book.hpp"

#include <string_view>

#include <fmt/format.h>

#include "measurement/conditions.hpp"
#include "measurement/specimen_checks.hpp"

namespace nacre::game {

bool fulfils(const measurement::SpecimenRecord& specimen, const Order& order) {
  return specimen.test == order.test && specimen.design == order.design &&
         fulfils(specimen.conditions, order.conditions);
}

std::optional<std::string> order_mismatch(const measurement::SpecimenRecord& specimen, std::span<const Order> orders) {
  const Order* near = nullptr;
  for (const Order& order : orders) {
    if (fulfils(specimen, order)) return std::nullopt;
    tester::TestConditions as_ordered = specimen.conditions;
    as_ordered.strain_rate_per_s = order.conditions.strain_rate_per_s;
    as_ordered.thickness_mm = order.conditions.thickness_mm;
    const bool same_test = specimen.test == order.test && specimen.design == order.design;
    if (same_test && fulfils(as_ordered, order.conditions)) near = &order;
  }
  if (near == nullptr) return std::nullopt;
  return fmt::format(
      "specimen {} of {}, {} test, does not fulfil its order: pulled at {:.3g} /s and {:.3g} mm thick, ordered at "
      "{:.3g} /s and {:.3g} mm (tolerances {:.0f} and {:.0f} %)",
      specimen.specimen, specimen.design.name(), tester::to_string(specimen.test),
      specimen.conditions.strain_rate_per_s, specimen.conditions.thickness_mm, near->conditions.strain_rate_per_s,
      near->conditions.thickness_mm, 100.0 * measurement::kRateTolerance, 100.0 * measurement::kThicknessTolerance);
}

namespace {

/// The report that counts.
const Report& newest(const std::map<int, Report>& reports) { return reports.rbegin()->second; }

}  // namespace

MeasurementBook::Receipt MeasurementBook::enter(const measurement::SpecimenRecord& record, const std::string& order_id,
                                                const Amendment& amendment) {
  std::map<int, Report>& reports = entries_[record.specimen];
  const auto [position, is_new] = reports.try_emplace(amendment.revision, Report{record, order_id, amendment});
  if (!is_new) return position->second.record == record ? Receipt::repeated : Receipt::conflicting;
  return &position->second == &newest(reports) ? Receipt::accepted : Receipt::superseded;
}

std::vector<Report> MeasurementBook::reports_of(const std::string& specimen) const {
  std::vector<Report> all;
  if (const auto known = entries_.find(specimen); known != entries_.end())
    for (const auto& [revision, report] : known->second) all.push_back(report);
  return all;
}

std::map<std::string, int> MeasurementBook::revisions() const {
  std::map<std::string, int> revisions;
  for (const auto& [specimen, reports] : entries_) revisions[specimen] = newest(reports).amendment.revision;
  return revisions;
}

bool MeasurementBook::review(const std::string& specimen, const Review& review) {
  const auto [position, is_new] = reviews_.try_emplace(specimen, review);
  if (is_new) return true;
  Review& held = position->second;
  if (review.revision < held.revision) return false;
  if (review.revision == held.revision && (review.valid || !held.valid)) return false;
  held = review;
  return true;
}

std::optional<Review> MeasurementBook::review_against(const std::string& specimen, const Review& review) const {
  const auto held = reviews_.find(specimen);
  if (held == reviews_.end() || held->second.revision < review.revision) return std::nullopt;
  const bool loses_tie = review.valid && !held->second.valid;
  if (held->second.revision == review.revision && !loses_tie) return std::nullopt;
  return held->second;
}

std::optional<std::string> MeasurementBook::against_validity(const std::string& specimen) const {
  const auto known = entries_.find(specimen);
  if (known == entries_.end()) return std::nullopt;
  const auto fault = measurement::why_unusable(newest(known->second).record);
  if (!fault) return std::nullopt;
  return fmt::format("{}: cannot be valid: {} {}", specimen, fault->column, fault->reason);
}

const Review* MeasurementBook::review_of(const std::string& specimen) const {
  const auto review = reviews_.find(specimen);
  return review == reviews_.end() ? nullptr : &review->second;
}

bool MeasurementBook::valid(const Report& report) const {
  const auto review = reviews_.find(report.record.specimen);
  if (review == reviews_.end()) return report.record.valid;
  // A review may make a specimen valid again, but not one without a result or with a wrong unit.
  return review->second.valid && !measurement::why_unusable(report.record);
}

std::vector<measurement::SpecimenRecord> MeasurementBook::specimens() const {
  std::vector<measurement::SpecimenRecord> all;
  all.reserve(entries_.size());
  for (const auto& [name, reports] : entries_) {
    all.push_back(newest(reports).record);
    all.back().valid = valid(newest(reports));
    const auto review = reviews_.find(name);
    if (review != reviews_.end() && !review->second.valid) all.back().note = review->second.why;
  }
  return all;
}

std::vector<OrderProgress> MeasurementBook::progress(std::span<const Order> orders, int enough_valid) const {
  std::map<std::string_view, const Order*> by_id;
  for (const Order& order : orders) by_id.emplace(order.id, &order);
  std::vector<const Report*> unassigned;
  std::map<std::string, std::vector<const Report*>> assigned;
  for (const auto& [name, reports] : entries_) {
    const Report& report = newest(reports);
    const auto order = by_id.find(report.order_id);
    if (order != by_id.end() && fulfils(report.record, *order->second)) {
      assigned[report.order_id].push_back(&report);
    } else {
      unassigned.push_back(&report);
    }
  }
  std::vector<OrderProgress> all;
  all.reserve(orders.size());
  for (const Order& order : orders) {
    OrderProgress progress;
    const auto count = [&](const Report& report) {
      ++progress.arrived;
      progress.valid += valid(report);
    };
    for (const Report* report : assigned[order.id]) count(*report);
    for (const Report*& report : unassigned) {
      if (progress.arrived >= order.replicates) break;
      if (report == nullptr || !fulfils(report->record, order)) continue;
      count(*report);
      report = nullptr;
    }
    progress.complete = progress.arrived >= order.replicates || (enough_valid > 0 && progress.valid >= enough_valid);
    all.push_back(progress);
  }
  return all;
}

}  // namespace nacre::game
