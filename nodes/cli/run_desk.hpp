#pragma once
// The dashboard's desk in a real run: journals are read, messages go over the bus.

#include "dashboard/desk.hpp"
#include "dashboard/live_feed.hpp"
#include "laboratory_view.hpp"
#include "run_access.hpp"

namespace nacre::cli {

class RunDesk : public dashboard::Desk {
 public:
  explicit RunDesk(RunAccess run);
  std::shared_ptr<const dashboard::Laboratory> laboratory() override;
  std::vector<dashboard::NodeReport> nodes() override { return feed_.nodes(); }
  std::optional<dashboard::LiveSearch::Progress> search() override { return feed_.search().progress(); }
  run::Gamut searched(int round) override { return feed_.search().gamut(round); }
  std::vector<std::string> doubts_about(const measurement::SpecimenRecord& specimen) override;
  std::vector<dashboard::SpecimenDoubt> doubts_of(std::span<const measurement::SpecimenRecord> specimens) override;
  dashboard::Answer enter(const measurement::SpecimenRecord& specimen) override;
  std::vector<dashboard::Answer> enter_all(std::span<const measurement::SpecimenRecord> specimens) override;
  void keep_import(const std::filesystem::path& folder, const std::string& name) override;
  dashboard::Answer review(const dashboard::SpecimenReview& review) override;
  dashboard::Answer decide(const dashboard::Approval& approval) override;
  Result<measurement::SpecimenRecord> amended(const dashboard::Amendment& amendment) override;
  dashboard::Answer amend(const measurement::SpecimenRecord& specimen, const std::string& by,
                          const std::string& why) override;
  dashboard::Answer withdraw(const dashboard::Withdrawal& withdrawal) override;
  std::optional<std::string> against(const dashboard::SpecimenReview& review) override;
  std::optional<std::string> against(const dashboard::Approval& approval) override;
  std::optional<std::string> against(const dashboard::Withdrawal& withdrawal) override;
  void keep_grouping(const std::filesystem::path& folder, const std::vector<families::SeedFamily>& families) override;
  dashboard::Answer print(const dashboard::PrintedTray& tray, const std::filesystem::path& build_sheet) override;
  dashboard::Answer keep_note(const dashboard::NoteFolder& folder, const dashboard::Note& note) override;

 private:
  dashboard::Answer enter(const measurement::SpecimenRecord& specimen, const std::optional<game::Amendment>& amend);
  /// Sends it, if anybody is there to hear it.
  dashboard::Answer hand_in(const runtime::Message& message);
  /// The run on the port that it plays on now.
  RunAccess now() const;
  RunAccess run_;
  LaboratoryReader reader_;
  std::shared_ptr<const LaboratoryView> read_;  ///< what `laboratory_` was made of
  std::shared_ptr<const dashboard::Laboratory> laboratory_;
  dashboard::LiveFeed feed_;
};

}  // namespace nacre::cli
