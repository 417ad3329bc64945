// nacre families: which families of good designs there are, their variants, and a map of each (thesis 2.4).

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "crack/mechanisms.hpp"
#include "explore/gamut_csv.hpp"
#include "families/dense_sampling.hpp"
#include "families/evidence.hpp"
#include "families/grouping.hpp"
#include "families/subfamily.hpp"
#include "game/standings.hpp"
#include "laboratory_view.hpp"
#include "material/parameters.hpp"
#include "output.hpp"
#include "output_path.hpp"
#include "progress.hpp"
#include "run_access.hpp"
#include "shipped_files.hpp"
#include "sysid/offline.hpp"
#include "wire/codec.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

using families::Family;
using pattern::Pattern;

constexpr double kEstablished = 0.05;  // family-wise

struct Options {
  std::string set;
  std::string run = "logs/latest";
  std::string params;
  std::string out;
  std::string fidelity;
  std::string numerics_floor;
  int samples = 300;
  int rank = 2;
  int calibration = 25;
  int cracks = 60;
  std::uint64_t seed = 1;
  bool propose = false;
  bool json = false;
};

/// A family that the validation agent worked out: its model need not be calibrated, its variants not be simulated
/// again.
struct StagedFamily {
  wire::Family stated;
  std::vector<explore::Evaluated> variants;
};

/// What is begun with: everything measured, and a model of it.
struct Beginning {
  std::vector<measurement::Replicates> measured;  ///< patterns alone
  material::ParameterSet parameters;
  tester::Fidelity fidelity = tester::Fidelity::full;
  std::vector<StagedFamily> staged;  ///< of the run's family stage, where one was played
};

std::filesystem::path folder_of(const Options& options) {
  if (!options.out.empty()) return options.out;
  return options.set.empty() ? std::filesystem::path(options.run) / "families" : std::filesystem::path("families");
}

Beginning beginning_of_set(const Options& options) {
  const measurement::MeasurementSet set = measurement::read_plausible_set(options.set);
  warn_about(set, options.set);
  return {.measured = game::patterns_with_both(set.specimens),
          .parameters = material::default_parameters(),
          .fidelity = fidelity_from_option(options.fidelity.empty() ? "full" : options.fidelity),
          .staged = {}};
}

std::vector<StagedFamily> staged_families(const RunAccess& run) {
  std::map<int, StagedFamily> families;
  const auto take_family = [&](const std::string& payload) {
    if (auto family = wire::read<wire::Family>(payload)) families[family->number].stated = std::move(*family);
  };
  const auto take_variants = [&](const std::string& payload) {
    const auto chunk = wire::read<wire::FamilyGamut>(payload);
    if (!chunk) return;
    auto& variants = families[chunk->number].variants;
    variants.insert(variants.end(), chunk->samples.begin(), chunk->samples.end());
  };
  read_validation_agent(run, {}, {{"FAMILY", take_family}, {"FAMILY_GAMUT", take_variants}});
  std::vector<StagedFamily> all;
  for (auto& [number, family] : families) all.push_back(std::move(family));
  return all;
}

/// The stage's word on this family, when its seeds are the same.
const StagedFamily* staged(const Family& family, const Beginning& beginning) {
  for (const StagedFamily& each : beginning.staged) {
    std::vector<Pattern> seeds;
    for (const game::FamilyDesign& design : each.stated.designs)
      if (design.is_seed) seeds.push_back(design.pattern);
    if (seeds == family.seeds) return &each;
  }
  return nullptr;
}

Beginning beginning_of_run(const Options& options) {
  const RunAccess run = open_run(options.run);
  const auto adopted = adopted_parameters(run);
  if (!adopted) throw InputError::format("{}: no model has been adopted yet", run.folder.string());
  const bool same_question = options.params.empty() && options.fidelity.empty();
  return {.measured = game::patterns_with_both(view_laboratory(run).facts.book.specimens()),
          .parameters = *adopted,
          .fidelity = options.fidelity.empty() ? run.scenario.fidelity : fidelity_from_option(options.fidelity),
          .staged = same_question ? staged_families(run) : std::vector<StagedFamily>{}};
}

