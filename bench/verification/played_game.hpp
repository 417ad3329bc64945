#pragma once
// Models, gamuts, proposals and specimens of a played game, from the validation agent's journal.

#include <filesystem>
#include <map>
#include <vector>

#include "measurement/specimen_record.hpp"
#include "wire/convert.hpp"

namespace nacre::verification {

struct PlayedGame {
  std::map<int, wire::AdoptedModel> models;               ///< by round
  std::map<int, std::vector<explore::Evaluated>> gamuts;  ///< by round
  std::map<int, wire::Proposal> proposals;                ///< by round
  std::vector<measurement::SpecimenRecord> specimens;
};

/// Reads a run's folder. Throws InputError when its journal is damaged.
PlayedGame read_game(const std::filesystem::path& run);

}  // namespace nacre::verification
