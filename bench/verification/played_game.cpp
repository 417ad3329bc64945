#include "played_game.hpp"

#include <algorithm>

#include "run/journal_messages.hpp"

namespace nacre::verification {

PlayedGame read_game(const std::filesystem::path& run) {
  PlayedGame game;
  wire::GamutCollector chunks;
  const auto take_model = [&](const std::string& payload) {
    if (const auto model = wire::read<wire::AdoptedModel>(payload)) game.models.emplace(model->round, *model);
  };
  const auto take_chunk = [&](const std::string& payload) {
    const auto chunk = wire::read<wire::GamutChunk>(payload);
    if (!chunk) return;
    chunks.add(*chunk);
    if (const auto* gamut = chunks.whole(chunk->round)) game.gamuts.emplace(chunk->round, *gamut);
  };
  const auto take_proposal = [&](const std::string& payload) {
    if (const auto proposal = wire::read<wire::Proposal>(payload)) game.proposals.emplace(proposal->round, *proposal);
  };
  const auto take_measurement = [&](const std::string& payload) {
    const auto measured = wire::read<wire::Measurement>(payload);
    if (!measured) return;
    const auto known =
        std::ranges::find(game.specimens, measured->record.specimen, &measurement::SpecimenRecord::specimen);
    if (known == game.specimens.end()) {
      game.specimens.push_back(measured->record);
    } else if (measured->revision > 0) {
      *known = measured->record;
    }
  };
  run::JournalMessages(run, "validation_agent")
      .read({{"GAMUT", take_chunk}, {"PROPOSAL", take_proposal}, {"MEASUREMENT", take_measurement}},
            {{"PARAMETERS", take_model}});
  return game;
}

}  // namespace nacre::verification
