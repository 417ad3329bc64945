// Part of the command line (command.hpp): nacre fabricate, files for a voxel printer, of designs or of what a game has
// ordered.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "dashboard/print_jobs.hpp"
#include "fabricate/build_sheet.hpp"
#include "fabricate/price.hpp"
#include "laboratory_view.hpp"
#include "measurement/limits.hpp"
#include "output.hpp"
#include "pattern/constraints.hpp"
#include "pattern/coupons.hpp"
#include "progress.hpp"
#include "run_access.hpp"

namespace nacre::cli {
namespace {

using fabricate::WantedSpecimens;
using tester::TestKind;

struct FabricateOptions {
  std::vector<std::string> designs;
  std::string out;
  std::string test = "toughness";
  int replicates = 4;
  double orientation_deg = 0.0;
  double thickness_mm = 3.2;
  double strain_rate_per_s = thesis::kTestStrainRate;
  std::string loading = "monotonic";
  bool twins = false;
  bool coupons = false;
  bool orders = false;
  std::string run = "logs/latest";
  std::string batch;
  std::string interface = "engineered";
  std::string grips = "pattern";
  bool print_cut = false;
  std::string printer;          ///< empty: the thesis', with the tray of the game
  std::vector<int> dpi;         ///< empty: the printer's
  std::string pixels;           ///< empty: the printer's
  std::vector<double> tray_mm;  ///< empty: the printer's
  bool tray_stacks = false;
  double gap_mm = 5.0;
  std::uint64_t seed = 1;
  bool replace = false;
  bool json = false;
};

/// The coupons of diagnosis: layers along and across the pull, squares of three sizes.
constexpr const char* kCoupons[] = {"laminate:x:1:1", "laminate:x:2:2", "laminate:x:5:5",
                                    "laminate:y:1:1", "laminate:y:2:2", "laminate:y:5:5",
                                    "checkerboard:1", "checkerboard:2", "checkerboard:5"};

std::vector<TestKind> tests_of(const std::string& test) {
  if (test == "both") return {TestKind::modulus, TestKind::toughness};
  return {*tester::test_kind_from_string(test)};
}

void warn_about_constraints(const pattern::Design& design) {
  if (design.layout() == nullptr) return;
  const auto pattern = pattern::Pattern::from_layout(*design.layout());
  if (!pattern) return;
  if (const auto violation = pattern::violation(*pattern)) warn(fmt::format("{}: {}", design.name(), *violation));
}

/// How coupons are pulled; another programme than monotonic is for homogeneous ones alone.
tester::Loading loading_of(const FabricateOptions& options) {
  const Result<tester::Loading> loading = tester::loading_from_string(options.loading);
  if (!loading) throw InputError::format("--loading: {}", loading.error().message);
  if (!loading->turns.empty() && options.test != "tensile")
    throw InputError("--loading: only coupons of --test tensile are unloaded on the way");
  return *loading;
}

std::vector<WantedSpecimens> wanted_by_name(const FabricateOptions& options) {
  const tester::Loading loading = loading_of(options);
  std::vector<std::string> names = options.designs;
  if (options.coupons) names.insert(names.end(), std::begin(kCoupons), std::end(kCoupons));
  std::vector<WantedSpecimens> wanted;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    const pattern::Design design = pattern::design_from_argument(name);
    if (!taken.insert(design.name()).second) {
      warn(fmt::format("{}: named twice, made once", name));
      continue;
    }
    warn_about_constraints(design);
    for (const TestKind test : tests_of(options.test)) {
      if (test == TestKind::tensile && design.mixture() == nullptr)
        throw InputError::format(
            "{}: a tensile test is of a homogeneous coupon, expected soft, interface, rigid or mix:F", name);
      wanted.push_back({.design = design,
                        .test = test,
                        .orientation_deg = options.orientation_deg,
                        .thickness_mm = options.thickness_mm,
                        .strain_rate_per_s = options.strain_rate_per_s,
                        .loading = loading,
                        .replicates = options.replicates});
      if (!options.twins || design.mixture() != nullptr) continue;
      wanted.push_back(wanted.back());
      wanted.back().orientation_deg = 90.0 - options.orientation_deg;
    }
  }
  return wanted;
}

/// The batch's name, or a similar one where the run has specimens or a job called so.
std::string free_batch(const std::string& batch, const RunAccess& run, const game::LaboratoryFacts& facts) {
  const std::string name = dashboard::free_job_name(batch, facts, jobs_folder(run));
  if (name != batch)
    remark(fmt::format("the run already has specimens called {}-01, ...: these are called {}-01, ...", batch, name));
  return name;
}

fabricate::Printer printer_of(const FabricateOptions& options, const fabricate::Printer& usual) {
  fabricate::Printer printer = options.printer.empty() ? usual : fabricate::printer_of_name(options.printer).printer;
  if (!options.dpi.empty()) {
    printer.dpi_x = options.dpi[0];
    printer.dpi_y = options.dpi[1];
    printer.dpi_z = options.dpi[2];
  }
  if (!options.tray_mm.empty()) {
    printer.tray_x_mm = options.tray_mm[0];
    printer.tray_y_mm = options.tray_mm[1];
  }
  if (!options.pixels.empty())
    printer.pixels = options.pixels == "rgba" ? fabricate::SlicePixels::rgba : fabricate::SlicePixels::indexed;
  return printer;
}

fabricate::JobRequest request_of(const FabricateOptions& options) {
  fabricate::JobRequest request;
  request.name = options.batch.empty()
                     ? without_last_slash(std::filesystem::weakly_canonical(options.out)).filename().string()
                     : options.batch;
  if (options.orders) {
    const RunAccess run = open_run(options.run);
    const LaboratoryView view = view_laboratory(run);
    request.rates = dashboard::rates_of(run.scenario);
    request.printer = dashboard::printer_of(run.scenario);
    request.wanted = dashboard::unprinted(view.facts);
    request.name = free_batch(request.name, run, view.facts);
  } else {
    request.wanted = wanted_by_name(options);
  }
  request.printer = printer_of(options, request.printer);
  request.tray_stacks = options.tray_stacks;
  request.interface = options.interface == "sharp" ? fabricate::Interface::sharp : fabricate::Interface::engineered;
  request.grips = options.grips == "rigid" ? fabricate::GripMaterial::rigid : fabricate::GripMaterial::pattern;
  request.notch.print_cut = options.print_cut;
  request.gap_mm = options.gap_mm;
  request.seed = options.seed;
  return request;
}

void print_job(const fabricate::Job& job, const fabricate::WrittenJob& written, const std::string& folder) {
  for (std::size_t i = 0; i < job.models.size(); ++i) {
    const fabricate::PrintModel& model = job.models[i];
    const fabricate::StackCount& count = written.models[i].count;
    fmt::print("{}: {} slices of {} x {} droplets, rigid {:.4f} (designed {:.4f}), {} copies\n", model.name,
               count.layers, count.columns, count.rows, fabricate::rigid_fraction(count.total),
               model.wanted.design.rigid_fraction(), model.wanted.replicates);
  }
  fmt::print("{}\n{}/build_sheet.html\n", fabricate::in_words(fabricate::price_of(job)), folder);
}

int fabricate_job(const FabricateOptions& options) {
  if (options.orders != options.designs.empty() && !options.coupons)
    throw InputError("nacre fabricate: expected designs to print, --coupons, or --orders for those of a game");
  if (options.orders && options.coupons) throw InputError("nacre fabricate: expected either --orders or --coupons");
  const fabricate::JobRequest request = request_of(options);
  if (request.wanted.empty()) {
    remark("nothing to print: every order of the game is printed or measured");
    if (options.json)
      print_json(
          {{"trays", 0}, {"models", nlohmann::ordered_json::array()}, {"specimens", nlohmann::ordered_json::array()}});
    return 1;
  }
  const fabricate::Job job = fabricate::plan_job(request);
  prepare_output_folder(options.out);
  if (options.replace) {
    fabricate::forget_job(options.out);
  } else if (fabricate::holds_another_job(options.out, job)) {
    throw InputError::format("{}: holds another print job; expected a new folder, or --replace", options.out);
  }
  Progress progress("fabricate");
  const auto written = fabricate::write_job(
      job, options.out, [&](double share, std::string_view model) { progress.set_share(share, std::string(model)); });
  progress.end();
  if (options.orders)
    dashboard::keep_build_sheet(jobs_folder(open_run(options.run)), request.name,
                                fabricate::build_sheet_json(job, written));
  if (options.json) {
    fmt::print("{}", fabricate::build_sheet_json(job, written));
  } else {
    print_job(job, written, options.out);
  }
  return 0;
}

}  // namespace

