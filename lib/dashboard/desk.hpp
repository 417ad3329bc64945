#pragma once
// What the dashboard asks of a run beside its database, and hands in on behalf of a person. A small interface, so that
// routes are tested without a network.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "families/grouping.hpp"
#include "game/design_states.hpp"
#include "material/parameters.hpp"
#include "measurement/specimen_record.hpp"
#include "nacre/diagnosis_t.hpp"
#include "nacre/node_status_t.hpp"
#include "wire/convert.hpp"

namespace nacre::dashboard {

/// What became of something that was handed in.
enum class Delivery {
  accepted,     ///< every node that listens has it
  repeated,     ///< the validation agent had it already
  conflicting,  ///< it has a specimen of this name with other content, which stays
  unanswered,   ///< a node did not answer in time
};
std::string_view to_string(Delivery answer);

/// A person's yes or no to a proposed design; round -1: a design of the person's own, to be measured too.
struct Approval {
  std::string design;
  int round = -1;
  bool approved = true;
  std::string by, why;
};

/// A person's judgement on one specimen.
struct SpecimenReview {
  std::string specimen;
  bool valid = true;
  std::string by, why;
};

/// The run as its laboratory sees it.
struct Laboratory {
  game::LaboratoryFacts facts;
  std::optional<wire::Proposal> open_proposal;
};

/// What a node last said of itself.
struct NodeReport {
  std::string node;
  node_status_t status{};
  double age_s = 0.0;  ///< since it said so
};

/// Whether any node has spoken within the last seconds.
inline bool is_playing(const std::vector<NodeReport>& nodes) {
  constexpr double kPlaying_s = 5.0;
  return std::ranges::any_of(nodes, [](const NodeReport& report) { return report.age_s < kPlaying_s; });
}

class Desk {
 public:
  virtual ~Desk() = default;
  /// May throw InputError, like all calls here.
  virtual Laboratory laboratory() = 0;
  /// The model adopted in a round; nothing when none was.
  virtual std::optional<material::ParameterSet> model(int round) = 0;
  /// The own model of a family of the stage after the game; nothing when there is no such family.
  virtual std::optional<material::ParameterSet> family_model(const std::string& family) = 0;
  /// The analyser's newest word on a round.
  virtual std::optional<diagnosis_t> diagnosis(int round) = 0;
  /// Nodes that have spoken within the last minute.
  virtual std::vector<NodeReport> nodes() = 0;
  /// What a person should look at again in a specimen that was handed in, as sentences.
  virtual std::vector<std::string> doubts_about(const measurement::SpecimenRecord& specimen) = 0;
  // Handing in: waits for the validation agent for some seconds.
  virtual Delivery enter(const measurement::SpecimenRecord& specimen) = 0;
  virtual Delivery review(const SpecimenReview& review) = 0;
  virtual Delivery decide(const Approval& approval) = 0;
  /// Why a judgement or a decision would change nothing, as a sentence; nothing where it counts.
  virtual std::optional<std::string> against(const SpecimenReview& review) = 0;
  virtual std::optional<std::string> against(const Approval& approval) = 0;
  /// Writes families.toml into `folder`: a game's family stage takes it when it begins, `nacre families` whenever it is
  /// called.
  virtual void keep_grouping(const std::filesystem::path& folder,
                             const std::vector<families::SeedFamily>& families) = 0;
};

}  // namespace nacre::dashboard
