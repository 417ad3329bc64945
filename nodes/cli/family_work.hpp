#pragma once
// One family worked out: its model, dense samples around its seeds, a map of each seed's surroundings, its cracks.

#include <filesystem>

#include <nlohmann/json.hpp>

#include "family_data.hpp"
#include "sysid/local_simulator.hpp"

namespace nacre::cli {

/// Writes parameters.toml, gamut.csv, a map of every seed and mechanisms.csv into the folder, and returns what of them
/// the command prints. Throws InputError.
nlohmann::ordered_json work_out(const families::SeedFamily& family, const FamilyData& data,
                                const FamilyOptions& options, const std::filesystem::path& folder,
                                sysid::LocalSimulator& simulator);

}  // namespace nacre::cli
