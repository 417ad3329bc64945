#pragma once
// The input of `nacre families`: everything measured and a model of it, from a run or from a measurement set.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "families/grouping.hpp"
#include "material/ranges.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {

/// The options of `nacre families`.
struct FamilyOptions {
  std::string set;
  std::string run = "logs/latest";
  std::string params, ranges;
  std::string out;
  std::string fidelity;
  std::string discretisation_floor;
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
  wire::CalibratedFamily stated;
  std::vector<explore::Evaluated> variants;
};

struct FamilyData {
  std::vector<measurement::Replicates> measured;  ///< patterns alone
  material::ParameterSet parameters;
  material::ParameterRanges ranges = material::default_ranges();  ///< of a family's own calibration
  tester::Fidelity fidelity = tester::Fidelity::full;
  std::vector<StagedFamily> staged;  ///< of the run's family stage, where one was played
};

/// From the set that the options name, else from the run. Throws InputError.
FamilyData family_data(const FamilyOptions& options);

/// The stage's result for this family, when its seeds are the same.
const StagedFamily* staged(const families::SeedFamily& family, const FamilyData& data);

}  // namespace nacre::cli
