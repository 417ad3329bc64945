#pragma once
// Cracks of a family's patterns, and which of their mechanisms correlate with toughness (thesis 2.4, 3.4).

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crack/mechanisms.hpp"
#include "material/parameters.hpp"
#include "optimize/pareto.hpp"
#include "pattern/layout.hpp"

namespace nacre::cli {

using Performances = std::map<pattern::Pattern, optimize::Performance>;

/// A pattern that was broken for its crack.
struct CrackedPattern {
  pattern::Pattern pattern;
  double modulus_pa = 0.0, toughness_pa = 0.0;
  crack::Mechanisms mechanisms;
};

/// The first `count` members, seeds among them, broken once more for their cracks.
std::vector<CrackedPattern> broken(const std::string& task, const std::vector<pattern::Pattern>& members, int count,
                                   const material::ParameterSet& parameters, tester::Fidelity fidelity,
                                   const Performances& performances);

/// mechanisms.csv, and what correlates with T when rigid fraction and E are held: evidence, not cause. Nothing of fewer
/// than twenty patterns.
nlohmann::ordered_json mechanisms_of_family(const std::vector<CrackedPattern>& cracked,
                                            const std::filesystem::path& file, std::uint64_t seed);

}  // namespace nacre::cli
