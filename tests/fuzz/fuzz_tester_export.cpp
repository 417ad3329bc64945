// Exports of testing machines.

#include "fuzz.hpp"
#include "measurement/tester_export.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::string_view bytes = fuzz::text_of(data, size);
  (void)measurement::read_tester_export(bytes, "export.csv", {});
  return 0;
}