/// families.toml of the folder when a person or a former call left one, else a proposal, which is written there.
std::vector<Family> families_in(const std::filesystem::path& folder, const std::vector<families::Member>& designs) {
  const std::filesystem::path file = folder / "families.toml";
  const std::vector<Family> proposed = families::proposed_families(designs);
  if (std::filesystem::exists(file)) {
    std::vector<Family> known = families::read_families(file);
    remark(fmt::format("families and their seeds are those of {}", file.string()));
    if (known != proposed)
      warn(fmt::format("{}: other families than these measurements propose; without this file they are proposed anew",
                       file.string()));
    return known;
  }
  write_file_atomically(file, families::to_toml(proposed));
  return proposed;
}

/// A model of one family: its designs weigh 1, the others 0.1.
sysid::Calibrated family_model(const Family& family, const Beginning& beginning, const Options& options,
                               sysid::LocalSimulator& simulator) {
  sysid::CalibrationSettings settings;
  settings.start = beginning.parameters;
  settings.toughness_budget = options.calibration;
  settings.seed = options.seed;
  settings.floor = sysid::read_numerics_floor(numerics_floor_file(options.numerics_floor), beginning.fidelity);
  for (const measurement::Replicates& group : beginning.measured)
    settings.weights.push_back(families::calibration_weight(family, *game::eightfold_pattern(group.design)));
  Progress progress(family.name + ": calibrating");
  return sysid::run_calibration(beginning.measured, settings, simulator, [&](double share, std::string_view what) {
    progress.set_share(share, std::string(what));
  });
}

using Performances = std::map<Pattern, optimize::Performance>;

/// Simulates what `known` lacks; failed simulations stay out.
void simulate(const std::string& task, const std::vector<Pattern>& patterns, const material::ParameterSet& parameters,
              sysid::LocalSimulator& simulator, Performances& known) {
  std::vector<measurement::Replicates> wanted;
  for (const Pattern& pattern : patterns) {
    if (known.contains(pattern)) continue;
    wanted.emplace_back().design = pattern;
    wanted.back().modulus_count = wanted.back().toughness_count = 1;
  }
  Progress progress(task, 2 * static_cast<std::int64_t>(wanted.size()));  // both tests
  const auto predictions = sysid::predict({parameters}, wanted, simulator, [&] { progress.advance(); }).front();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (predictions[i].modulus_pa && predictions[i].toughness_pa)
      known[*game::eightfold_pattern(wanted[i].design)] = {*predictions[i].modulus_pa, *predictions[i].toughness_pa};
  }
}

std::vector<Pattern> sampled_densely(const Family& family, const Options& options) {
  families::DenseSampler sampler(family.seeds, {.seed = options.seed});
  while (static_cast<int>(sampler.members().size()) < options.samples && !sampler.exhausted()) sampler.next();
  return sampler.members();
}

/// Seeds, then the stage's variants; without a stage, sampled now.
std::vector<Pattern> members_of(const Family& family, const StagedFamily* stage, const Options& options) {
  if (stage == nullptr) return sampled_densely(family, options);
  std::vector<Pattern> members = family.seeds;
  for (const explore::Evaluated& variant : stage->variants)
    if (std::ranges::count(family.seeds, variant.pattern) == 0) members.push_back(variant.pattern);
  return members;
}

