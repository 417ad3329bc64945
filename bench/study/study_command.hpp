#pragma once
// The command line that studies share.

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace nacre::study {

/// Options of every study with a table of finished simulations.
struct TableOptions {
  std::string table;
  std::uint64_t seed = 1;
  double seconds = 1e9;
  int threads = 0;
};

/// Adds --table, --seed, --seconds and --threads; `seed_of` says what the seed draws.
void add_table_options(CLI::App& app, TableOptions& options, const std::string& seed_of);

/// Adds --fidelity.
CLI::Option* add_fidelity_option(CLI::App& app, std::string& fidelity);

/// Exit status of a program whose work is `run`: 2 with the reason on standard error after an InputError, else 0.
int exit_status_of(const std::function<void()>& run);

}  // namespace nacre::study
