#include "persons_game.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/result.hpp"
#include "measurement/read_set.hpp"
#include "measurement/write_set.hpp"
#include "program.hpp"
#include "runtime/journal.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr double kPatienceS = 240.0;  // for one step, on a machine that does other things too

fs::path made(const fs::path& folder) {
  fs::create_directories(folder);
  return folder;
}

fs::path written(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

std::string demanded(const std::vector<std::string>& arguments, int expected_status) {
  const Outcome outcome = run_nacre(arguments, kPatienceS);
  if (outcome.status == expected_status) return outcome.out + outcome.err;
  throw InputError::format("nacre {}: exit status {}: {}{}", fmt::join(arguments, " "), outcome.status, outcome.out,
                           outcome.err);
}

}  // namespace

nlohmann::json inject(const fs::path& set, const std::vector<measurement::SpecimenRecord>& specimens,
                      const fs::path& run, int expected_status) {
  measurement::write_measurement_set(set, specimens);
  const std::vector<std::string> arguments = {"inject", set.string(), "--run", run.string(), "--json"};
  const Outcome outcome = run_nacre(arguments, kPatienceS);
  if (outcome.status == expected_status) return nlohmann::json::parse(outcome.out);
  throw InputError::format("nacre inject: exit status {}: {}{}", outcome.status, outcome.out, outcome.err);
}

PersonsGame::PersonsGame(const fs::path& folder, const std::string& name, const std::string& scenario)
    : folder_(made(folder / (name + "_sets"))),
      game_(written(folder / (name + ".toml"),
                    fmt::format("name = \"{}\"\n{}\n[laboratory]\nvirtual_lab = false\n", name, scenario)),
            folder / "logs", name) {}

void PersonsGame::wait_for(const std::string& what, const std::function<bool()>& condition) {
  if (!game_.play_until(condition, kPatienceS)) throw InputError::format("no {}\n{}", what, game_.said());
}

void PersonsGame::play_to_end() {
  if (!game_.play_to_end(kPatienceS)) throw InputError::format("no end\n{}", game_.said());
  if (game_.status() != 0) throw InputError::format("exit status {}\n{}", game_.status(), game_.said());
}

template <class Domain>
std::vector<Domain> PersonsGame::read_all(const std::string& channel) const {
  std::vector<Domain> all;
  for (const std::string& payload : journaled(run(), "validation_agent", channel)) {
    all.push_back(wire::read<Domain>(payload).value());
  }
  return all;
}

std::vector<wire::Proposal> PersonsGame::proposals() const { return read_all<wire::Proposal>("PROPOSAL"); }
std::vector<wire::TestOrder> PersonsGame::orders() const {
  return read_all<wire::TestOrder>(std::string(runtime::kOutPrefix) + "TEST_ORDER");
}
std::vector<wire::RoundSummary> PersonsGame::rounds() const {
  return read_all<wire::RoundSummary>(std::string(runtime::kOutPrefix) + "ROUND");
}

std::vector<measurement::SpecimenRecord> PersonsGame::measured_in_laboratory() const {
  const fs::path laboratory = folder_ / "laboratory.toml", set = folder_ / "measured";
  std::ofstream(laboratory) << "seed = 5\nfidelity = \"tiny\"\nreplicates = 2\n";
  fs::remove_all(set);
  std::vector<std::string> arguments = {"measure", "--lab", laboratory.string(), "--out", set.string()};
  std::set<std::string> designs;
  for (const wire::TestOrder& order : orders()) designs.insert(order.design.name());
  arguments.insert(arguments.end(), designs.begin(), designs.end());
  demanded(arguments, 0);
  return measurement::read_measurement_set(set).specimens;
}

std::string PersonsGame::decide(std::vector<std::string> command, int expected_status) const {
  const std::vector<std::string> more = {"--run", run().string(), "--by", "a person"};
  command.insert(command.end(), more.begin(), more.end());
  return demanded(command, expected_status);
}

}  // namespace nacre
