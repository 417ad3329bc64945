// Small tables: gamuts, base materials, benchmark lines, calibration stores, fault settings.

#include "explore/gamut_csv.hpp"
#include "fuzz.hpp"
#include "game/reference_tables.hpp"
#include "runtime/faults.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::expect_input_errors_only([&] {
    const auto gamut = explore::gamut_from_csv(text, "fuzz.csv");
    fuzz::expect(explore::gamut_from_csv(explore::to_csv(gamut), "again.csv").size() == gamut.size());
  });
  const fuzz::MemoryFile file(text);
  fuzz::expect_input_errors_only([&] { (void)game::read_base_materials(file.path()); });
  fuzz::expect_input_errors_only([&] { (void)game::read_benchmark_line(file.path()); });
  fuzz::expect_input_errors_only([&] { (void)runtime::parse_faults(text.substr(0, 200)); });
  return 0;
}
