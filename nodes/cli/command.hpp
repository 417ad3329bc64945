#pragma once
// A subcommand of nacre: it describes its options to CLI11 and, when it was the one typed, leaves what is to be done.
// Each stands in a file of its own, COMMAND.cpp.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace nacre::cli {

inline constexpr int kBadInput = 2;  ///< exit status: what was typed or read cannot be used

/// What the chosen subcommand does; its result is the exit status: 0 done, 1 the answer is no. Bad input is thrown as
/// InputError.
using Action = std::function<int()>;

/// Adds a subcommand whose options are members of `Options`; `run` gets them when it is chosen.
template <class Options>
CLI::App& add_command(CLI::App& app, Action& action, const std::string& name, const std::string& description,
                      const std::shared_ptr<Options>& options, int (*run)(const Options&)) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.callback([&action, options, run] { action = [options, run] { return run(*options); }; });
  return command;
}

/// `--seed` into a std::uint64_t, or an optional one: from 0 to 2^63 - 1, as scenarios and messages hold it.
template <class Seed>
CLI::Option* add_seed(CLI::App& command, Seed& seed, const std::string& words) {
  const CLI::Validator range(
      [](const std::string& text) {
        const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        constexpr std::string_view kLargest = "9223372036854775807";
        const bool small = text.size() < kLargest.size() || (text.size() == kLargest.size() && text <= kLargest);
        return whole && small ? "" : fmt::format("{}: expected a whole number from 0 to {}", text, kLargest);
      },
      "", "seed");
  return command.add_option("--seed", seed, words)->check(range);
}

/// `--fidelity` with what they are; `otherwise`, when it has no default of its own, tells what is taken then.
inline CLI::Option* add_fidelity(CLI::App& command, std::string& fidelity, const std::string& otherwise = "") {
  return command.add_option("--fidelity", fidelity,
                            "How specimens are simulated: full (as in the thesis), fine (on elements of half the "
                            "size), preview (pulled twice as fast) or tiny (one unit, for tests of the program; its "
                            "numbers mean nothing)" +
                                otherwise);
}

/// What may stand for a design on the command line (docs/FORMATS.md).
inline constexpr const char* kDesignWords =
    "A pattern file, a key of 14 hex digits, soft, interface, rigid, mix:F, checkerboard:P or laminate:x|y:R:S";

/// `--ranges`, where something is fitted.
inline CLI::Option* add_ranges(CLI::App& command, std::string& file, const std::string& otherwise = "the thesis'") {
  return command.add_option(
      "--ranges", file,
      "File with the ranges of the parameters, for other inks (docs/FORMATS.md); default: " + otherwise);
}

void add_show(CLI::App& app, Action& action);
void add_simulate(CLI::App& app, Action& action);
void add_calibrate(CLI::App& app, Action& action);
void add_explore(CLI::App& app, Action& action);
void add_families(CLI::App& app, Action& action);
void add_film(CLI::App& app, Action& action);
void add_select(CLI::App& app, Action& action);
void add_measure(CLI::App& app, Action& action);
void add_diagnose(CLI::App& app, Action& action);
void add_fabricate(CLI::App& app, Action& action);
void add_import(CLI::App& app, Action& action);
void add_launch(CLI::App& app, Action& action);
void add_record(CLI::App& app, Action& action);
void add_dashboard(CLI::App& app, Action& action);
void add_status(CLI::App& app, Action& action);
void add_echo(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_inject(CLI::App& app, Action& action);
void add_approve(CLI::App& app, Action& action);
void add_review(CLI::App& app, Action& action);
void add_designs(CLI::App& app, Action& action);
void add_printed(CLI::App& app, Action& action);
void add_replay(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);
void add_rebuild(CLI::App& app, Action& action);
void add_backup(CLI::App& app, Action& action);
void add_manual(CLI::App& app, Action& action);

}  // namespace nacre::cli
