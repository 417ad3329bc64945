#pragma once
// A desk without a run behind it: it keeps what is handed in.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"

namespace nacre::dashboard {

class FakeDesk : public Desk {
 public:
  Laboratory laboratory() override { return picture; }
  std::optional<material::ParameterSet> model(int round) override {
    ++models_read;
    return round == 0 ? std::optional(material::default_parameters()) : std::nullopt;
  }
  std::optional<material::ParameterSet> family_model(const std::string& family) override {
    ++models_read;
    return family == "family-2" ? std::optional(material::default_parameters()) : std::nullopt;
  }
  std::optional<diagnosis_t> diagnosis(int) override { return std::nullopt; }
  std::vector<NodeReport> nodes() override { return reports; }
  std::vector<std::string> doubts_about(const measurement::SpecimenRecord&) override { return doubts; }
  Answer enter(const measurement::SpecimenRecord& specimen) override { return specimens.push_back(specimen), answer; }
  Answer judge(const Judgement& judgement) override { return judgements.push_back(judgement), answer; }
  std::optional<std::string> against(const Judgement&) override { return reason_against; }
  std::optional<std::string> against(const Decision&) override { return reason_against; }
  Answer decide(const Decision& decision) override { return decisions.push_back(decision), answer; }

  void keep_grouping(const std::filesystem::path&, const std::vector<families::Family>& families) override {
    groupings.push_back(families);
  }

  Laboratory picture;
  int models_read = 0;  ///< a real desk reads a journal each time
  std::vector<NodeReport> reports;
  Answer answer = Answer::accepted;
  std::optional<std::string> reason_against;
  std::vector<std::string> doubts;
  std::vector<measurement::SpecimenRecord> specimens;
  std::vector<Judgement> judgements;
  std::vector<Decision> decisions;
  std::vector<std::vector<families::Family>> groupings;
};

}  // namespace nacre::dashboard
