#include "laboratory/measure_set.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "laboratory/laboratory_file.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_table.hpp"
#include "measurement/write_set.hpp"

namespace nacre::laboratory {
namespace {

using measurement::SpecimenRecord;

constexpr double kTurnedDeg = 90.0;

bool is_to_be_held(const Experiment& experiment, const Campaign& campaign) {
  return experiment.test == tester::TestKind::modulus && experiment.design.mixture() && !campaign.holds_s.empty();
}

/// The same test at every rate, or after every hold, and temperature of the campaign.
std::vector<Experiment> at_all_conditions(const Experiment& experiment, const Campaign& campaign) {
  std::vector<std::optional<double>> temperatures_c(campaign.temperatures_c.begin(), campaign.temperatures_c.end());
  if (temperatures_c.empty() || experiment.test == tester::TestKind::toughness) temperatures_c = {std::nullopt};
  const bool is_held = is_to_be_held(experiment, campaign);
  std::vector<Experiment> experiments;
  for (const double each : is_held ? campaign.holds_s : campaign.rates_per_s) {
    for (const std::optional<double>& temperature_c : temperatures_c) {
      experiments.push_back(experiment);
      if (is_held)
        experiments.back().hold_s = each;
      else
        experiments.back().conditions.strain_rate_per_s = each;
      experiments.back().temperature_c = temperature_c;
    }
  }
  return experiments;
}

/// What is to be measured: every design once per test, orientation and conditions, in the order given.
std::vector<Experiment> experiments_of(const Truth& truth, const Campaign& campaign) {
  std::vector<Experiment> experiments;
  for (const pattern::Design& design : campaign.designs) {
    for (const tester::TestKind test : campaign.tests) {
      for (const double orientation_deg : campaign.orientations_deg) {
        Experiment experiment{.design = design, .test = test, .conditions = {}, .fidelity = truth.fidelity};
        if (design.layout() != nullptr) experiment.conditions.orientation_deg = orientation_deg;
        if (test == tester::TestKind::tensile) experiment.loading = campaign.loading;
        for (const Experiment& each : at_all_conditions(experiment, campaign))
          if (std::ranges::find(experiments, each) == experiments.end()) experiments.push_back(each);
      }
    }
  }
  return experiments;
}

/// Name of a specimen but for its number; rate, temperature and machine only where there are several.
std::string name_of(const Experiment& experiment, const Campaign& campaign, const std::string& machine) {
  std::string name = fmt::format("{}-{}-{}", experiment.design.name(), tester::to_string(experiment.test),
                                 experiment.conditions.orientation_deg == kTurnedDeg ? "turned-" : "");
  if (experiment.hold_s)
    name += "held-";
  else if (campaign.rates_per_s.size() > 1)
    name += fmt::format("{:g}-", experiment.conditions.strain_rate_per_s);
  if (experiment.temperature_c) name += fmt::format("{:g}C-", *experiment.temperature_c);
  if (campaign.machines.size() > 1) name += machine + "-";
  return name;
}

/// Effort of an experiment, in arbitrary units: a fracture takes thousands of times longer than a modulus.
double effort_of(const Experiment& experiment) { return experiment.test == tester::TestKind::modulus ? 1.0 : 1000.0; }

/// Makes all experiments, reporting progress as they end.
std::vector<Result<TrueResponse>> responses_with_progress(const Truth& truth,
                                                          const std::vector<Experiment>& experiments,
                                                          const CampaignProgress& progress) {
  double whole = 0.0, spent = 0.0;
  for (const Experiment& experiment : experiments) whole += effort_of(experiment);
  int done = 0;
  return responses_to(truth, experiments, [&](std::size_t i) {
    spent += effort_of(experiments[i]);
    if (progress) progress(spent / whole, ++done, static_cast<int>(experiments.size()));
  });
}

/// A specimen to be recorded: of which experiment, and which replicate it is.
struct Planned {
  std::size_t experiment = 0;
  Replicate replicate;
};

/// Numbers the pieces of each batch 1, 2, ... in an order drawn from the seed.
void shuffle_print_order(std::vector<Planned>& plan, std::uint64_t seed) {
  std::map<std::string, std::map<std::uint64_t, std::vector<Replicate*>>> batches;
  for (Planned& planned : plan) {
    const Replicate& replicate = planned.replicate;
    const std::string& piece = replicate.piece.empty() ? replicate.specimen : replicate.piece;
    RandomStream stream(seed, fmt::format("print/{}/{}", replicate.batch, piece));
    batches[replicate.batch][stream.bits()].push_back(&planned.replicate);
  }
  for (auto& [batch, pieces] : batches) {
    int position = 0;
    for (auto& [draw, rows] : pieces) {
      ++position;
      for (Replicate* row : rows) row->print_order = position;
    }
  }
}

/// Beside the set's folder, not in it.
std::filesystem::path truth_file(const std::filesystem::path& folder) {
  // Not `.` or `SET/..`, which have no name.
  return without_last_slash(std::filesystem::weakly_canonical(folder)).concat(".truth.toml");
}

/// A set is not measured over: reviews, and the truth next to it, belong to the specimens that it holds.
void require_new(const std::filesystem::path& folder) {
  std::error_code unreadable;
  if (std::filesystem::exists(folder / measurement::kTableName, unreadable)) {
    throw InputError::format("{}: holds {} specimens; expected a new folder", folder.string(),
                             measurement::SetTable(folder).size());
  }
  const std::filesystem::path truth = truth_file(folder);
  if (!std::filesystem::exists(truth, unreadable)) return;
  throw InputError::format("{}: is the truth of a set that was measured before; expected a new folder", truth.string());
}

}  // namespace

std::vector<SpecimenRecord> measure(const Truth& truth, const Campaign& campaign, const CampaignProgress& progress) {
  const std::vector<Experiment> experiments = experiments_of(truth, campaign);
  const std::vector<Result<TrueResponse>> responses = responses_with_progress(truth, experiments, progress);
  std::vector<Planned> plan;
  for (std::size_t q = 0; q < experiments.size(); ++q) {
    for (int k = 1; k <= truth.replicates; ++k) {
      Replicate replicate{.specimen = {}, .batch = fmt::format("batch-{}", k), .number = k};
      for (std::size_t m = 0; m < std::max<std::size_t>(1, campaign.machines.size()); ++m) {
        if (!campaign.machines.empty()) replicate.machine = campaign.machines[m];
        replicate.on_second_machine = m == 1;
        replicate.specimen = name_of(experiments[q], campaign, replicate.machine) + std::to_string(k);
        if (const auto hold_s = experiments[q].hold_s) {
          replicate.piece = replicate.specimen;
          replicate.specimen += fmt::format("-{:g}s", *hold_s);
        }
        plan.push_back({q, replicate});
      }
    }
  }
  shuffle_print_order(plan, truth.seed);
  std::vector<SpecimenRecord> records;
  for (const Planned& each : plan)
    records.push_back(record_specimen(truth, experiments[each.experiment], responses[each.experiment], each.replicate));
  return records;
}

std::vector<SpecimenRecord> measure_set(const std::filesystem::path& laboratory_file,
                                        const std::filesystem::path& folder, const Campaign& campaign,
                                        const CampaignProgress& progress) {
  const Truth truth = read_laboratory(laboratory_file);
  require_new(folder);
  std::vector<SpecimenRecord> records = measure(truth, campaign, progress);
  measurement::write_measurement_set(folder, records);
  write_sealed(truth_file(folder), truth);
  return records;
}

}  // namespace nacre::laboratory
