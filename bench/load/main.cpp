// How nacre bears a load: 100,000 cached simulations, a gamut of 100,000 samples, 10,000 measurements. The contents are
// made up, the programs are the real ones. Results: docs/studies/reliability.md.
//   tests/multiprocess/isolated.sh build/bin/load

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "loads.hpp"

int main(int argc, char** argv) {
  using namespace nacre::load;
  CLI::App app{"Fills a cache, a run and a game, and times what a person does with them"};
  Options options;
  bool cache = false, run = false, injection = false;
  app.add_option("--folder", options.folder, "where everything is made; must not exist")->capture_default_str();
  app.add_option("--simulations", options.simulations, "results in the cache")->capture_default_str();
  app.add_option("--gamut", options.gamut, "samples of a gamut")->capture_default_str();
  app.add_option("--measurements", options.measurements, "specimens")->capture_default_str();
  app.add_option("--designs", options.designs, "patterns of the specimens")->capture_default_str();
  app.add_option("--seed", options.seed, "of the contents")->capture_default_str();
  app.add_flag("--cache", cache, "the cache only");
  app.add_flag("--run", run, "the run only");
  app.add_flag("--inject", injection, "the game only");
  CLI11_PARSE(app, argc, argv);
  const bool all = !cache && !run && !injection;
  try {
    if (std::filesystem::exists(options.folder))
      throw nacre::InputError::format("{} exists: remove it or give --folder", options.folder.string());
    std::filesystem::create_directories(options.folder);
    if (all || cache) load_cache(options);
    if (all || run) load_run(options);
    if (all || injection) load_injection(options);
  } catch (const nacre::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