std::string map_csv(const families::Subfamily& subfamily, const Performances& performances) {
  std::string text = "pattern,source,x,y,x_sampled,y_sampled,rigid_fraction,modulus_pa,toughness_pa\n";
  for (std::size_t i = 0; i < subfamily.members.size(); ++i) {
    const Pattern& pattern = subfamily.members[i];
    const auto found = performances.find(pattern);
    const auto row = subfamily.map.points.row(static_cast<Eigen::Index>(i));
    std::string before = ",";
    if (i < subfamily.sampled) {
      const auto sampled = subfamily.sampled_map.points.row(static_cast<Eigen::Index>(i));
      before = fmt::format("{:.5g},{:.5g}", sampled.x(), sampled.y());
    }
    text += fmt::format("{},{},{:.5g},{:.5g},{},{:.4f}", pattern.key(),
                        i == 0                  ? "seed"
                        : i < subfamily.sampled ? "sampled"
                                                : "interpolated",
                        row.x(), row.y(), before, pattern.rigid_fraction());
    text += found == performances.end()
                ? ",,\n"
                : fmt::format(",{:.6g},{:.6g}\n", found->second.modulus_pa, found->second.toughness_pa);
  }
  return text;
}

nlohmann::ordered_json errors_json(const sysid::PredictionErrors& errors) {
  return {{"count", errors.toughness_count}, {"E_mean", errors.modulus_mean}, {"T_mean", errors.toughness_mean}};
}

/// Errors on the family's own designs.
sysid::PredictionErrors own_errors(const Family& family, const Beginning& beginning,
                                   const material::ParameterSet& parameters, sysid::LocalSimulator& simulator) {
  std::vector<measurement::Replicates> own;
  for (const measurement::Replicates& group : beginning.measured)
    if (std::ranges::count(family.seeds, *game::eightfold_pattern(group.design)) > 0) own.push_back(group);
  return sysid::prediction_errors(own, sysid::predict({parameters}, own, simulator).front());
}

/// One pattern whose crack was looked at.
struct Cracked {
  Pattern pattern;
  double modulus_pa = 0.0, toughness_pa = 0.0;
  crack::Mechanisms mechanisms;
};

/// The first `count` members, seeds among them, broken once more for their cracks.
std::vector<Cracked> broken(const std::string& task, const std::vector<Pattern>& members, int count,
                            const material::ParameterSet& parameters, tester::Fidelity fidelity,
                            const Performances& performances) {
  const int wanted = std::min(count, static_cast<int>(members.size()));
  std::vector<std::optional<Cracked>> found(static_cast<std::size_t>(wanted));
  Progress progress(task, wanted);
  parallel_for(wanted, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    const auto known = performances.find(members[index]);
    const tester::Simulation simulation{members[index], parameters, {}, fidelity};
    const auto result = tester::test_toughness(simulation);
    if (result && known != performances.end())
      found[index] = {members[index], known->second.modulus_pa, result->toughness_pa,
                      crack::mechanisms_of(simulation, crack::record_of(simulation, result->breaks))};
    progress.advance();
  });
  std::vector<Cracked> all;
  for (const std::optional<Cracked>& each : found)
    if (each) all.push_back(*each);
  return all;
}

/// mechanisms.csv, and what goes with T when rigid fraction and E are held: evidence, not cause.
nlohmann::ordered_json mechanisms_of_family(const std::vector<Cracked>& cracked, const std::filesystem::path& file,
                                            std::uint64_t seed) {
  std::string text = "pattern,rigid_fraction,modulus_pa,toughness_pa";
  std::vector<families::Column> features, controls = {{"rigid_fraction", {}}, {"modulus_pa", {}}};
  families::Column outcome{"toughness_pa", {}};
  for (const crack::Mechanism& mechanism : crack::mechanism_names()) {
    text += fmt::format(",{}", mechanism.name);
    features.push_back({std::string(mechanism.name), {}});
  }
  for (const Cracked& each : cracked) {
    text += fmt::format("\n{},{:.4f},{:.6g},{:.6g}", each.pattern.key(), each.pattern.rigid_fraction(), each.modulus_pa,
                        each.toughness_pa);
    controls[0].values.push_back(each.pattern.rigid_fraction());
    controls[1].values.push_back(each.modulus_pa);
    outcome.values.push_back(each.toughness_pa);
    const auto values = crack::values_of(each.mechanisms);
    for (std::size_t k = 0; k < values.size(); ++k) {
      text += fmt::format(",{:.5g}", values[k]);
      features[k].values.push_back(values[k]);
    }
  }
  write_file_atomically(file, text + "\n");
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  if (cracked.size() < 20) return document;  // nothing could be said
  for (const families::Association& each : families::associations(features, outcome, controls, seed))
    document.push_back({{"mechanism", each.feature},
                        {"patterns", cracked.size()},
                        {"spearman_with_toughness", each.spearman},
                        {"partial", each.partial},
                        {"p_family_wise", each.p_family_wise}});
  return document;
}