void add_fabricate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<FabricateOptions>();
  CLI::App& command =
      add_command(app, action, "fabricate", "Make print files: one picture per layer, build sheet, preview", options,
                  fabricate_job);
  command.add_option("DESIGN", options->designs, kDesignWords);
  command.add_option("--out", options->out, "Folder of the print job")->required();
  command
      .add_option("--test", options->test,
                  "toughness (notched specimen), modulus (ASTM D638 type I), both, or tensile (the bar, homogeneous, "
                  "with its curve)")
      ->check(CLI::IsMember({"modulus", "toughness", "both", "tensile"}))
      ->capture_default_str();
  command.add_option("--replicates", options->replicates, "Specimens of each design and test")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--orientation-deg", options->orientation_deg, "0, or 90: printed turned by a quarter turn")
      ->check(CLI::IsMember({0.0, 90.0}))
      ->capture_default_str();
  command.add_option("--thickness-mm", options->thickness_mm, "Thickness of the specimens")->capture_default_str();
  command.add_option("--strain-rate-per-s", options->strain_rate_per_s, "Strain rate at which they are to be pulled")
      ->check(CLI::Range(measurement::kStrainRatePerS.least, measurement::kStrainRatePerS.most))
      ->capture_default_str();
  command
      .add_option(
          "--loading", options->loading,
          "How a tensile coupon is to be pulled: monotonic, or the strains to turn at, \"strain 0.02 0.005 0.022\"")
      ->capture_default_str();
  command.add_flag("--twins", options->twins, "Also print each layout turned by a quarter turn");
  command.add_flag("--coupons", options->coupons, "Print the coupons for diagnosis: laminates and checkerboards");
  command.add_flag("--orders", options->orders, "Print the orders of a game that nobody has printed yet");
  add_run_option(command, options->run);
  command.add_option("--batch", options->batch, "Name of the print batch; default: the folder's name");
  command
      .add_option("--interface", options->interface,
                  "Droplets between soft and rigid pixels: half and half, or a sharp edge")
      ->check(CLI::IsMember({"engineered", "sharp"}))
      ->capture_default_str();
  command.add_option("--grips", options->grips, "Material of the gripped ends")
      ->check(CLI::IsMember({"pattern", "rigid"}))
      ->capture_default_str();
  command.add_flag("--print-cut", options->print_cut, "Print the triangular cut instead of milling it");
  std::string printers;
  for (const fabricate::NamedPrinter& each : fabricate::named_printers())
    printers += fmt::format("{}{} ({})", printers.empty() ? "" : "; ", each.name, each.words);
  command.add_option("--printer", options->printer, "Which printer: " + printers)->default_str("thesis");
  command.add_option("--dpi", options->dpi, "Droplets per inch in x, y, z; default: the printer's")
      ->delimiter(',')
      ->expected(3);
  command
      .add_option("--pixels", options->pixels,
                  "Slices: indexed (palette 0 none, 1 soft, 2 rigid) or rgba (a colour each); default: the printer's")
      ->check(CLI::IsMember({"indexed", "rgba"}));
  command.add_flag("--tray", options->tray_stacks, "Also one stack of slices for each whole tray");
  command
      .add_option("--tray-mm", options->tray_mm,
                  "Printable part of the tray, x, y; default: the printer's, with --orders that of the scenario")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--gap-mm", options->gap_mm, "Gap between specimens on the tray")->capture_default_str();
  add_seed(command, options->seed, "Seed of the mixtures' droplets and of the print order")->capture_default_str();
  command.add_flag("--replace", options->replace, "Delete another job in the folder first, filled-in sheets included");
  command.add_flag("--json", options->json, "Print the build sheet as JSON");
}

}  // namespace nacre::cli
