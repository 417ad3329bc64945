// usage: seeds FOLDER: a sound input for every target, from where the fuzzer sets out. FOLDER is tests/fuzz/corpus.

#include <filesystem>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "../unit/wire/samples.hpp"
#include "base/files.hpp"
#include "film/film_file.hpp"
#include "game/scenario.hpp"
#include "material/parameter_file.hpp"
#include "run/run_database.hpp"
#include "runtime/journal.hpp"
#include "store/simulation_cache.hpp"
#include "wire/channels.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = NACRE_SOURCE_DIR;

struct Corpus {
  fs::path folder;
  void add(const std::string& target, const std::string& name, const std::string& bytes) const {
    fs::create_directories(folder / target);
    std::ofstream(folder / target / ("seed-" + name), std::ios::binary) << bytes;
  }
  void add_file(const std::string& target, const fs::path& file) const {
    add(target, file.filename().string(), read_file(kRoot / file));
  }
};

void add_messages(const Corpus& corpus) {
  int number = 0;
  for (const wire::Channel& channel : wire::channels()) {
    for (const auto& [name, payload] : wire::samples::payloads()) {
      if (name == channel.name) corpus.add("messages", name, static_cast<char>(number) + payload);
    }
    ++number;
  }
}

void add_journal(const Corpus& corpus) {
  const fs::path file = fs::temp_directory_path() / fmt::format("nacre-seeds-{}.lcm", ::getpid());
  {
    runtime::LogWriter writer(file);
    const std::string identity = runtime::pack({"1", "boot"});
    if (!writer.append(1, runtime::kJournalChannel, identity) || !writer.append(2, "ACK", "bytes") || !writer.flush()) {
      throw InputError("the seed of the journal cannot be written");
    }
  }
  corpus.add("journal", "two_records", read_file(file));
  corpus.add("journal", "torn", read_file(file).substr(0, 60));
  corpus.add("journal", "fields", runtime::pack({"id", "simulate", "spec"}));
  fs::remove(file);
}

void add_databases(const Corpus& corpus) {
  const fs::path file = fs::temp_directory_path() / fmt::format("nacre-seeds-{}.db", ::getpid());
  {
    run::RunDatabase run(file);
    for (const auto& [channel, payload] : wire::samples::payloads()) run.keep(channel, payload);
    run.checkpoint();
  }
  corpus.add("database", "run", read_file(file));
  fs::remove(file);
  {
    store::SimulationCache cache(file);
    store::CachedSimulation response;
    response.curve = wire::samples::curve();
    cache.insert("577fffe9fffdef", response);
    cache.insert_breaks("577fffe9fffdef", {{7, 0.5}});
  }
  corpus.add("database", "cache", read_file(file));
  for (const char* companion : {"", "-wal", "-shm"}) fs::remove(file.string() + companion);
}

/// A film as small as one can be.
film::Film small_film() {
  film::Film film;
  film.design = "soft";
  film.fidelity = "tiny";
  film.columns = film.rows = 3;
  film.element_size_m = 1e-3;
  film.toughness_pa = 1.0;
  film.end = "separated";
  film.curve = wire::samples::curve();
  film.material.assign(9, 0);
  film.crack.columns = film.crack.rows = 3;
  film.crack.order = {{4, 0.01}};
  film.largest_energy_j_per_m3 = 1.0;
  film.displacement_step_m = 1e-4;
  for (int i = 0; i < 2; ++i) {
    film.frames.push_back({0.01 * i, 1e6 * i, i, std::vector<std::uint8_t>(9, static_cast<std::uint8_t>(i)),
                           std::vector<std::int16_t>(32, static_cast<std::int16_t>(i))});
  }
  return film;
}

void add_batches(const Corpus& corpus) {
  std::string fields;
  for (const std::string& field : {std::string("nacre batch 1"), std::string("7"), std::string("/films")}) {
    fields += static_cast<char>(field.size()) + field;
  }
  corpus.add("batch", "batch", fields);
  corpus.add("batch", "listing", "nacre-1|0|RUNNING|None\nnacre-1|1|PENDING|launch failed requeued held\n");
}

