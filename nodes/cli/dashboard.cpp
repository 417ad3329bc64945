// Part of the command line (command.hpp): nacre dashboard, runs as a live page in the browser.

#include "dashboard/dashboard.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "base/names.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "dashboard/server.hpp"
#include "dashboard/several_runs.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "run_desk.hpp"
#include "runtime/interrupts.hpp"
#include "runtime/process.hpp"
#include "shipped_files.hpp"

namespace nacre::cli {
namespace {

struct DashboardOptions {
  std::vector<std::string> runs = {"logs/latest"};
  std::string host = "127.0.0.1";
  std::optional<int> port;
  std::string token;
  std::string families;
  std::string page;
  std::vector<std::string> allowed_hosts;
};

/// Whether only this machine reaches the address.
bool is_loopback(const std::string& host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

dashboard::DashboardSettings settings_of(const RunAccess& run, const DashboardOptions& options) {
  return {.run_folder = run.folder,
          .family_folder = options.families.empty() ? run.folder / "families" : std::filesystem::path(options.families),
          .run_id = run.manifest.run_id,
          .started = run.manifest.started,
          .nacre_version = run.manifest.nacre_version,
          .commit = run.manifest.commit,
          .user = user_name(),
          .scenario = run.scenario,
          .import_reader = {.command = {runtime::this_program().string(), "import"}}};
}

/// The name of a folder that is no run's: without the way to it, so that an address can hold it.
std::string folder_name(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// The dashboards of the runs that can be read, and why the others cannot.
class Shelf {
 public:
  explicit Shelf(const DashboardOptions& options) : options_(options) {
    for (const std::string& folder : options.runs) {
      try {
        open(folder);
      } catch (const InputError& error) {
        if (options.runs.size() == 1) throw;
        remark(error.what());
        shown_.push_back({.name = folder_name(folder), .problem = error.what()});
      }
    }
    if (dashboards_.empty()) throw InputError("none of the runs can be shown");
  }

  const std::vector<dashboard::ShownRun>& shown() const { return shown_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const dashboard::ShownRun& each : shown_)
      if (each.dashboard != nullptr) names.push_back(each.name);
    return names;
  }

 private:
  void open(const std::string& folder) {
    RunAccess run = open_run(folder);
    const std::string name = run.manifest.run_id;
    if (std::ranges::count(names(), name) > 0)
      throw InputError::format("{}: another run shown here is called {}, too: show this one on a page of its own",
                               folder, name);
    dashboard::DashboardSettings settings = settings_of(run, options_);
    dashboards_.emplace_back(std::move(settings), desks_.emplace_back(std::move(run)));
    shown_.push_back({.name = name, .dashboard = &dashboards_.back()});
  }

  const DashboardOptions& options_;
  std::deque<RunDesk> desks_;
  std::deque<dashboard::Dashboard> dashboards_;
  std::vector<dashboard::ShownRun> shown_;
};

/// Each run has its colour and its line of the legend.
constexpr std::size_t kMostRuns = 8;

int show_dashboard(const DashboardOptions& options) {
  if (options.runs.size() > kMostRuns)
    throw InputError::format("nacre dashboard: {} runs, expected at most {}", options.runs.size(), kMostRuns);
  if (options.runs.size() > 1 && !options.families.empty())
    throw InputError("nacre dashboard --families: expected one run");
  const Shelf shelf(options);
  dashboard::SeveralRuns page(options.page.empty() ? page_folder() : std::filesystem::path(options.page),
                              shelf.shown());
  dashboard::ServerSettings server{
      .host = options.host, .port = options.port, .token = options.token, .further_hosts = options.allowed_hosts};
  if (server.token.empty() && !is_loopback(options.host)) server.token = dashboard::random_token();
  const runtime::Interrupts interrupts;
  const auto ready = [&](int port) {
    fmt::print("{}\n", dashboard::page_link(options.host, port, server.token));
    std::fflush(stdout);
    remark(fmt::format("shows {}; Ctrl-C ends the page, not the game", fmt::join(shelf.names(), ", ")));
  };
  dashboard::serve([&](const dashboard::Request& request) { return page.handle(request); }, server, ready,
                   [&] { return interrupts.any(); });
  return 0;
}

}  // namespace

void add_dashboard(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DashboardOptions>();
  CLI::App& command =
      add_command(app, action, "dashboard", "Show runs in the browser, live or afterwards", options, show_dashboard);
  command.add_option("RUN,--run", options->runs, "Folder of the run; of several, up to 8, to compare them")
      ->capture_default_str();
  command
      .add_option("--port", options->port,
                  "Port of the page; 0: any free one; default: 8765, or a free one where another program has that")
      ->check(CLI::Range(0, 65535));
  command.add_option("--host", options->host, "Address to listen on; one that other machines reach asks for a token")
      ->capture_default_str();
  command
      .add_option("--token", options->token,
                  "Token that a browser must bring; default for other hosts: a random one, printed")
      ->check([](const std::string& token) {
        const bool plain = token.size() >= 16 && is_plain_name(token, 256);
        return plain ? std::string() : std::string("expected 16 to 256 letters, digits, - and _");
      });
  command.add_option("--allow-host", options->allowed_hosts,
                     "Name under which a tunnel or a proxy shows the page, NAME or NAME:PORT; may be repeated");
  command.add_option("--families", options->families,
                     "Folder of `nacre families` for the map explorer; default: RUN/families");
  command.add_option("--page", options->page,
                     "Folder of the built page; default: the one that came with nacre, or build/web");
  command.footer(
      "Example: nacre dashboard logs/latest\n  prints http://127.0.0.1:8765/ - open it. Elsewhere on the network: "
      "--host 0.0.0.0 prints a link with a token.");
}

}  // namespace nacre::cli
