// Parameter files.

#include "fuzz.hpp"
#include "material/parameter_file.hpp"
#include "material/parameters.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  static const material::ParameterSet start = material::default_parameters();
  fuzz::expect_input_errors_only([&] {
    const auto parameters = material::read_parameters(file.path(), start);
    fuzz::expect(material::parameter_fault(parameters).empty());
  });
  return 0;
}
