// Part of the command line (command.hpp): nacre report, the figures and tables of the thesis from a run of one's own.

#include <filesystem>
#include <string>

#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/shipped_files.hpp"
#include "command.hpp"
#include "material/parameter_file.hpp"
#include "output.hpp"
#include "report/paper.hpp"
#include "report/report.hpp"
#include "run/adopted_model.hpp"
#include "run/run.hpp"
#include "run_access.hpp"
#include "runtime/round_history.hpp"

namespace nacre::cli {
namespace {

struct ReportOptions {
  std::string run = "logs/latest";
  std::string out;
  bool render = false;
};

int report(const ReportOptions& options) {
  const RunAccess run = open_run(options.run);
  for (const auto& round : runtime::read_rounds(run.folder)) remark(runtime::in_words(round));
  const std::filesystem::path database = run.folder / "run.db", page = run.folder / "report.html";
  if (!std::filesystem::exists(database)) {
    remark(fmt::format("{}: nothing to report yet; the first report follows round 0", run.folder.string()));
    return 1;
  }
  if (options.render) {
    run::Run read(run.folder);
    write_file_atomically(page, report::render_report(read, run.manifest.run_id));
  }
  const std::filesystem::path thesis = shipped_folder() / "data" / "thesis";
  if (!std::filesystem::exists(thesis))
    remark("data/thesis was not found, neither beside the program nor here: the thesis' figures are left out");
  const std::filesystem::path folder = options.out.empty() ? run.folder / "paper" : std::filesystem::path(options.out);
  prepare_output_folder(folder.string());
  const report::PaperSource source =
      report::read_paper_source(run.folder, run.manifest.run_id, std::filesystem::exists(thesis) ? thesis : "");
  report::write_paper(folder, source);
  if (const auto model = run::newest_model(source.run))
    write_file_atomically(folder / "parameters.toml", material::to_toml(*model));
  remark("pages written: the report of the game (report.html), the figures and tables of the thesis (index.html)");
  if (std::filesystem::exists(page)) fmt::print("{}\n", page.string());
  fmt::print("{}\n", (folder / "index.html").string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& command =
      add_command(app, action, "report", "Write the figures and tables of the thesis from a run: one page, SVG and CSV",
                  options, report);
  command.add_option("RUN,--run", options->run, "Folder of the run")->capture_default_str();
  command.add_option("--out", options->out, "Folder to write to; default: RUN/paper");
  command.add_flag("--render", options->render, "Write report.html, the report of the game, once more as well");
}

}  // namespace nacre::cli