/// Calibration, dense sampling and maps of one family, written into its folder.
nlohmann::ordered_json work_out(const Family& family, const Beginning& beginning, const Options& options,
                                sysid::LocalSimulator& simulator) {
  const std::filesystem::path folder = folder_of(options) / family.name;
  const StagedFamily* stage = staged(family, beginning);
  const std::vector<Pattern> members = members_of(family, stage, options);
  for (const Pattern& seed : family.seeds) families::members_near(seed, members);  // before hours of work on them
  prepare_output_folder(folder.string());
  material::ParameterSet parameters = beginning.parameters;
  nlohmann::ordered_json document = {{"name", family.name}, {"seeds", family.seeds.size()}};
  document["errors_of_the_global_model"] = errors_json(own_errors(family, beginning, parameters, simulator));
  if (stage != nullptr) {
    parameters = stage->stated.parameters;
    document["errors_of_the_family_model"] = errors_json(own_errors(family, beginning, parameters, simulator));
  } else if (options.calibration > 0) {
    parameters = family_model(family, beginning, options, simulator).parameters;
    document["errors_of_the_family_model"] = errors_json(own_errors(family, beginning, parameters, simulator));
  }
  write_file_atomically(folder / "parameters.toml", material::to_toml(parameters));
  Performances performances;
  if (stage != nullptr)
    for (const explore::Evaluated& variant : stage->variants) performances[variant.pattern] = variant.performance;
  simulate(family.name + ": dense samples", members, parameters, simulator, performances);
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  for (const Pattern& seed : family.seeds) {
    Progress progress(family.name + ": map of " + seed.key());
    const families::Subfamily subfamily =
        families::subfamily_of(seed, members, {}, [&](double share) { progress.set_share(share, ""); });
    progress.end();
    simulate(family.name + ": interpolated", subfamily.members, parameters, simulator, performances);
    write_file_atomically(folder / (seed.key() + ".csv"), map_csv(subfamily, performances));
    maps.push_back({{"seed", seed.key()},
                    {"sampled", subfamily.sampled},
                    {"interpolated", subfamily.members.size() - subfamily.sampled},
                    {"growth", subfamily.growth()},
                    {"residual_variance", subfamily.map.residual_variance},
                    {"bridges", subfamily.map.bridges}});
  }
  std::vector<explore::Evaluated> gamut;
  for (const auto& [pattern, performance] : performances) gamut.push_back({pattern, performance});
  explore::write_gamut_csv(folder / "gamut.csv", gamut);
  document["samples"] = gamut.size();
  document["maps"] = maps;
  document["mechanisms"] = mechanisms_of_family(
      broken(family.name + ": cracks", members, options.cracks, parameters, beginning.fidelity, performances),
      folder / "mechanisms.csv", options.seed);
  return document;
}

void print_family(const nlohmann::ordered_json& family) {
  fmt::print("{}: {} seeds, {} samples\n", family["name"].get<std::string>(), family["seeds"].get<int>(),
             family["samples"].get<int>());
  for (const auto& map : family["maps"])
    fmt::print("  {}  {} sampled, {} interpolated (+{:.1f} %; thesis, Table A.7: 4.5 %), map explains {:.1f} %\n",
               map["seed"].get<std::string>(), map["sampled"].get<int>(), map["interpolated"].get<int>(),
               100.0 * map["growth"].get<double>(), 100.0 * (1.0 - map["residual_variance"].get<double>()));
  if (family["mechanisms"].empty()) return;
  fmt::print(
      "  what goes with toughness among patterns of equal rigid fraction and modulus ({} broken; evidence, not "
      "cause):\n",
      family["mechanisms"][0]["patterns"].get<int>());
  for (const auto& found : family["mechanisms"]) {
    const double p = found["p_family_wise"].get<double>();
    fmt::print("    {:<11} {:+.2f}, p {:.3f}{}\n", found["mechanism"].get<std::string>(),
               found["partial"].get<double>(), p, p < kEstablished ? "" : ": no more than chance would give");
  }
}

