#include "study/study_command.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "base/result.hpp"

namespace nacre::study {

void add_table_options(CLI::App& app, TableOptions& options, const std::string& seed_of) {
  app.add_option("--table", options.table, "CSV of finished simulations, read and continued")->capture_default_str();
  app.add_option("--seed", options.seed, "Of " + seed_of)->capture_default_str();
  app.add_option("--seconds", options.seconds, "Begin no simulation after this time");
  app.add_option("--threads", options.threads, "0: all allowed cores")->check(CLI::Range(0, 1024));
}

CLI::Option* add_fidelity_option(CLI::App& app, std::string& fidelity) {
  return app.add_option("--fidelity", fidelity)->check(CLI::IsMember({"tiny", "preview", "full"}));
}

int exit_status_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

}  // namespace nacre::study
