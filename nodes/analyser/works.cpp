#include "analyser/works.hpp"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "analyser/diagnosis_work.hpp"
#include "base/files.hpp"
#include "report/report.hpp"
#include "run/rebuild.hpp"
#include "run/run.hpp"
#include "runtime/journal.hpp"

namespace nacre::analyser {

std::string store_spec(const std::string& channel, const std::string& payload) {
  return runtime::pack({channel, payload});
}

std::map<std::string, runtime::WorkFunction> work_functions(const std::filesystem::path& run_dir) {
  const std::shared_ptr<run::RunDatabase> database =
      run::open_run_database(run_dir, [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); });
  return {
      {"store",
       [database](const std::string& spec) -> std::string {
         const auto fields = runtime::unpack(spec);
         if (!fields || fields->size() != 2) throw std::logic_error("the spec of a store does not read back");
         database->keep((*fields)[0], (*fields)[1]);
         return "kept";
       }},
      {"plan", plan_work},
      {"diagnose", diagnose_work},
      {"report",
       [database, read = std::make_shared<run::Run>(run_dir), run_dir](const std::string& round) -> std::string {
         database->checkpoint();
         write_file_atomically(run_dir / "report.html", report::render_report(*read, run_dir.filename().string()));
         return fmt::format("round {}: report.html written", round);
       }},
  };
}

}  // namespace nacre::analyser
