// Plays the golden games anew and writes them down, or puts new sentences into them as they were played, or writes
// their transcripts alone. For deliberate changes of what nodes send; tests/replay/README.md. usage:
// record_golden_games [--reword | --transcribe] FOLDER [GAME...]

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "base/result.hpp"
#include "golden_game.hpp"
#include "measurement/specimen_record.hpp"
#include "measurement/summary.hpp"
#include "persons_game.hpp"
#include "program.hpp"
#include "reword.hpp"
#include "transcript.hpp"

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

/// Everything by itself: the virtual laboratory, two refits, a diagnosis in each round, with fracture tests as far
/// as sixteen simulations pay.
fs::path laboratory_game(const fs::path& folder) {
  const fs::path scenario = folder / "laboratory.toml";
  std::ofstream(scenario) << "name = \"laboratory\"\nrounds = 2\nstop_at_equilibrium = false\n" + small(8, 1, 0) +
                                 "replicates = 1\nmixtures = []\n[diagnosis]\nbootstraps = 1000\nsimulations = 16\n";
  PlayedGame game(scenario, folder / "logs", "laboratory");
  if (!game.play_to_end(kPatienceS) || game.status() != 0) throw InputError(game.said());
  return game.folder();
}

/// One proposed design is accepted, the other refused.
void decide(PersonsGame& person) {
  person.wait_for("orders of round 1", [&] { return !person.rounds().empty(); });
  const std::size_t before = person.orders().size();
  const auto designs = person.proposals().at(0).designs;
  person.decide({"approve", designs.at(0).design.name(), "--why", "looks printable"});
  person.decide({"approve", designs.at(1).design.name(), "--reject", "--why", "no support material left"});
  person.wait_for("orders for the accepted design", [&] { return person.orders().size() == before + 2; });
}

/// A part first, with a broken specimen; then everything, the part once more; one specimen is judged again.
void measure(PersonsGame& person) {
  std::vector<measurement::SpecimenRecord> all = person.measured_in_laboratory();
  // One with a curve, the others with a number.
  const auto with_curve = std::find_if(all.begin(), all.end(), [](const auto& each) { return each.curve.size() > 0; });
  for (auto each = all.begin(); each != all.end(); ++each) {
    if (each == with_curve || each->curve.size() == 0) continue;
    if (each->test == tester::TestKind::toughness) each->toughness_pa = measurement::toughness_of(*each);
    each->curve = {};
  }
  measurement::SpecimenRecord broken = all.front();
  broken.specimen += "-broken";
  broken.valid = false;
  broken.note = "slipped in the grips";
  person.inject("part", {all.at(2), broken, all.at(0)});
  person.decide({"review", all.at(2).specimen, "--invalid", "--why", "wrong speed"});
  person.decide({"review", all.at(2).specimen, "--valid", "--why", "the speed was right"});
  person.inject("whole", all);
}

/// A person decides on proposals, measures by hand, and changes their mind.
fs::path persons_game(const fs::path& folder) {
  PersonsGame person(folder, "person",
                     "rounds = 1\n" + small(16, 2, 1) +
                         "replicates = 2\nmixtures = []\napproval = true\n"
                         "[diagnosis]\nenabled = false\n");
  decide(person);
  measure(person);
  person.play_to_end();
  return person.run();
}

const std::map<std::string, std::function<fs::path(const fs::path&)>> kGames = {{"laboratory", laboratory_game},
                                                                                {"person", persons_game}};

/// Writes the transcript of what game.jsonl holds.
void transcribe(const fs::path& games, const std::string& name) {
  const fs::path run = fresh_folder("transcribe_" + name);
  unpack_golden_game(games / name, run);
  write_transcript(recorded_lines(run), games / name);
}

void record(const fs::path& games, const std::string& name) {
  const fs::path run = kGames.at(name)(fresh_folder(name));
  // These two send the same sort of messages all the time, and curves are long.
  write_golden_game(run, games / name, {{"simulator_farm", name == "laboratory" ? 30 : 0}, {"virtual_lab", 16}});
  fmt::print("{}: {} bytes\n", name, fs::file_size(games / name / "game.jsonl"));
  transcribe(games, name);
}

void reword(const fs::path& games, const std::string& name) {
  const Rewording rewording = reword_golden_game(games / name, fresh_folder("reword_" + name));
  for (const auto& [field, counts] : rewording.fields)
    fmt::print("{}: {}: {} of {} outputs changed\n", name, field, counts.changed, counts.outputs);
  fmt::print("{}: ids of stored messages: {} changed\n", name, rewording.ids);
}

int run(std::vector<std::string> arguments) {
  using Action = void (*)(const fs::path&, const std::string&);
  static const std::map<std::string, Action> kActions = {{"--reword", reword}, {"--transcribe", transcribe}};
  const auto chosen = arguments.empty() ? kActions.end() : kActions.find(arguments.front());
  const Action action = chosen == kActions.end() ? record : chosen->second;
  if (chosen != kActions.end()) arguments.erase(arguments.begin());
  if (arguments.empty()) throw InputError("usage: record_golden_games [--reword | --transcribe] FOLDER [GAME...]");
  const fs::path games = arguments.front();
  std::vector<std::string> names(arguments.begin() + 1, arguments.end());
  if (names.empty()) names = {"laboratory", "person"};
  for (const std::string& name : names) {
    if (!kGames.contains(name)) throw InputError::format("{}: no golden game of this name", name);
    action(games, name);
  }
  return 0;
}

}  // namespace
}  // namespace nacre::golden

int main(int argc, char** argv) try {
  return nacre::golden::run({argv + 1, argv + argc});
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 2;
}
