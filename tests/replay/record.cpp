// Plays the golden games anew and writes them down. For deliberate changes of what nodes say; tests/replay/README.md.
// usage: record_golden_games FOLDER [GAME...]

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/result.hpp"
#include "golden_game.hpp"
#include "measurement/measurement.hpp"
#include "played_game.hpp"
#include "program.hpp"
#include "wire/convert.hpp"

namespace nacre::golden {
namespace {

namespace fs = std::filesystem;

constexpr double kPatienceS = 300.0;

constexpr std::string_view kSmall = R"(seed = 1
fidelity = "tiny"
[proposal]
samples = {}
seeds = 1
population = 6
designs = {}
[validation]
random_patterns = {}
calibration_evaluations = 2
modulus_evaluations = 6
)";

std::string small(int samples, int designs, int random_patterns) {
  return fmt::format(fmt::runtime(kSmall), samples, designs, random_patterns);
}

void demand(bool condition, const PlayedGame& game, const std::string& what) {
  if (!condition) throw InputError::format("{}: {}\n{}", game.folder().string(), what, game.said());
}

Outcome demanded(const std::vector<std::string>& arguments) {
  Outcome outcome = run_nacre(arguments, kPatienceS);
  if (outcome.status != 0) throw InputError::format("nacre {}: {}", fmt::join(arguments, " "), outcome.err);
  return outcome;
}

PlayedGame started(const fs::path& folder, const std::string& name, const std::string& scenario) {
  const fs::path file = folder / (name + ".toml");
  std::ofstream(file) << scenario;
  return {file, folder / "logs", name};
}

void play_to_end(PlayedGame& game) {
  demand(game.play_to_end(kPatienceS), game, "has no end");
  demand(game.status() == 0, game, "failed");
}

/// Everything by itself: the virtual laboratory, two refits, a diagnosis in each round.
fs::path laboratory_game(const fs::path& folder) {
  PlayedGame game =
      started(folder, "laboratory",
              fmt::format("name = \"laboratory\"\nrounds = 2\nstop_at_equilibrium = false\n{}replicates = 1\n"
                          "mixtures = []\n[diagnosis]\nbootstraps = 1000\n",
                          small(8, 1, 0)));
  play_to_end(game);
  return game.folder();
}

/// A person takes part in another game: decides on proposals, measures by hand, and changes their mind.
class PersonsGame {
 public:
  explicit PersonsGame(const fs::path& folder)
      : folder_(folder),
        game_(started(folder, "person",
                      fmt::format("name = \"person\"\nrounds = 1\n{}replicates = 2\nmixtures = []\napproval = true\n"
                                  "[diagnosis]\nenabled = false\n[laboratory]\nvirtual_lab = false\n",
                                  small(16, 2, 1)))) {}

  fs::path play() {
    decide();
    measure();
    play_to_end(game_);
    return game_.folder();
  }

 private:
  void wait_for(const std::string& what, const std::function<bool()>& condition) {
    demand(game_.play_until(condition, kPatienceS), game_, "no " + what);
  }
  std::size_t ordered() const { return on_channels(said_in_game(game_.folder()), {"TEST_ORDER"}).size(); }

  /// One proposed design is accepted, the other refused.
  void decide() {
    wait_for("proposal", [&] { return !journaled(game_.folder(), "validation_agent", "PROPOSAL").empty(); });
    wait_for("orders", [&] { return ordered() > 0; });
    const std::size_t before = ordered();
    const auto proposal =
        wire::read<wire::Proposal>(journaled(game_.folder(), "validation_agent", "PROPOSAL").front()).value();
    const std::string run = game_.folder().string();
    const auto name = [&](std::size_t design) { return proposal.designs.at(design).design.name(); };
    demanded({"approve", name(0), "--run", run, "--by", "a person", "--why", "looks printable"});
    demanded({"approve", name(1), "--reject", "--run", run, "--by", "a person", "--why", "no support material left"});
    wait_for("orders for the accepted design", [&] { return ordered() == before + 2; });
  }

  /// A part first, with a broken specimen; then everything, the part once more; one specimen is judged again.
  void measure() {
    const std::vector<measurement::SpecimenRecord> all = measured_in_laboratory();
    measurement::SpecimenRecord broken = all.front();
    broken.specimen += "-broken";
    broken.valid = false;
    broken.note = "slipped in the grips";
    inject("part", {all.at(2), broken, all.at(0)});
    const std::string run = game_.folder().string();
    demanded({"review", all.at(2).specimen, "--invalid", "--run", run, "--by", "a person", "--why", "wrong speed"});
    demanded({"review", all.at(2).specimen, "--valid", "--run", run, "--by", "a person", "--why", "speed was right"});
    inject("whole", all);
  }

  std::vector<measurement::SpecimenRecord> measured_in_laboratory() const {
    const fs::path laboratory = folder_ / "laboratory.toml", set = folder_ / "set";
    std::ofstream(laboratory) << "seed = 5\nfidelity = \"tiny\"\nreplicates = 2\n";
    std::vector<std::string> arguments = {"measure", "--lab", laboratory.string(), "--out", set.string()};
    std::set<std::string> designs;
    for (const auto& payload : journaled(game_.folder(), "validation_agent", "~out/TEST_ORDER")) {
      designs.insert(wire::read<wire::TestOrder>(payload).value().design.name());
    }
    arguments.insert(arguments.end(), designs.begin(), designs.end());
    demanded(arguments);
    std::vector<measurement::SpecimenRecord> specimens = measurement::read_measurement_set(set).specimens;
    // One with a curve, the others with a number.
    const auto with_curve =
        std::find_if(specimens.begin(), specimens.end(), [](const auto& s) { return s.toughness_pa; });
    for (auto specimen = specimens.begin(); specimen != specimens.end(); ++specimen) {
      if (specimen != with_curve) specimen->curve = {};
    }
    return specimens;
  }

  void inject(const std::string& set, const std::vector<measurement::SpecimenRecord>& specimens) {
    measurement::write_measurement_set(folder_ / set, specimens);
    demanded({"inject", (folder_ / set).string(), "--run", game_.folder().string()});
  }

  fs::path folder_;
  PlayedGame game_;
};

const std::map<std::string, std::function<fs::path(const fs::path&)>> kGames = {
    {"laboratory", laboratory_game}, {"person", [](const fs::path& folder) { return PersonsGame(folder).play(); }}};

int record(const fs::path& games, std::vector<std::string> names) {
  if (names.empty()) names = {"laboratory", "person"};
  for (const std::string& name : names) {
    const auto play = kGames.find(name);
    if (play == kGames.end()) throw InputError::format("{}: no golden game of this name", name);
    const fs::path run = play->second(fresh_folder(name));
    // These two say the same sort of things all the time, and curves are long.
    write_golden_game(run, games / name, {{"simulator_farm", name == "laboratory" ? 30 : 0}, {"virtual_lab", 16}});
    fmt::print("{}: {} bytes\n", name, fs::file_size(games / name / "game.jsonl"));
  }
  return 0;
}

}  // namespace
}  // namespace nacre::golden

int main(int argc, char** argv) try {
  if (argc < 2) throw nacre::InputError("usage: record_golden_games FOLDER [GAME...]");
  return nacre::golden::record(argv[1], {argv + 2, argv + argc});
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 2;
}
