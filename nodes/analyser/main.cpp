// The analyser as a process.

#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "analyser/analyser_core.hpp"
#include "analyser/works.hpp"
#include "run/run_database.hpp"
#include "runtime/node_main.hpp"
#include "runtime/work_pool.hpp"

namespace nacre::analyser {
namespace {

/// Threads for the analyser's work. They are made once the journal is locked: run.db may have to be made anew, and what
/// stands there is perhaps that of an analyser at work. One piece of work at a time: messages are kept in order, and a
/// diagnosis uses all cores by itself.
runtime::MakeExecutor make_threads(const runtime::NodeOptions& options) {
  const std::filesystem::path journal = options.node_dir() / "journal.lcm";
  // A first start: a journal that has begun would tell of a file that is lost.
  if (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0)
    run::RunDatabase(options.run_dir / "run.db");
  return [run_dir = options.run_dir, threads = options.threads > 0 ? options.threads : 1](std::function<void()> wake) {
    return std::make_unique<runtime::WorkPool>(work_functions(run_dir), threads, std::move(wake));
  };
}

}  // namespace
}  // namespace nacre::analyser

int main(int argc, char** argv) {
  using namespace nacre;
  return runtime::node_main(
      argc, argv, "analyser", [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
        return runtime::NodeProgram{
            .core = analyser::make_core(scenario), .work = {}, .executor = analyser::make_threads(options)};
      });
}
