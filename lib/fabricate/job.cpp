#include "fabricate/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/hash.hpp"
#include "base/names.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "fabricate/packing.hpp"
#include "pattern/coupons.hpp"

namespace nacre::fabricate {
namespace {

void check_name(const std::string& name) {
  if (!is_plain_name(name, 40, "."))
    throw InputError::format("batch \"{}\": expected 1 to 40 of A-Z, a-z, 0-9, . _ - (option --batch)", name);
}

/// A design as part of a folder's name: keys of coupons, which are long, by their first digits of a hash.
std::string short_name(const pattern::Design& design) {
  std::string name = pattern::readable_name(design);
  constexpr std::size_t kLongest = 32, kHashDigits = 12;
  if (name.size() > kLongest) name = "L" + content_hash(name).substr(0, kHashDigits);
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

PrintModel model_of(const WantedSpecimens& wanted, const JobRequest& request) {
  if (wanted.replicates < 1 || wanted.replicates > 100) {
    throw InputError::format("{}: {} replicates, expected 1 to 100", wanted.design.name(), wanted.replicates);
  }
  PrintModel model{.wanted = wanted, .plan = {}, .name = {}};
  model.plan = {.design = wanted.design,
                .kind = specimen_kind(wanted.test),
                .orientation_deg = wanted.orientation_deg,
                .thickness_mm = wanted.thickness_mm,
                .interface = request.interface,
                .grips = request.grips,
                .notch = request.notch,
                .seed = RandomStream(request.seed, "mixture of " + wanted.design.name()).bits()};
  const bool turned = wanted.orientation_deg == 90.0;
  const SpecimenGeometry geometry = geometry_of(model.plan.kind);
  model.size_x_mm = 1e-3 * static_cast<double>(turned ? geometry.length_um : geometry.width_um);
  model.size_y_mm = 1e-3 * static_cast<double>(turned ? geometry.width_um : geometry.length_um);
  model.size_z_mm = wanted.thickness_mm;
  model.name =
      fmt::format("{}-{}{}", short_name(wanted.design), tester::to_string(wanted.test), turned ? "-turned" : "");
  if (wanted.thickness_mm != 3.2) model.name += fmt::format("-{}mm", wanted.thickness_mm);
  return model;
}

/// Models by their number, each as often as it has replicates, random within blocks of one of each.
std::vector<std::pair<std::size_t, int>> random_blocks(const std::vector<PrintModel>& models, std::uint64_t seed) {
  RandomStream random(seed, "print order");
  std::vector<std::pair<std::size_t, int>> order;
  int rounds = 0;
  for (const PrintModel& model : models) rounds = std::max(rounds, model.wanted.replicates);
  for (int replicate = 1; replicate <= rounds; ++replicate) {
    std::vector<std::size_t> block;
    for (std::size_t model = 0; model < models.size(); ++model) {
      if (models[model].wanted.replicates >= replicate) block.push_back(model);
    }
    while (!block.empty()) {
      const auto drawn = block.begin() + random.index(static_cast<int>(block.size()));
      order.emplace_back(*drawn, replicate);
      block.erase(drawn);
    }
  }
  return order;
}

/// Numbers trays by the first of their specimens.
void number_trays(std::vector<PlacedSpecimen>& specimens) {
  std::map<int, int> numbers;
  for (PlacedSpecimen& specimen : specimens)
    specimen.tray = numbers.emplace(specimen.tray, static_cast<int>(numbers.size()) + 1).first->second;
}

/// Packs the specimens. Of those of one size, which lies where follows their random order: the packing hangs on sizes
/// alone.
void place_all(Job& job) {
  const JobRequest& request = job.request;
  const Printer& printer = request.printer;
  const auto drawn = random_blocks(job.models, request.seed);
  std::vector<Rectangle> bases;
  for (const auto& [index, replicate] : drawn)
    bases.push_back({job.models[index].size_x_mm, job.models[index].size_y_mm});
  const std::vector<Place> places = packed(bases, {printer.tray_x_mm, printer.tray_y_mm}, request.gap_mm);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto& [index, replicate] = drawn[i];
    if (places[i].tray == 0)
      throw InputError::format("{}: {} x {} mm with a gap of {} mm does not fit on a tray of {} x {} mm",
                               job.models[index].name, bases[i].x_mm, bases[i].y_mm, request.gap_mm, printer.tray_x_mm,
                               printer.tray_y_mm);
    job.trays = std::max(job.trays, places[i].tray);
    job.specimens.push_back({.label = {},
                             .model = index,
                             .replicate = replicate,
                             .print_order = 0,
                             .tray = places[i].tray,
                             .x_mm = places[i].x_mm,
                             .y_mm = places[i].y_mm});
  }
  number_trays(job.specimens);
}

/// Voxel Print refuses stacks of fewer slices.
void check_layers(const Job& job) {
  constexpr int kFewest = 30;
  if (job.request.printer.pixels != SlicePixels::rgba) return;
  for (const PrintModel& model : job.models)
    if (const int layers = layers_of(model.size_z_mm, job.request.printer); layers < kFewest)
      throw InputError::format("{}: {} mm are {} layers: Voxel Print takes {} at least", model.name, model.size_z_mm,
                               layers, kFewest);
}

/// Print order and labels, tray by tray.
void number(Job& job) {
  std::stable_sort(job.specimens.begin(), job.specimens.end(),
                   [](const PlacedSpecimen& a, const PlacedSpecimen& b) { return a.tray < b.tray; });
  const int digits = job.specimens.size() < 100 ? 2 : 4;
  for (std::size_t i = 0; i < job.specimens.size(); ++i) {
    job.specimens[i].print_order = static_cast<int>(i) + 1;
    job.specimens[i].label = fmt::format("{}-{:0{}}", job.request.name, i + 1, digits);
  }
}

}  // namespace

std::string pull_in_words(const tester::Loading& loading) {
  std::string words;
  double before = 0.0;
  for (std::size_t i = 0; i < loading.turns.size(); ++i) {
    const double turn = loading.turns[i], percent = 100.0 * turn;
    words += words.empty() ? fmt::format("to {:g} % strain", percent)
                           : fmt::format(", {} to {:g} %", turn < before ? "back" : "on", percent);
    if (i < loading.holds_s.size() && loading.holds_s[i] > 0.0)
      words += fmt::format(", held for {:g} s", loading.holds_s[i]);
    before = turn;
  }
  if (loading.dwell_s) words += ", back to zero force";
  if (loading.dwell_s.value_or(0.0) > 0.0) words += fmt::format(", left there for {:g} s", *loading.dwell_s);
  return words.empty() ? tester::to_string(loading) : words;
}

double test_speed_mm_per_min(const WantedSpecimens& wanted) {
  // A bar is strained by the travel over its effective length, whatever the extensometer's gauge is.
  const SpecimenKind kind = specimen_kind(wanted.test);
  const double length_mm = kind == SpecimenKind::toughness ? geometry_of(kind).gauge_mm : bar_effective_gauge_mm();
  return 60.0 * wanted.strain_rate_per_s * length_mm;
}

std::string Job::batch(int tray) const { return trays > 1 ? fmt::format("{}.{}", request.name, tray) : request.name; }

Job plan_job(const JobRequest& request) {
  check_name(request.name);
  check_printer(request.printer);
  if (request.wanted.empty()) throw InputError("nothing to print: expected at least one design");
  if (!(request.gap_mm >= 0.0 && request.gap_mm <= 100.0))
    throw InputError::format("gap of {} mm: expected 0 to 100", request.gap_mm);
  Job job{.request = request, .models = {}, .specimens = {}};
  for (const WantedSpecimens& wanted : request.wanted) {
    PrintModel model = model_of(wanted, request);
    const std::string name = model.name;
    const auto taken = [&](const PrintModel& other) { return other.name == model.name; };
    for (int copy = 2; std::any_of(job.models.begin(), job.models.end(), taken); ++copy)
      model.name = fmt::format("{}-{}", name, copy);
    job.models.push_back(std::move(model));
  }
  check_layers(job);
  place_all(job);
  number(job);
  return job;
}

}  // namespace nacre::fabricate
