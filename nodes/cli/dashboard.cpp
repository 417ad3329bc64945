// Part of the command line (command.hpp): nacre dashboard, a run as a live page in the browser.

#include "dashboard/dashboard.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/names.hpp"
#include "command.hpp"
#include "dashboard/server.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "run_desk.hpp"
#include "runtime/interrupts.hpp"
#include "shipped_files.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::string run = "logs/latest";
  std::string host = "127.0.0.1";
  std::optional<int> port;
  std::string token;
  std::string families;
  std::string page;
  std::vector<std::string> allowed_hosts;
};

/// Whether only this machine reaches the address.
bool is_loopback(const std::string& host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

dashboard::DashboardSettings settings_of(const RunAccess& run, const Options& options) {
  return {.run_folder = run.folder,
          .page_folder = options.page.empty() ? page_folder() : std::filesystem::path(options.page),
          .family_folder = options.families.empty() ? run.folder / "families" : std::filesystem::path(options.families),
          .run_id = run.manifest.run_id,
          .started = run.manifest.started,
          .nacre_version = run.manifest.nacre_version,
          .commit = run.manifest.commit,
          .user = user_name(),
          .scenario = run.scenario};
}

int show_dashboard(const Options& options) {
  const RunAccess run = open_run(options.run);
  RunDesk desk(run);
  dashboard::Dashboard page(settings_of(run, options), desk);
  dashboard::ServerSettings server{
      .host = options.host, .port = options.port, .token = options.token, .further_hosts = options.allowed_hosts};
  if (server.token.empty() && !is_loopback(options.host)) server.token = dashboard::random_token();
  const runtime::Interrupts interrupts;
  const auto ready = [&](int port) {
    fmt::print("{}\n", dashboard::page_link(options.host, port, server.token));
    std::fflush(stdout);
    remark(fmt::format("shows {}; Ctrl-C ends the page, not the game", run.manifest.run_id));
  };
  dashboard::serve(page, server, ready, [&] { return interrupts.any(); });
  return 0;
}

}  // namespace

void add_dashboard(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      add_command(app, action, "dashboard", "Show a run in the browser, live or afterwards", options, show_dashboard);
  command.add_option("RUN,--run", options->run, "Folder of the run")->capture_default_str();
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