void print_proposed(const std::vector<Family>& proposed, const std::filesystem::path& file, bool json) {
  nlohmann::ordered_json document = {{"file", file.string()}, {"families", nlohmann::ordered_json::array()}};
  for (const Family& family : proposed) {
    if (!json) fmt::print("{}: {} seeds\n", family.name, family.seeds.size());
    auto& entry = document["families"].emplace_back(nlohmann::ordered_json{{"name", family.name}});
    for (const Pattern& seed : family.seeds) entry["seeds"].push_back(seed.key());
  }
  json ? print_json(document) : fmt::print("{}\n", file.string());
}

int find_families(const Options& options) {
  Beginning beginning = options.set.empty() ? beginning_of_run(options) : beginning_of_set(options);
  beginning.parameters = parameters_from_option(options.params, beginning.parameters);
  std::vector<families::Member> members;
  for (const measurement::Replicates& group : beginning.measured)
    members.push_back({*game::eightfold_pattern(group.design), {group.modulus_pa, group.toughness_pa}});
  const std::vector<families::Member> near = families::near_pareto(members, options.rank);
  if (near.empty()) {
    remark("no pattern has been measured in both tests yet");
    nlohmann::ordered_json none = nlohmann::ordered_json::array();
    if (options.propose) none = {{"families", nlohmann::ordered_json::array()}};
    if (options.json) print_json(none);
    return 1;
  }
  std::erase_if(beginning.measured, [&](const measurement::Replicates& group) {
    return std::ranges::count(near, *game::eightfold_pattern(group.design), &families::Member::pattern) == 0;
  });
  const std::filesystem::path folder = folder_of(options);
  prepare_output_folder(folder.string());
  if (options.propose) {
    print_proposed(families_in(folder, near), folder / "families.toml", options.json);
    return 0;
  }
  sysid::LocalSimulator simulator(beginning.fidelity, 0, folder / "simulations.bin");
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const Family& family : families_in(folder, near)) {
    document.push_back(work_out(family, beginning, options, simulator));
    if (!options.json) print_family(document.back());
  }
  write_file_atomically(folder / "families.json", document.dump(2) + "\n");
  if (options.json) print_json(document);
  return 0;
}

}  // namespace

void add_families(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add_command(app, action, "families",
                                  "Group the best measured designs, sample around them, and map what was found",
                                  options, find_families);
  command.add_option("SET", options->set, "Measurement set; default: what the run has measured");
  add_run_option(command, options->run);
  command.add_option("--params", options->params,
                     "Parameter file; default: the run's adopted model, or the built-in parameters");
  command.add_option("--out", options->out,
                     "Folder, default RUN/families or families; families.toml in it may be edited, then call again");
  command.add_flag("--propose", options->propose,
                   "Write families.toml alone: to be edited, also before the family stage of a game");
  command.add_option("--fidelity", options->fidelity, "Size of the specimens; default: the run's, or full");
  command.add_option("--samples", options->samples, "Patterns of a family (thesis: 2000 to 3000 around each seed)")
      ->check(CLI::Range(4, 100'000))
      ->capture_default_str();
  command.add_option("--rank", options->rank, "Near-Pareto: non-dominated up to this rank")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--calibration", options->calibration, "Evaluations of a family's own calibration; 0: none")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command
      .add_option("--cracks", options->cracks,
                  "Patterns of a family whose cracks are looked at; from 20 on mechanisms are compared")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command.add_option("--numerics-floor", options->numerics_floor, "Default: data/numerics_floor.toml");
  add_seed(command, options->seed, "Of every random choice")->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
