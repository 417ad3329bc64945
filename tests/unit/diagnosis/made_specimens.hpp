#pragma once
// Moduli of homogeneous specimens by a law of their conditions.

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

using Columns = std::map<std::string, std::string>;

/// One homogeneous specimen of a modulus test.
struct Made {
  double rigid_share = 1.0;
  double rate_per_s = 1e-3;
  Columns columns = {};
};

/// Three of each, that scatter by 3 % about `law`.
inline std::vector<measurement::SpecimenRecord> specimens_of(const std::vector<Made>& all,
                                                             const std::function<double(const Made&)>& law) {
  RandomStream noise(21, "test/factors");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const Made& made : all) {
    for (int r = 0; r < 3; ++r) {
      measurement::SpecimenRecord& specimen = specimens.emplace_back();
      specimen.specimen = std::to_string(specimens.size());
      specimen.design = pattern::Mixture{made.rigid_share};
      specimen.conditions.strain_rate_per_s = made.rate_per_s;
      for (const auto& [name, value] : made.columns) specimen.other_columns[name] = value;
      specimen.modulus_pa = 2e9 * law(made) * std::exp(0.03 * noise.normal());
    }
  }
  return specimens;
}

inline DiagnosisSettings quick_settings() {
  DiagnosisSettings settings;
  settings.fidelity = tester::Fidelity::tiny;
  settings.check_discretisation = false;
  return settings;
}

}  // namespace nacre::diagnosis
