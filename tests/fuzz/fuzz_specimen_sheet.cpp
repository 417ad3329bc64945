// Specimen sheets.

#include "fuzz.hpp"
#include "measurement/specimen_sheet.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  fuzz::expect_input_errors_only([&] { (void)measurement::read_specimen_sheet(file.path()); });
  return 0;
}
