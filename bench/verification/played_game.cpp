#include "played_game.hpp"

#include "runtime/journal.hpp"

namespace nacre::verification {

PlayedGame read_game(const std::filesystem::path& run) {
  PlayedGame game;
  wire::GamutCollector chunks;
  runtime::LogReader journal(run / "nodes" / "validation_agent" / "journal.lcm");
  while (const auto record = journal.next()) {
    if (record->channel == std::string(runtime::kOutPrefix) + "PARAMETERS") {
      if (const auto model = wire::read<wire::AdoptedModel>(record->data)) game.models.emplace(model->round, *model);
    } else if (record->channel == "GAMUT") {
      const auto chunk = wire::read<wire::GamutChunk>(record->data);
      if (!chunk) continue;
      if (auto gamut = chunks.add(*chunk)) game.gamuts.emplace(chunk->round, *std::move(gamut));
    } else if (record->channel == "PROPOSAL") {
      const auto proposal = wire::read<wire::Proposal>(record->data);
      if (proposal) game.proposals.emplace(proposal->round, *proposal);
    } else if (record->channel == "MEASUREMENT") {
      if (const auto measured = wire::read<wire::Measurement>(record->data)) game.specimens.push_back(measured->record);
    }
  }
  return game;
}

}  // namespace nacre::verification
