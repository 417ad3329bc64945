#include "run_access.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

#include <fmt/ranges.h>

#include "base/result.hpp"
#include "output.hpp"

namespace nacre::cli {
namespace {

runtime::BusOptions bus_options(const RunAccess& run, const std::string& name) {
  runtime::BusOptions options;
  options.url = runtime::bus_url(run.manifest.port, run.manifest.lan);
  options.node = name;
  options.run_id = run.manifest.run_id;
  options.faults = runtime::faults_from_environment();
  options.report = [](runtime::LogLevel level, const std::string& text) {
    if (level >= runtime::LogLevel::warning) warn(text);
  };
  return options;
}

}  // namespace

std::string user_name() {
  if (const char* name = std::getenv("USER"); name != nullptr && *name != '\0') return name;
  const passwd* account = ::getpwuid(::getuid());
  return account == nullptr ? "unknown" : account->pw_name;
}

void add_run_option(CLI::App& command, std::string& run) {
  command.add_option("--run", run, "Folder of the run")->capture_default_str();
}

RunAccess open_run(const std::string& folder) {
  RunAccess run;
  run.manifest = runtime::read_manifest(folder);
  std::error_code error;
  run.folder = std::filesystem::canonical(folder, error);
  if (error) throw InputError::format("{}: no such run: {}", folder, error.message());
  run.scenario = game::read_scenario(run.folder / "scenario.toml");
  return run;
}

std::unique_ptr<runtime::Bus> listen(const RunAccess& run, const std::vector<std::string>& channels) {
  auto bus = runtime::Bus::open(bus_options(run, "listener"));
  if (!bus) throw InputError(bus.error().message);
  if (const auto subscribed = (*bus)->subscribe(channels); !subscribed) throw InputError(subscribed.error().message);
  return std::move(*bus);
}

std::unique_ptr<runtime::Endpoint> speak(const RunAccess& run, const std::string& name) {
  // The process' number keeps two people at work apart: sequence numbers count per node and epoch.
  auto endpoint =
      runtime::Endpoint::open(bus_options(run, fmt::format("{}_{}", name, ::getpid())), run.scenario.nodes());
  if (!endpoint) throw InputError(endpoint.error().message);
  return std::move(*endpoint);
}

Delivered deliver(const RunAccess& run, const std::string& name, const runtime::Message& message, double timeout_s) {
  const auto endpoint = speak(run, name);
  const auto hash = endpoint->offer(message);
  if (!hash) throw InputError(hash.error().message);
  endpoint->deliver(timeout_s);
  Delivered delivered{.missing = endpoint->waiting_for(*hash)};
  if (const auto why = endpoint->refusal_of(*hash))
    delivered.refusal = fmt::format("{}. {}", *why, advice_on_refused(message.channel));
  return delivered;
}

std::string advice_on_refused(std::string_view channel) {
  if (channel == "MEASUREMENT")
    return "What the run has stays: hand yours in under a new name, amend what is there (--reason), or review it.";
  return "What the run has stays: `nacre designs` and the dashboard's laboratory show how far each design is.";
}

int say_delivered(const Delivered& delivered, double timeout_s) {
  if (delivered.refusal) remark(*delivered.refusal);
  if (!delivered.missing.empty()) say_unanswered(delivered.missing, timeout_s);
  return delivered.refusal || !delivered.missing.empty() ? 1 : 0;
}

void say_unanswered(const std::set<std::string>& nodes, double timeout_s) {
  remark(
      fmt::format("{} did not answer within {} s: does the run play? (nacre status) Type the same again: repeating it "
                  "is safe, and a node may wait for the message",
                  fmt::join(nodes, ", "), timeout_s));
}

}  // namespace nacre::cli
