#pragma once
// The measured tables that a game starts from: the base materials of round 0 and, where a scenario names it, the
// homogeneous benchmark line. CSV, columns by name.

#include <filesystem>
#include <vector>

#include "measurement/summary.hpp"
#include "optimize/pareto.hpp"

namespace nacre::game {

/// Measured E and T of TB (soft), VW (rigid) and IF (interface): columns `material`, `measured_modulus_gpa`,
/// `measured_toughness_mpa` (thesis Table 3.4). Each material once, in this order. Throws InputError naming file, line,
/// column.
std::vector<measurement::Replicates> read_base_materials(const std::filesystem::path& path);

/// Columns `modulus_gpa`, `toughness_mpa`: points of l1 by increasing modulus. Throws InputError naming file, line,
/// column.
std::vector<optimize::Performance> read_benchmark_line(const std::filesystem::path& path);

}  // namespace nacre::game
