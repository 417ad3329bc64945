#include "family_data.hpp"

#include <map>

#include "game/standings.hpp"
#include "laboratory_view.hpp"
#include "material/criterion_strengths.hpp"
#include "material/starting_model.hpp"
#include "output.hpp"
#include "run/journal_messages.hpp"
#include "run_access.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

FamilyData data_of_set(const FamilyOptions& options) {
  const measurement::MeasurementSet set = measurement::read_plausible_set(options.set);
  warn_about(set, options.set);
  const material::StartingModel model = material::starting_model(options.params, options.ranges);
  return {.measured = game::patterns_with_both(set.specimens),
          .parameters = model.parameters,
          .ranges = model.ranges,
          .fidelity = fidelity_from_option(options.fidelity.empty() ? "full" : options.fidelity),
          .staged = {}};
}

std::vector<StagedFamily> staged_families(const RunAccess& run) {
  std::map<int, StagedFamily> families;
  const auto take_family = [&](const std::string& payload) {
    if (auto family = wire::read<wire::CalibratedFamily>(payload)) families[family->number].stated = std::move(*family);
  };
  const auto take_variants = [&](const std::string& payload) {
    const auto chunk = wire::read<wire::FamilyGamut>(payload);
    if (!chunk) return;
    auto& variants = families[chunk->number].variants;
    variants.insert(variants.end(), chunk->samples.begin(), chunk->samples.end());
  };
  run::JournalMessages(run.folder, "validation_agent")
      .read({}, {{"FAMILY", take_family}, {"FAMILY_GAMUT", take_variants}});
  std::vector<StagedFamily> all;
  for (auto& [number, family] : families) all.push_back(std::move(family));
  return all;
}

FamilyData data_of_run(const FamilyOptions& options) {
  const RunAccess run = open_run(options.run);
  const LaboratoryView view = view_laboratory(run);
  if (!view.model) throw InputError::format("{}: no model has been adopted yet", run.folder.string());
  material::ParameterRanges ranges = material::ranges_for(view.model->criterion);
  const std::string& file = options.ranges.empty() ? run.scenario.ranges_file : options.ranges;
  if (!file.empty()) ranges = material::read_ranges(file, ranges);
  const bool same_model = options.params.empty() && options.fidelity.empty();
  return {.measured = game::patterns_with_both(view.facts.book.specimens()),
          .parameters = *view.model,
          .ranges = ranges,
          .fidelity = options.fidelity.empty() ? run.scenario.fidelity : fidelity_from_option(options.fidelity),
          .staged = same_model ? staged_families(run) : std::vector<StagedFamily>{}};
}

}  // namespace

FamilyData family_data(const FamilyOptions& options) {
  FamilyData data = options.set.empty() ? data_of_run(options) : data_of_set(options);
  data.parameters = parameters_from_option(options.params, data.parameters, data.ranges);
  return data;
}

const StagedFamily* staged(const families::SeedFamily& family, const FamilyData& data) {
  for (const StagedFamily& each : data.staged) {
    std::vector<pattern::Pattern> seeds;
    for (const game::FamilyDesign& design : each.stated.designs)
      if (design.is_seed) seeds.push_back(design.pattern);
    if (seeds == family.seeds) return &each;
  }
  return nullptr;
}

}  // namespace nacre::cli
