#pragma once
// A run read back from its run.db, for reports. Everyone but the analyser opens the file read-only.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crack/crack_record.hpp"
#include "explore/search.hpp"
#include "measurement/specimen_record.hpp"
#include "optimize/pareto.hpp"
#include "wire/convert.hpp"

namespace nacre::store {

struct RecordedEffect {
  std::string name, unit;
  double parameter = 0.0, interval_low = 0.0, interval_high = 0.0;
};

struct RecordedCandidate {
  std::string name, status;
  double statistic = 0.0, p_family_wise = 1.0, absorption = 0.0;
};

struct RecordedDiagnosis {
  std::string verdict, summary;
  std::vector<RecordedEffect> effects;
  std::vector<RecordedCandidate> candidates;
  std::optional<double> held_out_error_before, held_out_error_after;
};

struct RecordedProposal {
  std::string design, reason;
  optimize::Performance predicted;
};

struct RecordedSimulation {
  optimize::Performance performance;
  std::string failure;
  tester::Curve curve;
};

/// How a model lets a design break.
struct RecordedCrack {
  crack::CrackRecord crack;  ///< order without strains
  int broken = 0;
  std::string film;  ///< file in RUN/films; empty when there is none
};

/// One round; parts that have not been received yet are empty.
struct RoundRecord {
  std::optional<wire::RoundSummary> summary;
  std::map<std::string, double> parameters;
  sysid::GoodnessOfFit modulus_fit, toughness_fit;  ///< of the calibration; count 0: not known
  std::vector<optimize::Performance> benchmark;
  std::vector<optimize::Performance> gamut;
  std::vector<RecordedProposal> proposals;
  std::optional<RecordedDiagnosis> diagnosis;
  std::map<std::string, RecordedSimulation> simulated;  ///< by design
  std::map<std::string, RecordedCrack> cracks;          ///< of the proposals, by design
};

struct MeasuredSpecimen {
  int round = -1;
  measurement::SpecimenRecord record;  ///< validity as reviewed
};

/// A family of the stage after the game; `stated.parameters` holds no values here, `parameters` names them.
struct RecordedFamily {
  wire::CalibratedFamily stated;
  std::map<std::string, double> parameters;
  std::vector<explore::Evaluated> gamut;        ///< its variants by its own model
  std::map<std::string, RecordedCrack> cracks;  ///< of its seeds and chosen designs by its own model, by design
};

struct RunRecord {
  std::map<int, RoundRecord> rounds;
  std::vector<RecordedFamily> families;     ///< by number; empty where no stage was played
  std::vector<MeasuredSpecimen> specimens;  ///< by name
};

/// `with_gamuts`: the gamuts, too, which are most of a large run (read_gamut() has one with its patterns). Throws
/// InputError naming the file when it cannot be read.
RunRecord read_run_record(const std::filesystem::path& path, bool with_gamuts = true);

/// The patterns that the search of a round evaluated, by key; two columns of equal length.
struct RecordedGamut {
  std::vector<std::uint64_t> patterns;  ///< bits, as pattern::Pattern
  std::vector<optimize::Performance> performances;
};

/// How many patterns the gamut of each round has; rounds without one are absent.
std::map<int, int> read_gamut_sizes(const std::filesystem::path& path);

/// Throws InputError naming the file when it cannot be read. 100,000 patterns take about 0.1 s.
RecordedGamut read_gamut(const std::filesystem::path& path, int round);

}  // namespace nacre::store
