// Exports of testing machines.

#include "fuzz.hpp"
#include "measurement/tester_export.hpp"
#include "measurement/tester_encoding.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::string_view bytes = fuzz::text_of(data, size);
  (void)measurement::utf8_from_instrument(bytes);
  (void)measurement::read_tester_export(bytes, "export.csv", {});
  return 0;
}
