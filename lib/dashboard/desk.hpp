#pragma once
// What the dashboard asks of a run in addition to its database, and what it enters for a person. A small interface, so
// that routes are tested without a network.

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "dashboard/live_search.hpp"
#include "dashboard/notes.hpp"
#include "dashboard/round_price.hpp"
#include "families/grouping.hpp"
#include "game/design_states.hpp"
#include "measurement/specimen_record.hpp"
#include "wire/convert.hpp"

namespace nacre::dashboard {

/// What became of something that a person entered.
enum class Delivery {
  accepted,     ///< every node that listens has confirmed it
  repeated,     ///< the validation agent had it already
  conflicting,  ///< it has a specimen of this name with other content, which stays
  refused,      ///< a node has it and will not use it
  unanswered,   ///< a node did not confirm it in time
};
std::string_view to_string(Delivery delivery);

struct Answer {
  Delivery delivery = Delivery::accepted;
  std::string refusal = {};  ///< why it is refused and what to do, in sentences
};

/// What a person should look at in a specimen before it counts.
struct SpecimenDoubt {
  std::string specimen;
  bool is_of_scale = false;  ///< a unit or a size may be mistaken
  std::string text;          ///< a sentence
};

/// A person's yes or no to a proposed design. Round -1: a design of the person's own, to be measured as well.
struct Approval {
  std::string design;
  int round = -1;
  bool approved = true;
  std::string by, why;
};

/// A person's review of one specimen: whether it is valid, and why.
struct SpecimenReview {
  std::string specimen;
  bool valid = true;
  std::string by, why;
};

/// A person's amendment of a specimen that was mistyped: other values in columns of a measurement set.
struct Amendment {
  std::string specimen;
  std::map<std::string, std::string> changes;  ///< cells by column
  std::string by, why;
};

/// A person's word that an order, or all open ones of a design, are not to be made, or are after all.
struct Withdrawal {
  std::string order;   ///< its id; empty: those of `design`
  std::string design;  ///< canonical name
  bool withdrawn = true;
  std::string by, why;
};

/// A print job that a person asks for, of all that is ordered and not printed.
struct PrintJobWish {
  std::string name = {};     ///< labels begin with it; empty: after the round
  std::string printer = {};  ///< fabricate::named_printers(); empty: the first
  bool tray_stacks = true;   ///< also one stack of slices for all of a tray
  std::optional<std::array<double, 2>> tray_mm = {};
};

/// A person's word that a tray of a job of the run is printed, or is not after all.
struct PrintedTray {
  std::string job;
  int tray = 1;
  bool printed = true;
  std::string by;
};

/// The run as its laboratory sees it.
struct Laboratory {
  game::LaboratoryFacts facts;
  std::optional<wire::Proposal> open_proposal;
  std::optional<RoundPrice> price;  ///< of the round that is measured, or will be next; nothing once the game is over
};

/// The last STATUS of a node.
struct NodeReport {
  std::string node;
  wire::NodeStatus status;
  double age_s = 0.0;  ///< since it came
};

/// Whether any node has reported within the last seconds.
inline bool is_playing(const std::vector<NodeReport>& nodes) {
  constexpr double kPlaying_s = 5.0;
  return std::ranges::any_of(nodes, [](const NodeReport& report) { return report.age_s < kPlaying_s; });
}

class Desk {
 public:
  virtual ~Desk() = default;
  /// The same object as long as nothing has changed. May throw InputError, like all calls here.
  virtual std::shared_ptr<const Laboratory> laboratory() = 0;
  /// Nodes that have reported within the last minute.
  virtual std::vector<NodeReport> nodes() = 0;
  /// What a person should check again in a specimen that was entered, as sentences.
  virtual std::vector<std::string> doubts_about(const measurement::SpecimenRecord& specimen) = 0;
  /// What the run's model, orders and specimens say about new specimens.
  virtual std::vector<SpecimenDoubt> doubts_of(std::span<const measurement::SpecimenRecord> specimens) = 0;
  /// The search that is under way, or the last one; nothing before its first result.
  virtual std::optional<LiveSearch::Progress> search() = 0;
  /// What that search has simulated so far; empty for the rounds before.
  virtual run::Gamut searched(int round) = 0;
  // Entering: waits some seconds for the validation agent.
  virtual Answer enter(const measurement::SpecimenRecord& specimen) = 0;
  /// The same for several at once; an answer each. Entering them again is safe.
  virtual std::vector<Answer> enter_all(std::span<const measurement::SpecimenRecord> specimens) = 0;
  virtual Answer review(const SpecimenReview& review) = 0;
  virtual Answer decide(const Approval& approval) = 0;
  virtual Answer amend(const measurement::SpecimenRecord& specimen, const std::string& by, const std::string& why) = 0;
  virtual Answer withdraw(const Withdrawal& withdrawal) = 0;
  /// The specimen as amended; error: which column cannot be so, or that nobody knows the specimen.
  virtual Result<measurement::SpecimenRecord> amended(const Amendment& amendment) = 0;
  /// Why a review, an approval or a withdrawal would change nothing, as a sentence; nothing where it counts.
  virtual std::optional<std::string> against(const SpecimenReview& review) = 0;
  virtual std::optional<std::string> against(const Approval& approval) = 0;
  virtual std::optional<std::string> against(const Withdrawal& withdrawal) = 0;
  /// Keeps a folder with files, from which specimens were entered, under this name.
  virtual void keep_import(const std::filesystem::path& folder, const std::string& name) = 0;
  /// Writes families.toml into `folder`: a game's family stage uses it when it begins, `nacre families` whenever it is
  /// called.
  virtual void keep_grouping(const std::filesystem::path& folder,
                             const std::vector<families::SeedFamily>& families) = 0;
  /// Writes down that a tray is printed, or takes that back while none of its specimens is measured; the build sheet
  /// says what lies on it. The game need not be played.
  virtual Answer print(const PrintedTray& tray, const std::filesystem::path& build_sheet) = 0;
  /// Writes a note into `folder`. Refused where that takes no more.
  virtual Answer keep_note(const NoteFolder& folder, const Note& note) = 0;
};

}  // namespace nacre::dashboard
