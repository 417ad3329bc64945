// nacre: the command line. One subcommand per file; exit status 0 done, 1 the answer is no, 2 wrong usage or bad input.

#include <exception>

#include "base/result.hpp"
#include "command.hpp"
#include "output.hpp"

namespace nacre::cli {
namespace {

constexpr int kBadInput = 2;

int run(int argc, char** argv) {
  CLI::App app{
      "nacre finds stiff and tough two-material microstructures and closes the gap between simulation and laboratory.",
      "nacre"};
  app.set_version_flag("--version", NACRE_VERSION);
  app.require_subcommand(1);
  Action action;
  for (const auto add :
       {add_simulate, add_film,      add_calibrate, add_explore, add_select,  add_measure,   add_diagnose,
        add_families, add_fabricate, add_import,    add_launch,  add_record,  add_dashboard, add_status,
        add_echo,     add_inject,    add_approve,   add_review,  add_designs, add_printed,   add_report,
        add_replay,   add_doctor,    add_rebuild,   add_backup}) {
    add(app, action);
  }
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

int main(int argc, char** argv) {
  try {
    return nacre::cli::run(argc, argv);
  } catch (const nacre::InputError& error) {
    fmt::print(stderr, "nacre: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "nacre: unexpected: {}\n", error.what());
  }
  return nacre::cli::kBadInput;
}
