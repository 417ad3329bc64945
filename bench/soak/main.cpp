// The soak: one game of very many short rounds with real processes, watched from outside. Memory, descriptors and
// threads of every node and the sizes of what it writes go to a table, one row each every few seconds; in the end it
// says by how much each grows per round. Results: docs/studies/reliability.md.

#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "runtime/process.hpp"
#include "runtime/round_history.hpp"
#include "watched_process.hpp"

namespace {

using namespace nacre;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  fs::path scenario = "bench/soak/soak.toml", logs = "logs", out = "soak.csv";
  double minutes = 60.0, every_s = 10.0;
  bool made_up = false;
};

/// One figure over the rounds of the game.
struct Course {
  std::vector<double> rounds, values;
  void add(double round, double value) {
    rounds.push_back(round);
    values.push_back(value);
  }
  /// Slope of least squares over the second half: what comes after everything has been set up once.
  double growth_per_round() const {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = rounds.size() / 2; i < rounds.size(); ++i)
      n += 1, x += rounds[i], y += values[i], xx += rounds[i] * rounds[i], xy += rounds[i] * values[i];
    const double spread = n * xx - x * x;
    return spread > 0.0 ? (n * xy - x * y) / spread : 0.0;
  }
};

class Watch {
 public:
  explicit Watch(const fs::path& table) : table_(table) {
    if (!table_) throw InputError::format("{}: cannot be written", table.string());
    table_ << "time_s,round,what,figure,value\n";
  }

  void look(double time_s, double round, pid_t launcher, const fs::path& run) {
    for (const soak::WatchedProcess& process : soak::children_of(launcher)) {
      note(time_s, round, process.name, "resident_bytes", process.resident_bytes);
      note(time_s, round, process.name, "descriptors", process.descriptors);
      note(time_s, round, process.name, "threads", process.threads);
    }
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(run, missing)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file(missing)) continue;
      const std::string suffix = file.extension().string();
      if (suffix != ".lcm" && suffix != ".db" && suffix != ".html" && suffix != ".log") continue;
      note(time_s, round, fs::relative(file, run).string(), "bytes", static_cast<double>(entry.file_size(missing)));
    }
    const fs::path simulations = run.parent_path() / "simulations.db";  // none of made-up ones
    if (fs::exists(simulations))
      note(time_s, round, "simulations.db", "bytes", static_cast<double>(fs::file_size(simulations, missing)));
    table_.flush();
  }

  void print_summary() const {
    fmt::print("{:<36} {:<15} {:>14} {:>14} {:>16}\n", "what", "figure", "halfway", "last", "growth per round");
    for (const auto& [name, course] : courses_) {
      fmt::print("{:<36} {:<15} {:>14.0f} {:>14.0f} {:>16.2f}\n", name.first, name.second,
                 course.values[course.values.size() / 2], course.values.back(), course.growth_per_round());
    }
  }

 private:
  void note(double time_s, double round, const std::string& what, const std::string& figure, double value) {
    table_ << fmt::format("{:.1f},{:.0f},{},{},{:.0f}\n", time_s, round, what, figure, value);
    courses_[{what, figure}].add(round, value);
  }
  std::ofstream table_;
  std::map<std::pair<std::string, std::string>, Course> courses_;
};

/// Plays for `minutes`; exit status 0 when the game was still sound then and ended in order.
int play_and_watch(const Options& options) {
  const std::string name = "soak";
  const fs::path run = options.logs / name;
  if (fs::exists(run))
    throw InputError::format("{} exists: a soak begins with a new run; remove it or give --logs", run.string());
  Watch watch(options.out);
  const auto began = Clock::now();
  const auto passed_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  const fs::path programs = runtime::this_program().parent_path();
  runtime::ChildProcess launcher({(programs / "nacre").string(), "launch", options.scenario.string(), "--logs",
                                  options.logs.string(), "--run", name, "--programs",
                                  (options.made_up ? programs / "made_up" : programs).string()});
  double next_s = options.every_s;
  bool told_to_end = false;
  std::string last_lines;
  for (std::optional<runtime::ProcessEnd> end; !(end = launcher.poll_end());) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    for (const std::string& line : launcher.read_lines()) last_lines += line + '\n';
    constexpr std::size_t kKept = 4000;
    if (last_lines.size() > 2 * kKept) last_lines.erase(0, last_lines.size() - kKept);
    if (!told_to_end && passed_s() >= next_s) {
      next_s += options.every_s;
      const double round = static_cast<double>(runtime::read_rounds(run).size());
      watch.look(passed_s(), round, launcher.pid(), run);
      fmt::print("{:.0f} of {:.0f} s: {:.0f} rounds\n", passed_s(), 60.0 * options.minutes, round);
      std::fflush(stdout);
    }
    if (!told_to_end && passed_s() > 60.0 * options.minutes) {
      launcher.signal_group(SIGINT);
      told_to_end = true;
    }
  }
  watch.print_summary();
  const bool sound = told_to_end && launcher.poll_end()->signal == 0;
  if (!sound) fmt::print("the game ended by itself; its last words:\n{}", last_lines);
  return sound ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Plays very many short rounds and watches what the nodes hold and write"};
  Options options;
  app.add_option("--scenario", options.scenario, "scenario file")->capture_default_str();
  app.add_option("--logs", options.logs, "where the run is kept")->capture_default_str();
  app.add_option("--out", options.out, "table to write")->capture_default_str();
  app.add_option("--minutes", options.minutes, "how long")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--every", options.every_s, "seconds between two looks")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--made-up", options.made_up, "Farm and laboratory make their results up: many rounds in little time");
  CLI11_PARSE(app, argc, argv);
  try {
    return play_and_watch(options);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
