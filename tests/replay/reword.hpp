#pragma once
// Golden games after a change of sentences: numbers, keys, order and count of all outputs stay, sentences become the
// new ones.

#include <filesystem>
#include <map>
#include <string>

namespace nacre::golden {

/// Sentences of a game's outputs.
struct RewordedField {
  int outputs = 0;  ///< that hold the field
  int changed = 0;  ///< of those, with another sentence
};

struct Rewording {
  std::map<std::string, RewordedField> fields;  ///< by "TYPE.FIELD", e.g. "proposal_t.designs[].reason"
  int ids = 0;                                  ///< of works that are named by the hash of a reworded message
};

/// Feeds each node's recorded inputs to a fresh core, as `nacre replay` does, and writes FOLDER/game.jsonl anew with
/// the sentences that are sent now, in messages that are outputs and wherever the same message is an input. Work whose
/// result holds sentences is done again. `scratch` is a new folder. Throws InputError, and leaves the game as it was,
/// when anything but a sentence differs: a number, a key, order or count of outputs, or a sentence that is empty on one
/// side alone.
Rewording reword_golden_game(const std::filesystem::path& folder, const std::filesystem::path& scratch);

}  // namespace nacre::golden
