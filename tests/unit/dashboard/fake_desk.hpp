#pragma once
// A desk without a run behind it: it keeps what is entered.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"

namespace nacre::dashboard {

class FakeDesk : public Desk {
 public:
  Laboratory laboratory() override { return picture; }
  std::vector<NodeReport> nodes() override { return reports; }
  std::vector<std::string> doubts_about(const measurement::SpecimenRecord&) override { return doubts; }
  Delivery enter(const measurement::SpecimenRecord& specimen) override { return specimens.push_back(specimen), answer; }
  Delivery review(const SpecimenReview& review) override { return reviews.push_back(review), answer; }
  std::optional<std::string> against(const SpecimenReview&) override { return reason_against; }
  std::optional<std::string> against(const Approval&) override { return reason_against; }
  Delivery decide(const Approval& approval) override { return approvals.push_back(approval), answer; }

  void keep_grouping(const std::filesystem::path&, const std::vector<families::SeedFamily>& families) override {
    groupings.push_back(families);
  }

  Laboratory picture;
  std::vector<NodeReport> reports;
  Delivery answer = Delivery::accepted;
  std::optional<std::string> reason_against;
  std::vector<std::string> doubts;
  std::vector<measurement::SpecimenRecord> specimens;
  std::vector<SpecimenReview> reviews;
  std::vector<Approval> approvals;
  std::vector<std::vector<families::SeedFamily>> groupings;
};

}  // namespace nacre::dashboard
