// Part of the command line (command.hpp): nacre select, the samples of a gamut that are worth a measurement.

#include "select/select.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "command.hpp"
#include "explore/gamut_csv.hpp"
#include "game/standings.hpp"
#include "output.hpp"

namespace nacre::cli {
namespace {

struct SelectOptions {
  std::string gamut;
  std::string measured;
  int count = 8;
  bool json = false;
};

/// Patterns that are measured already, and the line of homogeneous mixtures (l1 of the thesis) as a game draws it.
struct MeasuredDesigns {
  std::vector<pattern::Pattern> patterns;  ///< sorted
  std::vector<optimize::Performance> benchmark;
};

MeasuredDesigns read_measured(const std::string& folder) {
  MeasuredDesigns measured;
  if (folder.empty()) return measured;
  const measurement::MeasurementSet set = measurement::read_measurement_set(folder);
  warn_about(set, folder);
  std::set<pattern::Pattern> patterns;
  for (const measurement::Replicates& design : measurement::summarise(set.specimens)) {
    if (const auto pattern = game::eightfold_pattern(design.design)) patterns.insert(*pattern);
  }
  measured.patterns.assign(patterns.begin(), patterns.end());
  measured.benchmark = game::benchmark_line(set.specimens);
  return measured;
}

std::string why_nothing(const std::vector<explore::Evaluated>& gamut, const MeasuredDesigns& measured) {
  if (gamut.empty()) return "nothing to select: the gamut holds no sample";
  if (std::ranges::all_of(
          gamut, [&](const auto& each) { return std::ranges::binary_search(measured.patterns, each.pattern); }))
    return "nothing to select: every sample of the gamut was measured already";
  return "nothing to select: no sample of the gamut is better than the homogeneous mixtures and the measured designs";
}

int select_samples(const SelectOptions& options) {
  const std::vector<explore::Evaluated> gamut = explore::read_gamut_csv(options.gamut);
  const MeasuredDesigns measured = read_measured(options.measured);
  const auto selected = select::select_designs(gamut, measured.patterns, measured.benchmark, {.count = options.count});
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const select::Selected& one : selected) {
    document.push_back({{"key", one.pattern.key()},
                        {"modulus_pa", one.predicted.modulus_pa},
                        {"toughness_pa", one.predicted.toughness_pa},
                        {"reason", one.reason},
                        {"bin", one.bin}});
    if (options.json) continue;
    fmt::print("{}  E {} GPa  T {} MPa  {}\n", one.pattern.key(), shown(1e-9 * one.predicted.modulus_pa),
               shown(1e-6 * one.predicted.toughness_pa), one.reason);
  }
  if (options.json) print_json(document);
  if (!selected.empty() && selected.size() < static_cast<std::size_t>(options.count))
    remark(fmt::format("{} of {} designs: no other sample of the gamut is worth a measurement", selected.size(),
                       options.count));
  if (selected.empty()) remark(why_nothing(gamut, measured));
  return selected.empty() ? 1 : 0;
}

}  // namespace

void add_select(CLI::App& app, Action& action) {
  const auto options = std::make_shared<SelectOptions>();
  CLI::App& command = add_command(app, action, "select", "Choose the samples of a gamut that are worth a measurement",
                                  options, select_samples);
  command.add_option("GAMUT", options->gamut, "gamut.csv, as nacre explore writes it")->required();
  command.add_option("--measured", options->measured,
                     "Measurement set: patterns that are measured already, and homogeneous mixtures to beat");
  command.add_option("--count", options->count, "How many to choose")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
