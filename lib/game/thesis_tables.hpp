#pragma once
// Tables 3.4 and A.3 to A.6 of the thesis (data/thesis), for comparison.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "game/family_errors.hpp"

namespace nacre::game {

/// A design of Tables A.3 and A.4, Pa.
struct ThesisSample {
  int number = 0, round = 0;  ///< measured in that round; 1 to 10 are random patterns
  double rigid_fraction = 0.0;
  DesignValues measured;
  std::array<DesignValues, 5> simulated;  ///< by the models of the initial round and of rounds 1 to 4
};

/// A design of Tables A.5 and A.6, Pa.
struct ThesisFamilySample {
  int family = 0;
  bool is_seed = false;
  std::string name;  ///< 22, F1-1
  double rigid_fraction = 0.0;
  DesignValues measured, global_model, family_model;
};

/// A row of Table 3.4, Pa.
struct ThesisMaterial {
  std::string name;  ///< TB, VW, IF
  DesignValues measured, simulated;
};

struct ThesisTables {
  std::vector<ThesisSample> samples;
  std::vector<ThesisFamilySample> families;
  std::vector<ThesisMaterial> materials;
};

/// Reads `folder` (data/thesis). Throws InputError naming file, line, column.
ThesisTables read_thesis_tables(const std::filesystem::path& folder);

}  // namespace nacre::game
