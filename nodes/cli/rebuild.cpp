// Part of the command line (command.hpp): nacre rebuild, databases made anew, and nacre backup, a copy of a run that
// plays.

#include <filesystem>
#include <string>

#include "base/counted.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "output.hpp"
#include "run/rebuild.hpp"
#include "run_access.hpp"
#include "runtime/folder_lock.hpp"
#include "runtime/run_copy.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct RebuildOptions {
  std::string run = "logs/latest";
  std::string cache;
  bool json = false;
};

/// The rows of a damaged cache that can be read, in a new file in its place.
int rebuild_cache(const RebuildOptions& options) {
  const fs::path file = options.cache;
  if (store::check_database(file)) {
    remark(fmt::format("{}: is whole; nothing to do", file.string()));
    if (options.json) print_json({{"database", file.string()}, {"damaged", nullptr}});
    return 0;
  }
  const fs::path anew = file.string() + ".part";
  std::error_code ignored;
  fs::remove(anew, ignored);
  const store::Salvage saved = store::salvage_simulations(file, anew);
  const fs::path aside = store::move_aside(file);
  fs::rename(anew, file);
  if (options.json) {
    print_json({{"database", file.string()},
                {"simulations", saved.simulations},
                {"breaks", saved.breaks},
                {"damaged", aside.string()}});
  } else {
    fmt::print("{}: {} simulations and {} cracks saved; the damaged file is now {}\n", file.string(), saved.simulations,
               saved.breaks, aside.string());
  }
  return 0;
}

int rebuild(const RebuildOptions& options) {
  if (!options.cache.empty()) return rebuild_cache(options);
  const RunAccess run = open_run(options.run);
  const runtime::FolderLock lock(run.folder / "nodes" / "analyser");  // against an analyser that starts meanwhile
  const run::Rebuilt rebuilt = run::rebuild_run_database(run.folder);
  const std::string database = (run.folder / "run.db").string();
  if (rebuilt.torn_bytes > 0)
    warn(fmt::format("the analyser's journal ends in a torn record of {} bytes: what it said is not in {}",
                     rebuilt.torn_bytes, database));
  if (rebuilt.unread > 0)
    warn(
        fmt::format("{} of another version of nacre cannot be read and are not in {}: to have them, play the scenario "
                    "again, or use that version (manifest.json)",
                    counted(rebuilt.unread, "message"), database));
  if (options.json) {
    print_json({{"database", database},
                {"messages", rebuilt.messages},
                {"unread", rebuilt.unread},
                {"torn_bytes", rebuilt.torn_bytes}});
  } else {
    fmt::print("{}: made anew from {} of the analyser's journal\n", database,
               counted(static_cast<std::int64_t>(rebuilt.messages), "message"));
  }
  return 0;
}

struct BackupOptions {
  std::string run = "logs/latest";
  std::string to;
  bool json = false;
};

/// Whether there are any.
bool copy_caches(const fs::path& logs, const fs::path& to) {
  bool has_cache = false;
  for (const char* name : {store::kCacheName, store::kDeviceCacheName}) {
    const fs::path cache = logs / name;
    if (!fs::exists(cache)) continue;
    const fs::path copied = to / name;
    if (fs::exists(copied)) {
      store::add_simulations(cache, copied);
    } else {
      store::copy_database(cache, copied);
    }
    has_cache = true;
  }
  return has_cache;
}

int backup(const BackupOptions& options) {
  const RunAccess run = open_run(options.run);
  const fs::path to = fs::path(options.to) / run.manifest.run_id;
  const runtime::RunCopy copy = runtime::copy_run(run.folder, to, store::copy_database);
  bool has_cache = false;
  try {
    has_cache = copy_caches(run.folder.parent_path(), options.to);
  } catch (...) {
    std::error_code left_behind;
    fs::remove_all(to, left_behind);  // a run alone is no backup, and would stand in the way of the next try
    throw;
  }
  if (options.json) {
    print_json({{"run", to.string()},
                {"files", copy.files},
                {"journals", copy.journals},
                {"bytes", copy.bytes},
                {"simulations", has_cache}});
  } else {
    fmt::print("{}: {} files, {:.1f} MB; `nacre launch --resume {}` plays on from here\n", to.string(), copy.files,
               1e-6 * static_cast<double>(copy.bytes), shell_word(to));
  }
  return 0;
}

}  // namespace

void add_rebuild(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RebuildOptions>();
  CLI::App& command = add_command(app, action, "rebuild",
                                  "Make a run's database anew from its journal, or save the content of a damaged cache",
                                  options, rebuild);
  add_run_option(command, options->run);
  command.add_option("--cache", options->cache, "A damaged simulations.db to save, instead of a run");
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

void add_backup(CLI::App& app, Action& action) {
  const auto options = std::make_shared<BackupOptions>();
  CLI::App& command = add_command(app, action, "backup", "Copy a run, also while it plays", options, backup);
  add_run_option(command, options->run);
  command.add_option("--to", options->to, "Folder to copy the run and the caches of simulations to")->required();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
