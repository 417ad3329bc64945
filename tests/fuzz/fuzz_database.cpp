// SQLite files from elsewhere: a run's tables, a cache, what a damaged one still holds.

#include "fuzz.hpp"
#include "run/run.hpp"
#include "store/database_care.hpp"
#include "store/simulation_cache.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::filesystem::path file = fuzz::write_file("fuzz.db", fuzz::text_of(data, size));
  const std::filesystem::path saved = fuzz::memory_folder() / "saved.db";
  for (const char* companion : {"-wal", "-shm", "-journal"}) {
    std::filesystem::remove(file.string() + companion);
    std::filesystem::remove(saved.string() + companion);
  }
  std::filesystem::remove(saved);
  (void)store::check_database(file);
  fuzz::expect_input_errors_only([&] {
    run::Run run(file.parent_path(), file.filename());
    (void)run.record_with_gamuts();
  });
  fuzz::expect_input_errors_only([&] { (void)store::salvage_simulations(file, saved); });
  fuzz::expect_input_errors_only([&] {
    const store::SimulationCache cache(file);
    (void)cache.find("577fffe9fffdef");
    (void)cache.find_breaks("577fffe9fffdef");
  });
  return 0;
}
