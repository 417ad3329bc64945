// Part of the command line (command.hpp): nacre measure, the virtual laboratory as a batch tool.

#include <algorithm>
#include <string>
#include <vector>

#include "base/counted.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "laboratory/laboratory.hpp"
#include "laboratory/measure_set.hpp"
#include "laboratory/temperature.hpp"
#include "output.hpp"
#include "pattern/design.hpp"
#include "progress.hpp"
#include "tester/loading.hpp"

namespace nacre::cli {
namespace {

struct MeasureOptions {
  std::vector<std::string> patterns;
  std::string laboratory;
  std::string out;
  std::string test = "both";
  std::string orientation = "0";
  std::vector<double> rates_per_s = laboratory::Campaign{}.rates_per_s;
  std::vector<double> temperatures_c;
  std::vector<double> holds_s;
  std::vector<std::string> machines;
  std::string loading;
  bool json = false;
};

int measure(const MeasureOptions& options) {
  laboratory::Campaign campaign;
  for (const std::string& argument : options.patterns) {
    campaign.designs.push_back(pattern::design_from_argument(argument));
  }
  if (options.test != "both") campaign.tests = {*tester::test_kind_from_string(options.test)};
  if (options.orientation == "90") campaign.orientations_deg = {90.0};
  if (options.orientation == "both") campaign.orientations_deg = {0.0, 90.0};
  campaign.rates_per_s = options.rates_per_s;
  campaign.temperatures_c = options.temperatures_c;
  campaign.holds_s = options.holds_s;
  campaign.machines = options.machines;
  if (!options.loading.empty()) {
    const Result<tester::Loading> loading = tester::loading_from_string(options.loading);
    if (!loading) throw InputError::format("--loading: {}", loading.error().message);
    campaign.loading = *loading;
  }
  prepare_output_folder(options.out);
  remark(fmt::format("measuring {}", counted(campaign.designs.size(), "design")));
  Progress progress("measure:");
  const auto records =
      laboratory::measure_set(options.laboratory, options.out, campaign, [&](double share, int done, int all) {
        progress.set_share(share, fmt::format("{} of {} simulations", done, all));
      });
  progress.end();
  const auto valid = std::count_if(records.begin(), records.end(), [](const auto& record) { return record.valid; });
  if (options.json) {
    print_json({{"specimens", records.size()}, {"valid", valid}, {"set", options.out}});
  } else {
    fmt::print("{} ({} valid): {}\n", counted(records.size(), "specimen"), valid, options.out);
  }
  return valid > 0 ? 0 : 1;
}

}  // namespace

void add_measure(CLI::App& app, Action& action) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App& command =
      add_command(app, action, "measure", "Measure patterns in the virtual laboratory", options, measure);
  command.add_option("PATTERN", options->patterns, kDesignWords)->required();
  command.add_option("--lab", options->laboratory, "Laboratory file, LAB.toml (docs/FORMATS.md)")->required();
  command
      .add_option("--out", options->out, "Folder of the measurement set; OUT.truth.toml keeps the hidden parameters")
      ->required();
  command.add_option("--test", options->test, "Which test to do")
      ->check(CLI::IsMember({"modulus", "toughness", "both", "tensile"}))
      ->capture_default_str();
  command
      .add_option("--orientation", options->orientation,
                  "Along the load (0), across it (90), or a specimen and its turned twin (both)")
      ->check(CLI::IsMember({"0", "90", "both"}))
      ->capture_default_str();
  command.add_option("--rate", options->rates_per_s, "Strain rates, 1/s, at each of which every test is done")
      ->check(CLI::Range(1e-7, 1e3))
      ->capture_default_str();
  command
      .add_option("--temperature", options->temperatures_c,
                  "Temperatures, degrees C, at each of which moduli and coupons are tested")
      ->check(CLI::Range(laboratory::kColdestC, laboratory::kHottestC));
  command
      .add_option("--hold", options->holds_s,
                  "Times, s, at which homogeneous moduli are read of one strain that is held, instead of pulls")
      ->check(CLI::Range(0.4, 1e6));
  command
      .add_option("--machine", options->machines, "Names of one or two machines, on each of which every test is done")
      ->expected(1, 2);
  command.add_option(
      "--loading", options->loading,
      "How coupons are pulled: monotonic, or to one strain after another (strain 0.02 0.005 0.022), also held and "
      "unloaded to zero force (strain 0.02 hold 60 unload dwell 600)");
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
