// nacre report: where the report of a run is.

#include <filesystem>
#include <string>

#include "analyser/report.hpp"
#include "base/files.hpp"
#include "command.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "runtime/round_history.hpp"
#include "store/run_record.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::string run = "logs/latest";
  bool render = false;
};

int report(const Options& options) {
  const RunAccess run = open_run(options.run);
  for (const auto& round : runtime::read_rounds(run.folder)) remark(runtime::in_words(round));
  const std::filesystem::path page = run.folder / "report.html";
  if (options.render) {
    const store::RunRecord record = store::read_run_record(run.folder / "run.db");
    write_file_atomically(page, analyser::render_report(record, run.manifest.run_id));
  }
  if (!std::filesystem::exists(page)) {
    remark(fmt::format("{}: no report yet; the analyser writes it after the first round", run.folder.string()));
    return 1;
  }
  fmt::print("{}\n", page.string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      add_command(app, action, "report", "Print the rounds and where the report of a run is", options, report);
  add_run_option(command, options->run);
  command.add_flag("--render", options->render, "Write the page again from the run's database");
}

}  // namespace nacre::cli
