#include <fmt/format.h>

#include "latencies.hpp"
#include "loads.hpp"
#include "made_up.hpp"
#include "report/report.hpp"
#include "run/run.hpp"
#include "run/run_database.hpp"
#include "runtime/log_file.hpp"
#include "runtime/run_folder.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre::load {
namespace {

runtime::RunFolder make_folder(const std::filesystem::path& logs) {
  game::Scenario scenario;
  scenario.fidelity = tester::Fidelity::preview;
  scenario.base_materials_file = scenario.discretisation_floor_file = "";
  return runtime::RunFolder::create(logs, "run", scenario);
}

/// The validation agent's journal with what it heard, for `nacre dashboard`, `designs` and `review`.
void write_journal(const std::filesystem::path& folder, const std::vector<std::string>& measurements) {
  std::filesystem::create_directories(folder);
  runtime::LogWriter journal(folder / "journal.lcm");
  std::int64_t number = 0;
  for (const std::string& payload : measurements) {
    const wire::Header header{.utime = ++number, .node = "load", .epoch = 1, .seq = number, .run_id = "run"};
    (void)journal.append(number, "MEASUREMENT", wire::stamp_header("MEASUREMENT", payload, header));
  }
  (void)journal.flush();
}

}  // namespace

void load_run(const Options& options) {
  const runtime::RunFolder folder = make_folder(options.folder);
  const std::filesystem::path file = folder.path() / "run.db";
  std::vector<std::string> heard;
  RandomStream random(options.seed, "load/run");
  const auto gamut = made_up_gamut(options.gamut, random);
  const auto specimens = made_up_specimens(options.measurements, options.designs, random);
  Latencies measurements, chunks, reading, reporting;
  {
    run::RunDatabase database(file);
    for (std::size_t i = 0; i < specimens.size(); ++i) {
      wire::Measurement measurement;
      measurement.round = 1 + static_cast<int>(i) % options.rounds;
      measurement.record = specimens[i];
      measurement.fidelity = tester::Fidelity::preview;
      heard.push_back(wire::write(measurement));
      measurements.time([&] { database.keep("MEASUREMENT", heard.back()); });
    }
    for (int round = 0; round <= options.rounds; ++round) {
      for (const wire::GamutChunk& chunk : wire::gamut_chunks(round, tester::Fidelity::preview, gamut))
        chunks.time([&] { database.keep("GAMUT", wire::write(chunk)); });
      wire::RoundSummary summary;
      summary.round = round;
      database.keep("ROUND", wire::write(summary));
    }
  }
  write_journal(folder.node_folder("validation_agent"), heard);
  measurements.print("run.db: keep a measurement");
  chunks.print("run.db: keep 1000 samples of a gamut");
  run::RunRecord record;
  reading.time([&] { record = run::Run(folder.path()).record_with_gamuts(); });
  reading.print("run.db: read the run");
  std::string report;
  reporting.time([&] { report = report::render_report(record, "load"); });
  reporting.print("report.html: make it");
  fmt::print("run: {} specimens, {} rounds of {} samples, run.db {:.0f} MB, report {:.1f} MB, memory {}\n",
             record.specimens.size(), record.rounds.size(), options.gamut,
             static_cast<double>(std::filesystem::file_size(file)) / 1e6, static_cast<double>(report.size()) / 1e6,
             peak_memory());
}

}  // namespace nacre::load
