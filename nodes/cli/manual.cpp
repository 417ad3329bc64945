// Part of the command line (command.hpp): nacre manual, which writes manual pages and completion of the shells.

#include <filesystem>
#include <string>

#include "base/files.hpp"
#include "command.hpp"
#include "completion.hpp"
#include "manual_page.hpp"
#include "output.hpp"
#include "runtime/version.hpp"

namespace nacre::cli {
namespace {

struct ManualOptions {
  const CLI::App* app = nullptr;  ///< all commands
  std::string folder;
};

int write_manual(const ManualOptions& options) {
  const CLI::App& app = *options.app;
  const std::filesystem::path folder(options.folder), pages = folder / "man" / "man1",
                                                      bash = folder / "bash-completion" / "completions",
                                                      zsh = folder / "zsh" / "site-functions";
  for (const auto& each : {pages, bash, zsh}) make_folder(each);
  const std::string words = runtime::version_in_words(), version = words.substr(0, words.find(','));
  write_file_atomically(pages / "nacre.1", manual_page(app, version));
  for (const CLI::App* command : app.get_subcommands({}))
    write_file_atomically(pages / fmt::format("nacre-{}.1", command->get_name()), manual_page(app, *command, version));
  write_file_atomically(bash / "nacre", bash_completion(app));
  write_file_atomically(zsh / "_nacre", zsh_completion(app));
  remark(fmt::format("written: {}, {}, {}", pages.string(), (bash / "nacre").string(), (zsh / "_nacre").string()));
  return 0;
}

}  // namespace

void add_manual(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ManualOptions>();
  options->app = &app;
  CLI::App& command =
      add_command(app, action, "manual", "Write manual pages, and completion of bash and zsh", options, write_manual);
  command.add_option("FOLDER", options->folder, "Folder to write to, as share/ of an installation is laid out")
      ->required();
}

}  // namespace nacre::cli
