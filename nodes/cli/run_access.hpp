#pragma once
// How subcommands reach a run: its folder, its bus, its validation agent's journal.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "game/scenario.hpp"
#include "material/parameters.hpp"
#include "runtime/endpoint.hpp"
#include "runtime/journal.hpp"
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

/// Sends one message and waits until every node that listens to it has it. Exit status: 0 they have, 1 not in time.
int deliver(const RunAccess& run, const std::string& name, const runtime::Message& message, double timeout_s);

/// Says which nodes did not acknowledge what was sent to them.
void say_unanswered(const std::set<std::string>& nodes, double timeout_s);

/// Functions that take a payload (with blank header), by channel.
using Takers = std::map<std::string, std::function<void(const std::string& payload)>, std::less<>>;

/// Hands out what a node has received and sent so far on these channels, oldest first, in one reading of its journal;
/// nothing before its first message and on machines that do not hold the run's folder.
void read_journal(const RunAccess& run, const std::string& node, const Takers& received, const Takers& sent);

/// What a node has received on `channel` alone.
std::vector<std::string> received_by(const RunAccess& run, const std::string& node, const std::string& channel);

/// The validation agent's.
void read_validation_agent(const RunAccess& run, const Takers& received, const Takers& sent);

std::vector<std::string> received_by_validation_agent(const RunAccess& run, const std::string& channel);

/// The same for what it has sent.
std::vector<std::string> sent_by_validation_agent(const RunAccess& run, const std::string& channel);

/// The model that the validation agent adopted last; nothing before the first.
std::optional<material::ParameterSet> adopted_parameters(const RunAccess& run);

}  // namespace nacre::cli
