#pragma once
// The dashboard's desk in a real run: journals are read, messages go over the bus.

#include "dashboard/desk.hpp"
#include "dashboard/live_feed.hpp"
#include "run_access.hpp"

namespace nacre::cli {

class RunDesk : public dashboard::Desk {
 public:
  explicit RunDesk(RunAccess run);
  dashboard::Laboratory laboratory() override;
  std::vector<dashboard::NodeReport> nodes() override { return feed_.nodes(); }
  std::vector<std::string> doubts_about(const measurement::SpecimenRecord& specimen) override;
  dashboard::Delivery enter(const measurement::SpecimenRecord& specimen) override;
  dashboard::Delivery review(const dashboard::SpecimenReview& review) override;
  dashboard::Delivery decide(const dashboard::Approval& approval) override;
  std::optional<std::string> against(const dashboard::SpecimenReview& review) override;
  std::optional<std::string> against(const dashboard::Approval& approval) override;
  void keep_grouping(const std::filesystem::path& folder, const std::vector<families::SeedFamily>& families) override;

 private:
  /// Sends it, if anybody is there to hear it.
  dashboard::Delivery hand_in(const runtime::Message& message);
  /// The run on the port that it plays on now.
  RunAccess now() const;
  RunAccess run_;
  dashboard::LiveFeed feed_;
};

}  // namespace nacre::cli
