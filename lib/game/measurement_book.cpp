#include "game/measurement_book.hpp"

#include <set>

namespace nacre::game {

MeasurementBook::Entry MeasurementBook::enter(const measurement::SpecimenRecord& record, const std::string& order_id) {
  const auto [position, is_new] = entries_.try_emplace(record.specimen, Reported{record, order_id});
  if (is_new) return Entry::accepted;
  return position->second.record == record ? Entry::repeated : Entry::conflicting;
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

const Review* MeasurementBook::review_of(const std::string& specimen) const {
  const auto review = reviews_.find(specimen);
  return review == reviews_.end() ? nullptr : &review->second;
}

bool MeasurementBook::valid(const Reported& reported) const {
  const auto review = reviews_.find(reported.record.specimen);
  if (review == reviews_.end()) return reported.record.valid;
  // A person may bring a specimen back, but neither one that says nothing nor a number of another unit.
  return review->second.valid && !measurement::why_unusable(reported.record);
}

std::vector<measurement::SpecimenRecord> MeasurementBook::specimens() const {
  std::vector<measurement::SpecimenRecord> all;
  all.reserve(entries_.size());
  for (const auto& [name, reported] : entries_) {
    all.push_back(reported.record);
    all.back().valid = valid(reported);
    const auto review = reviews_.find(name);
    if (review != reviews_.end() && !review->second.valid) all.back().note = review->second.why;
  }
  return all;
}

std::vector<OrderProgress> MeasurementBook::progress(std::span<const Order> orders, int enough_valid) const {
  std::set<std::string, std::less<>> ids;
  for (const Order& order : orders) ids.insert(order.id);
  std::vector<const Reported*> unassigned;
  std::map<std::string, std::vector<const Reported*>> assigned;
  for (const auto& [name, reported] : entries_) {
    if (ids.contains(reported.order_id)) {
      assigned[reported.order_id].push_back(&reported);
    } else {
      unassigned.push_back(&reported);
    }
  }
  std::vector<OrderProgress> all;
  all.reserve(orders.size());
  for (const Order& order : orders) {
    OrderProgress progress;
    const auto count = [&](const Reported& reported) {
      ++progress.arrived;
      progress.valid += valid(reported);
    };
    for (const Reported* reported : assigned[order.id]) count(*reported);
    for (const Reported*& reported : unassigned) {
      if (progress.arrived >= order.replicates) break;
      if (reported == nullptr || reported->record.test != order.test || !(reported->record.design == order.design) ||
          !answers(reported->record.conditions, order.conditions)) {
        continue;
      }
      count(*reported);
      reported = nullptr;
    }
    progress.complete = progress.arrived >= order.replicates || (enough_valid > 0 && progress.valid >= enough_valid);
    all.push_back(progress);
  }
  return all;
}

}  // namespace nacre::game
