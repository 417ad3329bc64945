#pragma once
// A game with the real programs and without the virtual laboratory: what a person does in it.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "played_game.hpp"

namespace nacre {

/// What `nacre inject --json` says to a set made of these specimens; the exit status must be as expected. Throws
/// InputError.
nlohmann::json inject(const std::filesystem::path& set, const std::vector<measurement::SpecimenRecord>& specimens,
                      const std::filesystem::path& run, int expected_status = 0);

/// Everything that does not come about in time throws InputError with what the launcher has said.
class PersonsGame {
 public:
  /// `scenario` without name; the virtual laboratory is switched off behind it. Games of one folder share the farm's
  /// cache.
  PersonsGame(const std::filesystem::path& folder, const std::string& name, const std::string& scenario);

  PlayedGame& game() { return game_; }
  const std::filesystem::path& run() const { return game_.folder(); }

  void wait_for(const std::string& what, const std::function<bool()>& condition);
  /// Also requires exit status 0.
  void play_to_end();

  /// What the validation agent has been told and has said, oldest first.
  std::vector<wire::Proposal> proposals() const;
  std::vector<wire::TestOrder> orders() const;
  std::vector<wire::RoundSummary> rounds() const;

  /// Two specimens for each order so far, from `nacre measure`, the same numbers for the same order.
  std::vector<measurement::SpecimenRecord> measured_in_laboratory() const;
  nlohmann::json inject(const std::string& set, const std::vector<measurement::SpecimenRecord>& specimens,
                        int expected_status = 0) const {
    return nacre::inject(folder_ / set, specimens, run(), expected_status);
  }
  /// nacre COMMAND ... --run RUN --by "a person"
  std::string decide(std::vector<std::string> command, int expected_status = 0) const;

 private:
  template <class Domain>
  std::vector<Domain> read_all(const std::string& channel) const;

  std::filesystem::path folder_;  // of measurement sets
  PlayedGame game_;
};

}  // namespace nacre
