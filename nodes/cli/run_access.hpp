#pragma once
// How subcommands reach a run: its folder and its bus. What it knows: lib/run.

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "game/scenario.hpp"
#include "runtime/endpoint.hpp"
#include "runtime/run_folder.hpp"

namespace nacre::cli {

/// The name of the account; `unknown` where there is none.
std::string user_name();

/// A run as found on disk.
struct RunAccess {
  std::filesystem::path folder;
  runtime::Manifest manifest;
  game::Scenario scenario;
};

/// Adds `--run DIR`, default logs/latest.
void add_run_option(CLI::App& command, std::string& run);

/// Throws InputError when the folder is not a run's.
RunAccess open_run(const std::string& folder);

/// A bus that only listens, to these channels or to all. Throws InputError.
std::unique_ptr<runtime::Bus> listen(const RunAccess& run, const std::vector<std::string>& channels);

/// An end point that sends until acknowledged. Throws InputError.
std::unique_ptr<runtime::Endpoint> speak(const RunAccess& run, const std::string& name);

/// What became of a message: who has not acknowledged it, and why a node that has it will not use it.
struct Delivered {
  std::set<std::string> missing = {};
  std::optional<std::string> refusal = {};  ///< with what to do, in sentences
};

/// Sends one message and waits until every node that listens to it has it, or `timeout_s` is over. Throws InputError.
Delivered deliver(const RunAccess& run, const std::string& name, const runtime::Message& message, double timeout_s);

/// Says which nodes did not acknowledge what was sent to them.
void say_unanswered(const std::set<std::string>& nodes, double timeout_s);

/// Says what is wrong, if anything is. Exit status: 0 nothing, 1 something.
int say_delivered(const Delivered& delivered, double timeout_s);

/// What a person does about a refused message of that channel, as a sentence.
std::string advice_on_refused(std::string_view channel);

}  // namespace nacre::cli
