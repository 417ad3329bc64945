#include <fmt/format.h>

#include "latencies.hpp"
#include "loads.hpp"
#include "made_up.hpp"
#include "report/report.hpp"
#include "run/run.hpp"
#include "run/run_database.hpp"
#include "wire/convert.hpp"

namespace nacre::load {

void load_run(const Options& options) {
  const std::filesystem::path file = options.folder / "run.db";
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
      measurements.time([&] { database.keep("MEASUREMENT", wire::write(measurement)); });
    }
    for (int round = 0; round <= options.rounds; ++round) {
      for (const wire::GamutChunk& chunk : wire::gamut_chunks(round, tester::Fidelity::preview, gamut))
        chunks.time([&] { database.keep("GAMUT", wire::write(chunk)); });
      wire::RoundSummary summary;
      summary.round = round;
      database.keep("ROUND", wire::write(summary));
    }
  }
  measurements.print("run.db: keep a measurement");
  chunks.print("run.db: keep 1000 samples of a gamut");
  run::RunRecord record;
  reading.time([&] { record = run::Run(options.folder).record_with_gamuts(); });
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
