#pragma once
// Every specimen that was ever reported, whoever tested it, and what is still missing. What the book says depends on
// the set of entries alone, never on their order.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/rounds.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::game {

/// A person's judgement on one specimen; the highest revision wins, "not valid" wins a tie.
struct Review {
  int revision = 0;
  bool valid = true;
  std::string why;
  std::string by = {};  ///< not part of what decides
};

/// How far an order has got.
struct OrderProgress {
  int arrived = 0;  ///< specimens, valid or not
  int valid = 0;
  bool complete = false;
};

/// Whether a specimen is what an order asked for: its design in its test, under conditions that answer the order's.
bool answers(const measurement::SpecimenRecord& specimen, const Order& order);

/// A sentence about a specimen of an ordered design in the ordered test that answers no order because it was pulled at
/// another rate or is of another thickness (orientation is a question of its own); nothing for others. Such a
/// specimen leaves its order open.
std::optional<std::string> beside_orders(const measurement::SpecimenRecord& specimen, std::span<const Order> orders);

class MeasurementBook {
 public:
  enum class Receipt {
    accepted,
    repeated,     ///< the same specimen with the same content: nothing changes
    conflicting,  ///< the same specimen with other content: refused
  };

  /// `order_id` is empty when nacre did not order the specimen, or when the laboratory does not know.
  Receipt enter(const measurement::SpecimenRecord& record, const std::string& order_id);

  /// Reviews may come before the measurement they judge. Returns whether the specimen's validity may have changed.
  bool review(const std::string& specimen, const Review& review);

  /// The judgement that stands against this one: of a higher revision, or "not valid" of the same. Nothing where this
  /// one may stand.
  std::optional<Review> review_against(const std::string& specimen, const Review& review) const;

  /// Why no review makes the specimen a valid one, as a sentence; nothing where one may, or it is not known.
  std::optional<std::string> against_validity(const std::string& specimen) const;

  /// The review that stands; nothing where nobody said anything.
  const Review* review_of(const std::string& specimen) const;
  /// All specimens, sorted by name, with validity as reviewed.
  std::vector<measurement::SpecimenRecord> specimens() const;

  /// Progress of each order: complete when all replicates have arrived, or `enough_valid` > 0 valid ones. Specimens
  /// that carry an order's id and answer it count for it; others, also those of swapped labels, count for the orders,
  /// in the given sequence, that asked the same question.
  std::vector<OrderProgress> progress(std::span<const Order> orders, int enough_valid) const;

  int size() const { return static_cast<int>(entries_.size()); }

 private:
  struct Reported {
    measurement::SpecimenRecord record;
    std::string order_id;
  };
  bool valid(const Reported& reported) const;

  std::map<std::string, Reported> entries_;  // by specimen
  std::map<std::string, Review> reviews_;    // by specimen
};

}  // namespace nacre::game
