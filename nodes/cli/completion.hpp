#pragma once
// Completion of the command line in bash and zsh, from what CLI11 knows of commands and options.

#include <string>

#include <CLI/CLI.hpp>

namespace nacre::cli {

/// A script for share/bash-completion/completions: one line per command and per option, with the values among which
/// one chooses.
std::string bash_completion(const CLI::App& app);

/// The same for a folder of zsh's fpath, with the options' sentences.
std::string zsh_completion(const CLI::App& app);

}  // namespace nacre::cli
