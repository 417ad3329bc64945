#pragma once
// Blind trials: printed and measured by the virtual laboratory, diagnosed by `nacre diagnose` as a program of its own,
// opened for scoring.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../output_of.hpp"
#include "base/random.hpp"
#include "laboratory/laboratory.hpp"
#include "laboratory/laboratory_file.hpp"
#include "measurement/write_set.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::blind {

inline constexpr int kReplicates = 4;

/// A scratch folder of its own, removed at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "nacre-blind-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Modulus specimens of random patterns over the strata, turned twins of the first, checkerboards of the periods given.
inline std::vector<laboratory::Experiment> printed(std::uint64_t seed, int patterns, int twins,
                                                   const std::vector<int>& checkerboards) {
  RandomStream random(seed, "blind trial patterns");
  const std::vector<pattern::Pattern> drawn = pattern::stratified_patterns(patterns, random);
  std::vector<laboratory::Experiment> experiments;
  const auto add = [&](const pattern::Design& design, double orientation_deg) {
    laboratory::Experiment experiment;
    experiment.design = design;
    experiment.conditions.orientation_deg = orientation_deg;
    experiments.push_back(experiment);
  };
  for (const pattern::Pattern& each : drawn) add(each, 0.0);
  for (int i = 0; i < twins; ++i) add(drawn[i], 90.0);
  for (const int period : checkerboards) add(pattern::checkerboard(period), 0.0);
  return experiments;
}

/// LAB.toml; `noise` is the content of its table [noise].
inline std::string laboratory_file(int seed, const std::string& fidelity, const std::string& noise,
                                   const std::string& effect = "", const std::string& value = "") {
  std::string toml =
      "seed = " + std::to_string(seed) + "\nfidelity = \"" + fidelity + "\"\nreplicates = 4\n[noise]\n" + noise;
  if (!effect.empty()) toml += "[[effect]]\nname = \"" + effect + "\"\nvalue = " + value + "\n";
  return toml;
}

struct OpenedTrial {
  nlohmann::json diagnosis;
  laboratory::Truth truth;
};

using PlannedExperiments = std::function<std::vector<laboratory::Experiment>(std::uint64_t seed)>;

/// In which batch a replicate is printed, both counted from 0.
using BatchOf = std::function<int(const laboratory::Experiment&, int replicate)>;

/// What `nacre diagnose SET --fidelity FIDELITY --json` prints, with these further options.
inline nlohmann::json diagnosed(const std::filesystem::path& set, const std::string& fidelity,
                                const std::string& options = "") {
  return nlohmann::json::parse(output_of(std::string(NACRE_BINARY_DIR) + "/nacre diagnose " + set.string() +
                                         " --fidelity " + fidelity + " --json " + options));
}

/// Lays out a trial with `laboratory` (LAB.toml), diagnoses it with `--fidelity FIDELITY` and these options, returns
/// the diagnosis and the opened truth.
inline OpenedTrial run_trial(
    const std::string& laboratory, const PlannedExperiments& experiments, const std::string& fidelity,
    const BatchOf& batch_of = [](const laboratory::Experiment&, int replicate) { return replicate; },
    const std::string& options = "") {
  const Scratch scratch;
  OpenedTrial trial;
  trial.truth = laboratory::parse_laboratory(laboratory, "trial");
  std::vector<measurement::SpecimenRecord> records;
  int print_order = 0;
  std::vector<laboratory::Experiment> planned = experiments(trial.truth.seed);
  for (laboratory::Experiment& each : planned) each.fidelity = trial.truth.fidelity;
  const auto responses = laboratory::responses_to(trial.truth, planned);
  for (std::size_t e = 0; e < planned.size(); ++e) {
    const laboratory::Experiment& experiment = planned[e];
    const Result<laboratory::TrueResponse>& response = responses[e];
    for (int i = 0; i < kReplicates; ++i) {
      std::string name = experiment.design.name() + "-" + std::string(tester::to_string(experiment.test)) +
                         (experiment.conditions.orientation_deg > 0 ? "-turned-" : "-") + std::to_string(i);
      if (experiment.conditions.strain_rate_per_s != tester::TestConditions{}.strain_rate_per_s)
        name += "-at-" + std::to_string(experiment.conditions.strain_rate_per_s);
      if (experiment.temperature_c) name += "-" + std::to_string(*experiment.temperature_c) + "C";
      records.push_back(laboratory::record_specimen(trial.truth, experiment, response,
                                                    {.specimen = name,
                                                     .batch = "batch " + std::to_string(1 + batch_of(experiment, i)),
                                                     .print_order = ++print_order,
                                                     .number = i + 1}));
    }
  }
  measurement::write_measurement_set(scratch.folder() / "set", records);
  trial.diagnosis = diagnosed(scratch.folder() / "set", fidelity, options);
  return trial;
}

/// The hidden effect alone is named, its size lies within `tolerance` (relative), and the extended model predicts
/// held-out patterns better.
inline void expect_found(const OpenedTrial& trial, const std::string& effect, double value, double tolerance) {
  const nlohmann::json& d = trial.diagnosis;
  ASSERT_EQ(d["verdict"], "named") << d["summary"] << d["candidates"].dump(1);
  ASSERT_EQ(d["effects"].size(), 1u) << d["summary"];
  EXPECT_EQ(d["effects"][0]["name"], effect);
  EXPECT_NEAR(d["effects"][0]["parameter"].get<double>(), value, tolerance * std::abs(value));
  EXPECT_LT(d["gain"]["held_out_error_after"].get<double>(), d["gain"]["held_out_error_before"].get<double>());
}

}  // namespace nacre::blind
