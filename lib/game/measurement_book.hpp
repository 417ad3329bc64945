#pragma once
// Every reported specimen, whoever tested it, and what is still missing. All results depend on the set of specimens
// alone, never on their order.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/rounds.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::game {

/// A person's review of one specimen's validity; the highest revision wins, "not valid" wins a tie.
struct Review {
  int revision = 0;
  bool valid = true;
  std::string why;
  std::string by = {};  ///< without effect on the result
};

/// Which report of a specimen a record is: the first one, or an amendment of the one before.
struct Amendment {
  int revision = 0;  ///< 0: the first report
  std::string by, why;
};

/// A report of a specimen.
struct Report {
  measurement::SpecimenRecord record;
  std::string order_id;  ///< empty when nacre did not order the specimen, or when the laboratory does not know
  Amendment amendment;
};

/// Progress of an order.
struct OrderProgress {
  int arrived = 0;  ///< specimens, valid or not
  int valid = 0;
  bool complete = false;
};

/// Whether a specimen fulfils an order: its design in its test, under conditions within the order's tolerances.
bool fulfils(const measurement::SpecimenRecord& specimen, const Order& order);

/// A sentence about a specimen of an ordered design in the ordered test that fulfils no order because it was pulled at
/// another rate or has another thickness (another orientation is another order); nothing for others. Such a specimen
/// leaves its order open.
std::optional<std::string> order_mismatch(const measurement::SpecimenRecord& specimen, std::span<const Order> orders);

class MeasurementBook {
 public:
  enum class Receipt {
    accepted,
    superseded,   ///< an amendment of it counts already: kept, nothing else changes
    repeated,     ///< the same revision of the specimen with the same content: nothing changes
    conflicting,  ///< the same revision of the specimen with other content: refused
  };

  /// Of a specimen's reports that with the highest revision counts. They may come in any order.
  Receipt enter(const measurement::SpecimenRecord& record, const std::string& order_id,
                const Amendment& amendment = {});

  /// All reports of a specimen, the one that counts last; empty of an unknown one. Validity as reported.
  std::vector<Report> reports_of(const std::string& specimen) const;
  /// The revision that counts of each specimen.
  std::map<std::string, int> revisions() const;

  /// Reviews may come before the measurement. Returns whether the specimen's validity may have changed.
  bool review(const std::string& specimen, const Review& review);

  /// The review that overrules this one: of a higher revision, or "not valid" of the same. Nothing where this one may
  /// count.
  std::optional<Review> review_against(const std::string& specimen, const Review& review) const;

  /// Why no review can make the specimen valid, as a sentence; nothing where one can, or the specimen is unknown.
  std::optional<std::string> against_validity(const std::string& specimen) const;

  /// The review that counts; nothing where there is none.
  const Review* review_of(const std::string& specimen) const;
  /// All specimens, sorted by name, with validity as reviewed.
  std::vector<measurement::SpecimenRecord> specimens() const;

  /// Progress of each order: complete when all replicates have arrived, or `enough_valid` > 0 valid ones. Specimens
  /// that carry an order's id and fulfil it count for it; others, also those of swapped labels, count for the orders,
  /// in the given sequence, that they fulfil.
  std::vector<OrderProgress> progress(std::span<const Order> orders, int enough_valid) const;

  int size() const { return entries_.size(); }

 private:
  bool valid(const Report& report) const;

  std::map<std::string, std::map<int, Report>> entries_;  // by specimen and revision
  std::map<std::string, Review> reviews_;                 // by specimen
};

}  // namespace nacre::game
