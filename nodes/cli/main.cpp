// nacre: the command line. One subcommand per file; exit status 0 done, 1 the answer is no or the disk is
// full, 2 wrong usage or bad input.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

#include "base/no_space.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "output.hpp"
#include "runtime/version.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::cli {
namespace {

constexpr int kLater = 1;

/// Letters to be changed, added or left out to make one word of the other.
std::size_t changes_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row[b.size()];
}

/// Throws InputError unless the word typed behind `nacre` is a command (or an option).
void require_known_command(CLI::App& app, const std::string& typed) {
  if (typed.starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  std::string nearest;
  std::size_t fewest = 3;  // changes at which a word is another one
  for (const std::string& name : names) {
    const std::size_t changes = changes_between(typed, name);
    if (changes == 0) return;
    if (changes < fewest) nearest = name;
    fewest = std::min(fewest, changes);
  }
  throw InputError::format("{}: no such command; {}", typed,
                           nearest.empty() ? fmt::format("expected one of {}", fmt::join(names, ", "))
                                           : fmt::format("is `{}` meant?", nearest));
}

int run(int argc, char** argv) {
  CLI::App app{
      "nacre finds stiff and tough two-material microstructures and closes the gap between simulation and laboratory.",
      "nacre"};
  app.set_version_flag("--version", runtime::version_in_words);
  app.require_subcommand(1);
  Action action;
  for (const auto add :
       {add_show,     add_simulate, add_film,      add_calibrate, add_explore, add_select,  add_measure,
        add_diagnose, add_families, add_fabricate, add_import,    add_launch,  add_record,  add_dashboard,
        add_status,   add_echo,     add_inject,    add_approve,   add_review,  add_designs, add_printed,
        add_report,   add_replay,   add_export,    add_doctor,    add_rebuild, add_backup,  add_manual}) {
    add(app, action);
  }
  if (argc > 1) require_known_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  const int status = action();
  check_standard_output();
  return status;
}

}  // namespace
}  // namespace nacre::cli

// What ends the program is said by functions that cannot throw themselves: standard error may be closed or full.
int main(int argc, char** argv) {
  try {
    return nacre::cli::run(argc, argv);
  } catch (const nacre::NoSpace& error) {
    std::fprintf(stderr, "nacre: %s\n", error.what());
    return nacre::cli::kLater;
  } catch (const nacre::InputError& error) {
    std::fprintf(stderr, "nacre: %s\n", error.what());
  } catch (const nacre::store::DatabaseUnavailable& error) {
    std::fprintf(stderr, "nacre: %s\n", error.what());
    return nacre::cli::kLater;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nacre: unexpected: %s\n", error.what());
  }
  return nacre::cli::kBadInput;
}
