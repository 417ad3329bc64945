// Part of the command line (command.hpp): nacre families, the families of good designs, their variants, and a map of
// each (thesis 2.4).

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/counted.hpp"
#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "families/families_file.hpp"
#include "families/grouping.hpp"
#include "family_data.hpp"
#include "family_work.hpp"
#include "game/standings.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "sysid/local_simulator.hpp"

namespace nacre::cli {
namespace {

using families::SeedFamily;
using pattern::Pattern;

constexpr double kEstablished = 0.05;  // family-wise

std::filesystem::path folder_of(const FamilyOptions& options) {
  if (!options.out.empty()) return options.out;
  return options.set.empty() ? std::filesystem::path(options.run) / "families" : std::filesystem::path("families");
}

/// families.toml of the folder when a person or a former call left one, else a proposal, which is written there.
std::vector<SeedFamily> families_in(const std::filesystem::path& folder,
                                    const std::vector<families::MeasuredPattern>& designs) {
  const std::filesystem::path file = folder / "families.toml";
  const std::vector<SeedFamily> proposed = families::proposed_families(designs);
  if (std::filesystem::exists(file)) {
    std::vector<SeedFamily> known = families::read_families(file);
    remark(fmt::format("the families and their seeds are read from {}", file.string()));
    if (known != proposed)
      warn(fmt::format("{}: other families than these measurements propose; delete the file to have them proposed anew",
                       file.string()));
    return known;
  }
  write_file_atomically(file, families::to_toml(proposed));
  return proposed;
}

void print_family(const nlohmann::ordered_json& family) {
  fmt::print("{}: {}, {}\n", family["name"].get<std::string>(), counted(family["seeds"].get<int>(), "seed"),
             counted(family["samples"].get<int>(), "variant"));
  for (const auto& map : family["maps"])
    fmt::print(
        "  map of {}: {} variants sampled, {} interpolated (+{:.1f} %; thesis, Table A.7: 4.5 %); the map shows {:.1f} "
        "% "
        "of their distances\n",
        map["seed"].get<std::string>(), map["sampled"].get<int>(), map["interpolated"].get<int>(),
        100.0 * map["growth"].get<double>(), 100.0 * (1.0 - map["residual_variance"].get<double>()));
  if (family["mechanisms"].empty()) return;
  fmt::print(
      "  correlation of crack mechanisms with toughness at equal rigid fraction and modulus ({} patterns broken; "
      "evidence, not cause):\n",
      family["mechanisms"][0]["patterns"].get<int>());
  for (const auto& found : family["mechanisms"]) {
    const double p = found["p_family_wise"].get<double>();
    fmt::print("    {:<11} {:+.2f}, chance {:.3f}{}\n", found["mechanism"].get<std::string>(),
               found["partial"].get<double>(), p, p < kEstablished ? "" : ": no more than chance gives");
  }
}

void print_proposed(const std::vector<SeedFamily>& proposed, const std::filesystem::path& file, bool json) {
  nlohmann::ordered_json document = {{"file", file.string()}, {"families", nlohmann::ordered_json::array()}};
  for (const SeedFamily& family : proposed) {
    if (!json) fmt::print("{}: {}\n", family.name, counted(family.seeds.size(), "seed"));
    auto& entry = document["families"].emplace_back(nlohmann::ordered_json{{"name", family.name}});
    for (const Pattern& seed : family.seeds) entry["seeds"].push_back(seed.key());
  }
  json ? print_json(document) : fmt::print("{}\n", file.string());
}

int find_families(const FamilyOptions& options) {
  FamilyData data = family_data(options);
  std::vector<families::MeasuredPattern> members;
  for (const measurement::Replicates& group : data.measured)
    members.push_back({*game::eightfold_pattern(group.design), {group.modulus_pa, group.toughness_pa}});
  const std::vector<families::MeasuredPattern> near = families::near_pareto(members, options.rank);
  if (near.empty()) {
    remark("no pattern has been measured in both tests yet");
    nlohmann::ordered_json none = nlohmann::ordered_json::array();
    if (options.propose) none = {{"families", nlohmann::ordered_json::array()}};
    if (options.json) print_json(none);
    return 1;
  }
  const std::filesystem::path folder = folder_of(options);
  prepare_output_folder(folder.string());
  const std::vector<SeedFamily> found = families_in(folder, near);
  if (options.propose) {
    print_proposed(found, folder / "families.toml", options.json);
    return 0;
  }
  // Seeds stay, also where designs measured since have pushed them from the front.
  std::erase_if(data.measured, [&](const measurement::Replicates& group) {
    const Pattern pattern = *game::eightfold_pattern(group.design);
    return std::ranges::count(near, pattern, &families::MeasuredPattern::pattern) == 0 &&
           std::ranges::none_of(found,
                                [&](const SeedFamily& each) { return std::ranges::count(each.seeds, pattern) > 0; });
  });
  sysid::LocalSimulator simulator(data.fidelity, 0, folder / "simulations.bin");
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const SeedFamily& family : found) {
    document.push_back(work_out(family, data, options, folder / family.name, simulator));
    if (!options.json) print_family(document.back());
  }
  write_file_atomically(folder / "families.json", document.dump(2) + "\n");
  if (options.json) print_json(document);
  return 0;
}

}  // namespace

void add_families(CLI::App& app, Action& action) {
  const auto options = std::make_shared<FamilyOptions>();
  CLI::App& command =
      add_command(app, action, "families", "Group the best measured designs, simulate variants of them, and draw maps",
                  options, find_families);
  command.add_option("SET", options->set, "Measurement set; default: the measurements of the run");
  add_run_option(command, options->run);
  command.add_option("--params", options->params,
                     "Parameter file; default: the run's adopted model, or the built-in parameters");
  add_ranges(command, options->ranges, "the run's, else the thesis'");
  command.add_option("--out", options->out,
                     "Folder to write to, default RUN/families or families; edit families.toml in it and call again");
  command.add_flag("--propose", options->propose,
                   "Write families.toml alone, to be edited; also before the family stage of a game");
  add_fidelity(command, options->fidelity, "; default: the run's, or full");
  command
      .add_option("--samples", options->samples,
                  "How many variants of a family to simulate (thesis: 2000 to 3000 around each seed)")
      ->check(CLI::Range(4, 100'000))
      ->capture_default_str();
  command
      .add_option("--rank", options->rank, "How near to the front a design must be: 1 on it, 2 on the next one, ...")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option("--calibration", options->calibration,
                  "Most parameter sets tried for a family's own model; 0: no model of its own")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command
      .add_option("--cracks", options->cracks,
                  "How many patterns of a family to break for their cracks; from 20 on mechanisms are compared")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command.add_option("--discretisation-floor", options->discretisation_floor,
                     "File of discretisation errors; default: data/discretisation_floor.toml");
  add_seed(command, options->seed, "Seed of every random choice")->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