void add_requests(const Corpus& corpus) {
  const std::string host = "host: 127.0.0.1:8765\n", cookie = "cookie: nacre_8765=0123456789abcdef\n";
  const std::string entry =
      host + cookie +
      "x-nacre: 1\ncontent-type: application/json\ncontent-length: 9\norigin: http://127.0.0.1:8765\n\n";
  corpus.add("dashboard", "gamut", "GET /api/gamut\n" + host + cookie + "?round=1\n\n");
  corpus.add("dashboard", "design",
             "GET /api/design\n" + host + "authorization: Bearer 0123456789abcdef\n?design=577fffe9fffdef\n\n");
  corpus.add("dashboard", "between",
             "GET /api/between\n" + host + "?patterns=577fffe9fffdef,3ffc9b4ad4d2d9\n?weights=0.25,0.75\n\n");
  corpus.add("dashboard", "map", "GET /api/map\n" + host + "?id=family-1/577fffe9fffdef\n\n");
  corpus.add("dashboard", "link", "GET /\n" + host + "?token=0123456789abcdef\n\n");
  corpus.add(
      "dashboard", "measurement",
      "POST /api/measurement\n" + entry +
          R"({"specimen":"a-1","pattern":"577fffe9fffdef","test":"toughness","curve_csv":"strain,stress_pa\n0,0\n)"
          R"(0.01,1e6\n0.02,2e6\n0.03,1e6\n0.04,0\n","valid":true})");
  corpus.add("dashboard", "review",
             "POST /api/review\n" + entry + R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})");
  corpus.add("dashboard", "check", "GET /api/check\n" + host + "?design=577fffe9fffdef\n?model=start\n\n");
  corpus.add("dashboard", "specimen", "GET /api/specimen\n" + host + "?specimen=a-1\n\n");
  corpus.add("dashboard", "photo", "GET /api/photo\n" + host + "?file=20260102T030405Z-specimen-a-0123456789.jpg\n\n");
  corpus.add("dashboard", "note",
             "POST /api/note\n" + entry +
                 R"({"about":"design","name":"577fffe9fffdef","by":"Ada","text":"a\nb","photo":"iVBORw0KGgoAAAAN"})");
  corpus.add("dashboard", "families", "GET /api/families\n" + host + cookie + "\n");
  corpus.add("dashboard", "grouping",
             "POST /api/grouping\n" + entry + R"({"families":[{"name":"mine","seeds":["577fffe9fffdef"]}]})");
  corpus.add(
      "dashboard", "approval",
      "POST /api/approval\n" + entry + R"({"design":"577fffe9fffdef","round":2,"approved":true,"by":"Ada","why":""})");
}

/// Parts as fuzz_dashboard.cpp cuts them.
void add_uploads(const Corpus& corpus) {
  const std::string head =
      "POST /api/import\nhost: 127.0.0.1:8765\ncookie: nacre_8765=0123456789abcdef\nx-nacre: 1\n"
      "content-type: multipart/form-data; boundary=x\ncontent-length: 9\norigin: http://127.0.0.1:8765\n\n";
  const std::string files =
      "sheet specimens.csv\nfile,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,a,soft,52,3.2,54"
      "%%export a.csv\nTime (s),Extension (mm),Force (N)\n0,0,0\n1,0.1,5";
  corpus.add("dashboard", "import", head + files);
  corpus.add("dashboard", "import-enter", head + files + "%%choice \n" + R"({"enter":["a"],"confirmed":["a"]})");
  corpus.add("dashboard", "import-traversal", head + files + "%%export ../b.csv\n0,0");
}

void add_texts(const Corpus& corpus) {
  corpus.add("measurement_set", "table",
             "specimen,pattern,test,modulus_pa,curve,valid,note\na,577fffe9fffdef,modulus,1e9,,1,\"x, y\"\n"
             "b,layout.txt,toughness,,curve.csv,0,\nc,mix:0.65,tensile,,curve.csv,,\n%%\nstrain,stress_pa\n0,0\n0.002,"
             "2410000\n"
             "0.004,4e6\n0.006,5e6\n0.008,0\n%%\n" +
                 read_file(kRoot / "data/patterns/published_a.txt"));
  corpus.add_file("tester_export", "data/examples/tester/tutorial-01.csv");
  corpus.add_file("specimen_sheet", "data/examples/tester/specimens.csv");
  corpus.add_file("scenario", "launch/demo.toml");
  corpus.add("scenario", "all_keys", to_toml(game::Scenario{}));
  corpus.add_file("parameters", "data/defaults.toml");
  corpus.add("parameters", "all_keys", material::to_toml(wire::samples::parameters()));
  corpus.add_file("laboratory", "data/examples/laboratory.toml");
  corpus.add_file("layout", "data/patterns/published_a.txt");
  for (const char* name : {"577fffe9fffdef", "mix:0.65", "interface"}) corpus.add("layout", name, name);
  corpus.add_file("tables", "data/thesis/base_materials.csv");
  corpus.add_file("tables", "data/thesis/homogeneous_benchmark.csv");
  corpus.add("tables", "gamut", "index,pattern,rigid_fraction,modulus_pa,toughness_pa\n0,577fffe9fffdef,0.8,1e9,1e5\n");
  corpus.add("tables", "faults", "seed=7,drop=0.2,duplicate=0.05,reorder=0.05,corrupt=0.01,clock=3600");
  corpus.add("film", "small", film::encode(small_film()));
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: seeds FOLDER\n", 2;
  const nacre::Corpus corpus{argv[1]};
  nacre::add_messages(corpus);
  nacre::add_journal(corpus);
  nacre::add_databases(corpus);
  nacre::add_batches(corpus);
  nacre::add_texts(corpus);
  nacre::add_requests(corpus);
  nacre::add_uploads(corpus);
}
