// A measurement set: the table, then a curve and a layout that it may name (curve.csv, layout.txt).

#include "fuzz.hpp"
#include "measurement/read_set.hpp"
#include "measurement/summary.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  std::string_view rest = fuzz::text_of(data, size);
  fuzz::write_file("measurements.csv", fuzz::cut(rest, "%%\n"));
  fuzz::write_file("curve.csv", fuzz::cut(rest, "%%\n"));
  fuzz::write_file("layout.txt", rest);
  fuzz::expect_input_errors_only([] {
    const auto set = measurement::read_measurement_set(fuzz::memory_folder());
    (void)measurement::summarise(set.specimens);
  });
  return 0;
}
