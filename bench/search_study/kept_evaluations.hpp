#pragma once

#include <optional>

#include "commands.hpp"
#include "material/parameters.hpp"
#include "study/study_table.hpp"
#include "tester/names.hpp"

namespace nacre::search_study {

/// Modulus and toughness of patterns for one parameter set and fidelity; what was simulated once stands in a CSV file
/// (key,modulus_pa,toughness_pa; negative: the simulation failed). The key of a specimen N other than the first is
/// KEY/N.
class KeptEvaluations {
 public:
  explicit KeptEvaluations(const Options& options);
  struct KeptPerformance {
    std::optional<optimize::Performance> performance;
    double processor_s = 0.0;  ///< 0 when it was looked up
  };
  /// Thread-safe.
  KeptPerformance operator()(const pattern::Pattern& pattern, int specimen = 0);

 private:
  std::optional<tester::Fidelity> fidelity_;
  material::ParameterSet parameters_;
  study::StudyTable table_;
};

/// What `learned` may compute, as the options allow.
explore::Mechanics mechanics_of(const Options& options);

}  // namespace nacre::search_study
