#pragma once
// A desk without a run behind it: it keeps what is entered.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"

namespace nacre::dashboard {

class FakeDesk : public Desk {
 public:
  std::shared_ptr<const Laboratory> laboratory() override { return picture; }
  std::vector<NodeReport> nodes() override { return reports; }
  std::optional<LiveSearch::Progress> search() override { return live.progress(); }
  run::Gamut searched(int round) override { return live.gamut(round); }
  std::vector<std::string> doubts_about(const measurement::SpecimenRecord&) override { return doubts; }
  Answer enter(const measurement::SpecimenRecord& specimen) override { return specimens.push_back(specimen), answer; }
  std::vector<SpecimenDoubt> doubts_of(std::span<const measurement::SpecimenRecord>) override { return run_doubts; }
  std::vector<Answer> enter_all(std::span<const measurement::SpecimenRecord> several) override {
    for (const auto& each : several) specimens.push_back(each);
    return std::vector<Answer>(several.size(), answer);
  }
  void keep_import(const std::filesystem::path&, const std::string& name) override { kept.push_back(name); }
  Answer review(const SpecimenReview& review) override { return reviews.push_back(review), answer; }
  std::optional<std::string> against(const SpecimenReview&) override { return reason_against; }
  std::optional<std::string> against(const Approval&) override { return reason_against; }
  std::optional<std::string> against(const Withdrawal&) override { return reason_against; }
  Answer decide(const Approval& approval) override { return approvals.push_back(approval), answer; }
  Answer withdraw(const Withdrawal& withdrawal) override { return withdrawals.push_back(withdrawal), answer; }
  Result<measurement::SpecimenRecord> amended(const Amendment& amendment) override {
    amendments.push_back(amendment);
    if (reason_against) return fail("{}", *reason_against);
    measurement::SpecimenRecord record;
    record.specimen = amendment.specimen;
    return record;
  }
  Answer amend(const measurement::SpecimenRecord& specimen, const std::string&, const std::string&) override {
    return specimens.push_back(specimen), answer;
  }

  void keep_grouping(const std::filesystem::path&, const std::vector<families::SeedFamily>& families) override {
    groupings.push_back(families);
  }

  Answer print(const PrintedTray& tray, const std::filesystem::path&) override {
    return printed.push_back(tray), answer;
  }

  Answer keep_note(const NoteFolder&, const Note& note) override { return notes.push_back(note), answer; }

  std::shared_ptr<const Laboratory> picture = std::make_shared<const Laboratory>();
  std::vector<NodeReport> reports;
  LiveSearch live;
  Answer answer;
  std::optional<std::string> reason_against;
  std::vector<std::string> doubts;
  std::vector<SpecimenDoubt> run_doubts;
  std::vector<std::string> kept;
  std::vector<measurement::SpecimenRecord> specimens;
  std::vector<SpecimenReview> reviews;
  std::vector<Approval> approvals;
  std::vector<Withdrawal> withdrawals;
  std::vector<Amendment> amendments;
  std::vector<std::vector<families::SeedFamily>> groupings;
  std::vector<PrintedTray> printed;
  std::vector<Note> notes;
};

}  // namespace nacre::dashboard
