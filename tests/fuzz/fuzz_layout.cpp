// Names, keys and files of designs: what is accepted has a name that means the same.

#include "fuzz.hpp"
#include "pattern/design.hpp"
#include "pattern/layout.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  const std::string_view text = fuzz::text_of(data, size);
  if (const auto design = pattern::design_from_name(text)) {
    const auto again = pattern::design_from_name(design->name());
    fuzz::expect(again.has_value() && *again == *design);
  }
  (void)pattern::layout_from_key(text);
  if (const auto layout = pattern::layout_from_text(text, "fuzz.txt")) {
    const auto again = pattern::layout_from_text(pattern::to_text(*layout), "again.txt");
    fuzz::expect(again.has_value() && *again == *layout);
  }
  return 0;
}
