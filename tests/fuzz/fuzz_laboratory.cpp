// Laboratory files.

#include "fuzz.hpp"
#include "virtual_lab/truth.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  fuzz::expect_input_errors_only(
      [&] { (void)virtual_laboratory::parse_laboratory(fuzz::text_of(data, size), "fuzz.toml"); });
  return 0;
}
