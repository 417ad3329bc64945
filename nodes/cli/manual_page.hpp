#pragma once
// Manual pages of the command line, from what CLI11 knows of commands and options.

#include <string>

#include <CLI/CLI.hpp>

namespace nacre::cli {

/// nacre(1): the commands, each with its sentence. `version`: "nacre 0.1.0". In man(7) macros.
std::string manual_page(const CLI::App& app, const std::string& version);

/// nacre-COMMAND(1): arguments and options as `nacre COMMAND --help` says them.
std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& version);

}  // namespace nacre::cli
