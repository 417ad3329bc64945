// The testers on an accelerator: do they agree with the processor's, and how fast are they? docs/studies/gpu.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "commands.hpp"

int main(int argc, char** argv) {
  using namespace nacre::gpu_study;
  CLI::App app{"Fracture tests by the batch on an accelerator"};
  Options options;
  app.require_subcommand(1);
  const auto with_common = [&](CLI::App* command, const char* table) {
    command->add_option("--fidelity", options.fidelity)
        ->check(CLI::IsMember({"tiny", "preview", "full"}))
        ->capture_default_str();
    command->add_flag("--emulated", options.emulated, "this processor in the device's place");
    command->add_option("--most-places", options.most_places, "specimens on the device at a time")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--table", options.table, fmt::format("CSV file; default: {}", table));
    command->preparse_callback([&options, table](std::size_t) { options.table = table; });
    return command;
  };
  CLI::App* agreement = with_common(app.add_subcommand("agreement", "Device against processor"), "gpu_agreement.csv");
  agreement->add_option("--count", options.count, "patterns")->check(CLI::PositiveNumber)->capture_default_str();
  agreement->callback([&] { run_agreement(options); });
  CLI::App* throughput =
      with_common(app.add_subcommand("throughput", "Speed against batch size"), "gpu_throughput.csv");
  throughput->add_option("--batches", options.batches, "batch sizes")->check(CLI::PositiveNumber);
  throughput->add_option("--strain-limit", options.strain_limit)->check(CLI::PositiveNumber)->capture_default_str();
  throughput->callback([&] { run_throughput(options); });
  try {
    CLI11_PARSE(app, argc, argv);
  } catch (const nacre::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
