#pragma once
// A run as its laboratory sees it: what is ordered, printed, measured. Read from the validation agent's journal and
// from the record of what was printed (printed_record.hpp).

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashboard/round_price.hpp"
#include "game/design_states.hpp"
#include "printed_record.hpp"
#include "run/journal_messages.hpp"
#include "run_access.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {

struct OrderState {
  game::Order order;
  int printed = 0;
  int arrived = 0;
  int valid = 0;
  bool complete = false;
  bool withdrawn = false;
};

struct LaboratoryView {
  game::LaboratoryFacts facts;
  std::vector<OrderState> orders;
  std::optional<wire::Proposal> open_proposal;  ///< that of the last round that is over: decided on now
  std::optional<material::ParameterSet> model;  ///< that the validation agent adopted last
  int round = 1;                                ///< that is measured, or will be next
  bool is_over = false;                         ///< the last round is closed, and with it the family stage
};

/// A run whose laboratory is looked at again and again: only what was added to the journal is read.
class LaboratoryReader {
 public:
  explicit LaboratoryReader(RunAccess run);
  /// The same object as long as nothing has changed. `measured` is handed the payload of every MEASUREMENT that is
  /// read, too. Throws InputError when the record of what was printed cannot be read.
  std::shared_ptr<const LaboratoryView> view(const std::function<void(const std::string& payload)>& measured = {});

 private:
  void read_journal(const std::function<void(const std::string& payload)>& measured);
  LaboratoryView make_view() const;
  RunAccess run_;
  std::shared_ptr<const LaboratoryView> view_;  ///< the last one; nullptr: what is known has changed since
  std::vector<PrintedRow> printed_;             ///< as recorded when it was made
  run::JournalMessages journal_;
  LaboratoryView known_;  ///< what the journal says, without settings, orders' progress and what was printed
  std::map<int, wire::Proposal> proposals_;
  std::map<std::string, game::Withdrawal> given_again_;  ///< said of an order, until the agent gives it again
  int last_round_ = -1;
};

/// What the round at hand asks of the laboratory; nothing once the game is over or where no round is measured.
std::optional<dashboard::RoundPrice> price_of_round(const RunAccess& run, const LaboratoryView& view);

/// The laboratory looked at once.
LaboratoryView view_laboratory(const RunAccess& run,
                               const std::function<void(const std::string& payload)>& measured = {});

}  // namespace nacre::cli
