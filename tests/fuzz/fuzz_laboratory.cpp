// Laboratory files.

#include "fuzz.hpp"
#include "laboratory/laboratory_file.hpp"
#include "laboratory/truth.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  fuzz::expect_input_errors_only([&] { (void)laboratory::parse_laboratory(fuzz::text_of(data, size), "fuzz.toml"); });
  return 0;
}
