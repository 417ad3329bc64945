#pragma once

#include <cstdint>
#include <filesystem>

namespace nacre::load {

struct Options {
  std::filesystem::path folder = "logs/load";  ///< made by the program; must not exist
  int simulations = 100'000, gamut = 100'000, measurements = 10'000, designs = 200, rounds = 5;
  std::uint64_t seed = 1;
};

/// The farm's cache with `simulations` results: writing, opening with its check, reading.
void load_cache(const Options& options);
/// A run with a gamut of `gamut` samples and `measurements` specimens: its database, its reading, its report.
void load_run(const Options& options);
/// A game with real processes into which `measurements` specimens are injected, while a person asks for its state.
void load_injection(const Options& options);

}  // namespace nacre::load
