#pragma once
// A scenario: the configuration of a run, one documented struct, validated, written back in full to the run's folder.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tester/names.hpp"
#include "thesis/laboratory_rates.hpp"

namespace nacre::game {

struct ProposalSettings {
  std::string algorithm = "nsga2";  ///< one of explore::algorithms()
  int samples = 300;                ///< simulations per gamut, all seeds together
  int seeds = 2;                    ///< independent searches merged into one gamut
  int population = 20;              ///< of each search
  int designs = 4;                  ///< selected for the laboratory each round
  int realisations = 3;  ///< further simulations of T of every candidate for selection, with perturbed parameters
  bool operator==(const ProposalSettings&) const = default;
};

struct ValidationSettings {
  int random_patterns = 6;  ///< stratified random designs measured in round 1 (Table 3.2)
  int replicates = 3;       ///< specimens per design and test
  int enough_valid = 0;     ///< an order is also complete with this many valid specimens; 0 means all replicates
  int calibration_evaluations = 25;  ///< evaluations of the toughness calibration set per round
  int modulus_evaluations = 120;     ///< evaluations of the modulus calibration set per round
  int calibration_batch = 3;         ///< parameter sets evaluated at once
  std::vector<double> mixtures = {0.5,  0.6, 0.65, 0.7,
                                  0.75, 0.8, 0.85, 0.9};  ///< homogeneous benchmark, measured in round 1
  bool approval = false;                                  ///< proposals wait for a person's approval
  bool operator==(const ValidationSettings&) const = default;
};

struct FarmSettings {
  std::string executor =
      "local";  ///< local: threads of the farm's machine; slurm: tasks of a cluster; cuda: fracture tests on a GPU
  std::vector<std::string> slurm_options;  ///< further options of sbatch, e.g. "--partition=short"
  int batch_s = 20;                        ///< work of one task, in seconds of one core
  bool operator==(const FarmSettings&) const = default;
};

struct DiagnosisStageSettings {
  bool enabled = true;
  int discrimination_orders = 2;  ///< extra tests a round that separate rival causes
  int bootstraps = 2000;
  int simulations = 300;  ///< fracture tests that the farm may simulate for each; 0: fracture tests are left out
  bool operator==(const DiagnosisStageSettings&) const = default;
};

/// How many specimens a laboratory can make; 0: no limit. The family stage comes on top.
struct BudgetSettings {
  int specimens_per_round = 0;
  int total = 0;  ///< of all rounds
  bool operator==(const BudgetSettings&) const = default;
};

struct LaboratorySettings {
  bool virtual_lab = true;  ///< false: a person measures, `nacre inject` brings the results
  std::string file;  ///< LAB.toml of the virtual laboratory, relative to the scenario; empty: drawn from the seed
  double layers_per_minute = thesis::kLayersPerMinute;  ///< of the printer
  double minutes_per_test = thesis::kMinutesPerTest;
  double tray_x_mm = thesis::kTrayX, tray_y_mm = thesis::kTrayY;  ///< printable part of the tray
  bool operator==(const LaboratorySettings&) const = default;
};

/// The stage after the last round (thesis 2.4.1).
struct FamilySettings {
  bool enabled = false;
  int rank = 2;                      ///< near-Pareto: measured designs non-dominated up to this rank are the seeds
  int samples = 300;                 ///< variants simulated per family; thesis: 7000 to 9000
  int designs = 3;                   ///< chosen of each family for the laboratory
  int calibration_evaluations = 25;  ///< evaluations of the toughness set for each family's own model
  int modulus_evaluations = 120;     ///< and of the modulus set
  bool operator==(const FamilySettings&) const = default;
};

/// Every node there is, in start order.
inline constexpr std::array<std::string_view, 5> kNodes = {"virtual_lab", "simulator_farm", "analyser",
                                                           "proposal_agent", "validation_agent"};

/// The whole scenario, as in launch/README.md.
struct Scenario {
  std::string name = "unnamed";
  std::uint64_t seed = 1;
  int rounds = 3;  ///< last round number
  tester::Fidelity fidelity = tester::Fidelity::preview;
  bool stop_at_equilibrium = true;
  std::string hosts = "local";  ///< local (ttl 0) or lan (ttl 1)
  int port = 0;                 ///< UDP port of the run; 0 lets the launcher choose a free one
  int farm_threads = 0;         ///< 0 all allowed cores
  std::string benchmark_file;   ///< homogeneous benchmark for l1 when mixtures are not measured
  std::string base_materials_file =
      "data/thesis/base_materials.csv";  ///< real measurements that round 0 is fitted to; empty: not fitted
  std::string model_file;   ///< parameters that round 0 begins with, extensions included; empty: the built-in ones
  std::string ranges_file;  ///< of the parameters, for other inks; empty: the thesis'
  std::string discretisation_floor_file =
      "data/discretisation_floor.toml";  ///< discretisation floor of the diagnosis; empty: none
  FarmSettings farm;
  ProposalSettings proposal;
  ValidationSettings validation;
  DiagnosisStageSettings diagnosis;
  FamilySettings families;
  BudgetSettings budget;
  LaboratorySettings laboratory;
  /// The nodes of this scenario, in start order.
  std::vector<std::string> nodes() const;
  bool operator==(const Scenario&) const = default;
};

/// Reads and validates a scenario. Unknown keys and values out of range throw InputError with file, line, key, value,
/// range. Files that it names are searched in the scenario's folder, in the folders above it, in the working folder,
/// in the folders above it and in what comes with nacre (base/shipped_files.hpp), in this order; the result holds the
/// paths found. A file that is not found is an InputError.
Scenario read_scenario(const std::filesystem::path& path);

/// The same from text, with file names left as written; `source` names the place in errors.
Scenario parse_scenario(std::string_view toml, std::string_view source);

/// Every key with its value and a comment: parse_scenario(to_toml(s), place) == s.
std::string to_toml(const Scenario& scenario);

}  // namespace nacre::game
