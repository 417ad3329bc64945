#pragma once
// A played game as text that people read and repositories keep: every node's inputs and outputs, line by line.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nacre::golden {

/// Nodes whose journals stand in the run's folder, the validation agent first.
std::vector<std::string> nodes_of(const std::filesystem::path& run);

/// Writes what the journals of `run` hold to FOLDER/game.jsonl, and scenario and inputs beside it. What concerns
/// delivery and not decisions stays out: times, headers, acknowledgements. Of the nodes in `most_records` only the
/// beginning is written, about so many records. Throws InputError.
void write_golden_game(const std::filesystem::path& run, const std::filesystem::path& folder,
                       const std::map<std::string, int>& most_records = {});

/// Makes FOLDER of write_golden_game into a run that `nacre replay` takes. Throws InputError naming file and line.
void unpack_golden_game(const std::filesystem::path& folder, const std::filesystem::path& run);

}  // namespace nacre::golden
