// Scenarios: what is accepted is written and read back as the same.

#include "fuzz.hpp"
#include "game/scenario.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  fuzz::expect_input_errors_only([&] {
    const game::Scenario scenario = game::parse_scenario(fuzz::text_of(data, size), "fuzz.toml");
    fuzz::expect(game::parse_scenario(game::to_toml(scenario), "again.toml") == scenario);
  });
  return 0;
}
