#include "fabricate/build_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "fabricate/build_sheet_html.hpp"
#include "fabricate/preview.hpp"
#include "fabricate/price.hpp"
#include "fabricate/slice_png.hpp"
#include "fabricate/tray_preview.hpp"
#include "fabricate/tray_stack.hpp"
#include "measurement/specimen_sheet.hpp"
#include "pattern/coupons.hpp"

namespace nacre::fabricate {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSheetName = "build_sheet.json";
constexpr const char* kPeoplesSheetName = "build_sheet.html";
constexpr const char* kTableName = "specimens.csv";
constexpr const char* kPreviewName = "preview.png";

std::string tray_folder(int tray) { return fmt::format("trays/{}", tray); }

std::string slices_of(const WrittenModel& written) {
  return written.folder.empty() ? "slices" : written.folder + "/slices";
}

/// Smallest and largest rigid fraction of a layer.
std::pair<double, double> fraction_by_layer(const StackCount& count) {
  double least = 1.0, most = 0.0;
  for (const DropletCount& layer : count.by_layer) {
    least = std::min(least, rigid_fraction(layer));
    most = std::max(most, rigid_fraction(layer));
  }
  return {least, most};
}

Json test_json(const PrintModel& model) {
  const SpecimenGeometry geometry = geometry_of(model.plan.kind);
  Json test{{"width_mm", geometry.test_width_mm},
            {"gauge_mm", geometry.gauge_mm},
            {"grip_mm", geometry.grip_mm},
            {"strain_rate_per_s", model.wanted.strain_rate_per_s},
            {"speed_mm_per_min", test_speed_mm_per_min(model.wanted)},
            {"loading", tester::to_string(model.wanted.loading)}};
  if (model.plan.kind == SpecimenKind::tensile_bar) test["gauge_without_extensometer_mm"] = bar_effective_gauge_mm();
  return test;
}

Json model_json(const PrintModel& model, const WrittenModel& written) {
  const auto [least, most] = fraction_by_layer(written.count);
  return {{"name", model.name},
          {"slices", slices_of(written)},
          {"design", model.wanted.design.name()},
          {"readable_name", pattern::readable_name(model.wanted.design)},
          {"test", std::string(tester::to_string(model.wanted.test))},
          {"orientation_deg", model.wanted.orientation_deg},
          {"replicates", model.wanted.replicates},
          {"order_id", model.wanted.order_id},
          {"reason", model.wanted.reason},
          {"size_mm", {model.size_x_mm, model.size_y_mm, model.size_z_mm}},
          {"slice_count", written.count.layers},
          {"columns", written.count.columns},
          {"rows", written.count.rows},
          {"droplets",
           {{"none", written.count.total[0]}, {"soft", written.count.total[1]}, {"rigid", written.count.total[2]}}},
          {"rigid_fraction_designed", model.wanted.design.rigid_fraction()},
          {"rigid_fraction", rigid_fraction(written.count.total)},
          {"rigid_fraction_by_layer", {{"least", least}, {"most", most}}},
          {"testing", test_json(model)}};
}

Json specimen_json(const Job& job, const PlacedSpecimen& specimen) {
  const PrintModel& model = job.models[specimen.model];
  return {{"label", specimen.label},
          {"model", model.name},
          {"design", model.wanted.design.name()},
          {"test", std::string(tester::to_string(model.wanted.test))},
          {"replicate", specimen.replicate},
          {"print_order", specimen.print_order},
          {"batch", job.batch(specimen.tray)},
          {"tray", specimen.tray},
          {"x_mm", specimen.x_mm},
          {"y_mm", specimen.y_mm}};
}

Json tray_json(const Job& job, int tray, const WrittenTray& written) {
  Json json{{"tray", tray}, {"batch", job.batch(tray)}, {"preview", tray_folder(tray) + "/" + kPreviewName}};
  if (written.count.layers == 0) return json;
  const Printer& printer = job.request.printer;
  json["slices"] = tray_folder(tray) + "/slices";
  json["slice_count"] = written.count.layers;
  json["columns"] = written.count.columns;
  json["rows"] = written.count.rows;
  json["size_mm"] = {written.count.columns * pitch_mm(printer.dpi_x), written.count.rows * pitch_mm(printer.dpi_y),
                     written.count.layers * pitch_mm(printer.dpi_z)};
  json["corner_mm"] = {written.corner_x_mm, written.corner_y_mm};
  return json;
}

Json price_json(const Price& price) {
  Json json;
  const auto field = [&](const char* name, const auto& value) { json[name] = value; };
  Price::fields(field, price);
  return json;
}

Json printer_json(const Printer& printer) {
  const SliceColours colours = colours_of(printer.pixels);
  return {{"dpi", {printer.dpi_x, printer.dpi_y, printer.dpi_z}},
          {"layer_um", 1e3 * pitch_mm(printer.dpi_z)},
          {"tray_mm", {printer.tray_x_mm, printer.tray_y_mm}},
          {"pixels", printer.pixels == SlicePixels::rgba ? "rgba" : "indexed"},
          {"colours",
           {{"none", pattern::html_colour(colours.none)},
            {"soft", pattern::html_colour(colours.soft)},
            {"rigid", pattern::html_colour(colours.rigid)}}}};
}

Json sheet_json(const Job& job, const WrittenJob& written) {
  const JobRequest& request = job.request;
  Json models = Json::array(), specimens = Json::array(), trays = Json::array();
  for (std::size_t i = 0; i < job.models.size(); ++i) models.push_back(model_json(job.models[i], written.models[i]));
  for (int tray = 1; tray <= job.trays; ++tray) trays.push_back(tray_json(job, tray, written.trays[tray - 1]));
  for (const PlacedSpecimen& specimen : job.specimens) specimens.push_back(specimen_json(job, specimen));
  const Resin resin = resin_of(job, written);
  return {{"job", request.name},
          {"seed", request.seed},
          {"printer", printer_json(request.printer)},
          {"palette", {"none", "soft", "rigid"}},
          {"interface", request.interface == Interface::engineered ? "engineered" : "sharp"},
          {"grips", request.grips == GripMaterial::pattern ? "pattern" : "rigid"},
          {"cut", request.notch.print_cut ? "printed" : "to be milled"},
          {"trays", job.trays},
          {"price", price_json(price_of(job))},
          {"resin_ml", {{"soft", resin.soft_ml}, {"rigid", resin.rigid_ml}}},
          {"tray_stacks", trays},
          {"models", models},
          {"specimens", specimens}};
}

/// A sheet without the figures that were counted in the files, and what follows from the job and its rates.
Json plan_of(Json sheet) {
  for (const char* derived : {"price", "resin_ml", "tray_stacks"}) sheet.erase(derived);
  for (Json& model : sheet.at("models")) {
    for (const char* counted :
         {"slices", "slice_count", "columns", "rows", "droplets", "rigid_fraction", "rigid_fraction_by_layer"})
      model.erase(counted);
  }
  return sheet;
}

/// One row under measurement::kJobHeading.
std::string specimen_row(const Job& job, const PlacedSpecimen& specimen) {
  const PrintModel& model = job.models[specimen.model];
  const WantedSpecimens& wanted = model.wanted;
  const SpecimenGeometry geometry = geometry_of(model.plan.kind);
  return fmt::format(
      "{0}.csv,{0},{1},{2},{3},{4},{5},{6},{7:.6g},{8},{9},{10},{11},{12},,,,,\n", specimen.label,
      csv_cell(wanted.design.name()), tester::to_string(wanted.test), geometry.test_width_mm, wanted.thickness_mm,
      geometry.gauge_mm, wanted.orientation_deg, wanted.strain_rate_per_s,
      csv_cell(wanted.loading.has_pauses() ? tester::to_string(wanted.loading) : pull_in_words(wanted.loading)),
      job.batch(specimen.tray), specimen.print_order, csv_cell(wanted.order_id), specimen.tray);
}

void take_away(const std::filesystem::path& file) {
  std::error_code failure;
  std::filesystem::remove(file, failure);
  if (failure) throw InputError::format("{}: cannot be replaced: {}", file.string(), failure.message());
}

void take_away_when_empty(const std::filesystem::path& folder) {
  std::error_code failure;
  if (std::filesystem::is_empty(folder, failure) && !failure) take_away(folder);
}

/// The folder of a model of the job in `folder`; nothing where its name is not that of a folder there, or the folder is
/// a link: the files behind it do not belong to the job.
std::optional<std::filesystem::path> place_of(const Json& model, const std::filesystem::path& folder) {
  const auto slices = model.at("slices").get<std::string>();
  if (slices == "slices") return folder;
  const auto name = model.at("name").get<std::string>();
  const bool plain = name != "." && name != ".." && name.find('/') == std::string::npos;
  if (!plain || slices != name + "/slices" || std::filesystem::is_symlink(folder / name)) return std::nullopt;
  return folder / name;
}

/// The slices and the preview in `place`, and the folder unless it is that of the job.
void forget_stack(const std::filesystem::path& place, int slice_count, SlicePixels pixels,
                  const std::filesystem::path& job) {
  constexpr int kMostSlices = 100'000;  // limits the effect of a damaged sheet
  const std::filesystem::path slices = place / "slices";
  if (!std::filesystem::is_symlink(slices)) {
    for (int layer = 0; layer < std::min(slice_count, kMostSlices); ++layer)
      take_away(slices / slice_name(layer, pixels));
    take_away_when_empty(slices);
  }
  take_away(place / kPreviewName);
  if (place != job) take_away_when_empty(place);
}

/// Trays by their numbers, whatever paths a damaged sheet names.
void forget_trays(const Json& sheet, SlicePixels pixels, const std::filesystem::path& folder) {
  const std::filesystem::path trays = folder / "trays";
  if (std::filesystem::is_symlink(trays)) return;
  int tray = 0;
  for (const Json& each : sheet.value("tray_stacks", Json::array())) {
    const std::filesystem::path place = folder / tray_folder(++tray);
    if (!std::filesystem::is_symlink(place)) forget_stack(place, each.value("slice_count", 0), pixels, folder);
  }
  take_away_when_empty(trays);
}

/// Removes what the build sheet in `folder` lists; does nothing without a readable sheet.
void forget_models(const std::filesystem::path& folder) {
  std::error_code unreadable;
  if (!std::filesystem::exists(folder / kSheetName, unreadable)) return;
  try {
    const Json sheet = Json::parse(read_file(folder / kSheetName));
    const bool is_rgba = sheet.value("/printer/pixels"_json_pointer, "") == "rgba";
    const SlicePixels pixels = is_rgba ? SlicePixels::rgba : SlicePixels::indexed;
    for (const Json& model : sheet.at("models"))
      if (const auto place = place_of(model, folder))
        forget_stack(*place, model.at("slice_count").get<int>(), pixels, folder);
    forget_trays(sheet, pixels, folder);
  } catch (const Json::exception&) {
    return;  // a file of something else
  }
}

}  // namespace

Resin resin_of(const Job& job, const WrittenJob& written) {
  const Printer& printer = job.request.printer;
  constexpr double kMlPerCubicMm = 1e-3;
  const double droplet_ml = kMlPerCubicMm * pitch_mm(printer.dpi_x) * pitch_mm(printer.dpi_y) * pitch_mm(printer.dpi_z);
  Resin resin;
  for (std::size_t i = 0; i < job.models.size(); ++i) {
    const double each_ml = droplet_ml * job.models[i].wanted.replicates;
    resin.soft_ml += each_ml * static_cast<double>(written.models[i].count.total[static_cast<int>(Droplet::soft)]);
    resin.rigid_ml += each_ml * static_cast<double>(written.models[i].count.total[static_cast<int>(Droplet::rigid)]);
  }
  return resin;
}

std::string build_sheet_json(const Job& job, const WrittenJob& written) {
  return sheet_json(job, written).dump(2) + "\n";
}

bool holds_another_job(const std::filesystem::path& folder, const Job& job) {
  std::error_code unreadable;
  if (!std::filesystem::exists(folder / kSheetName, unreadable)) {  // interrupted, or somebody's own table
    return std::filesystem::exists(folder / kTableName, unreadable) &&
           read_file(folder / kTableName) != specimen_table(job);
  }
  try {
    const WrittenJob nothing{.models = std::vector<WrittenModel>(job.models.size()),
                             .trays = std::vector<WrittenTray>(job.trays)};
    const Json planned = Json::parse(sheet_json(job, nothing).dump());
    return plan_of(Json::parse(read_file(folder / kSheetName))) != plan_of(planned);
  } catch (const Json::exception&) {
    return true;
  }
}

void forget_job(const std::filesystem::path& folder) {
  forget_models(folder);
  for (const char* sheet : {kPeoplesSheetName, kTableName, kSheetName}) take_away(folder / sheet);
}

std::string specimen_table(const Job& job) {
  std::string table = fmt::format("{}\n", measurement::kJobHeading);
  for (const PlacedSpecimen& specimen : job.specimens) table += specimen_row(job, specimen);
  return table;
}

WrittenJob write_job(const Job& job, const std::filesystem::path& folder, const JobProgress& progress) {
  const Printer& printer = job.request.printer;
  WrittenJob written;
  std::vector<DropletPlan> plans;
  for (const PrintModel& model : job.models) plans.emplace_back(model.plan, printer);
  const auto stacks = static_cast<double>(job.models.size()) + job.trays;
  const auto say = [&](double share_of_stack, std::string_view what) {
    if (progress) progress((written.models.size() + written.trays.size() + share_of_stack) / stacks, what);
  };
  const auto write_stack = [&](const SliceStack& stack, const std::filesystem::path& place, const std::string& what) {
    constexpr double kWriting = 0.7;
    write_slices(stack, printer, place / "slices", [&](int layers) { say(kWriting * layers / stack.layers(), what); });
    return count_slices(place / "slices", printer.pixels);
  };
  for (std::size_t i = 0; i < job.models.size(); ++i) {
    const std::string& name = job.models[i].name;
    WrittenModel stack{.folder = job.models.size() == 1 ? "" : name, .count = {}};
    stack.count = write_stack(plans[i], folder / stack.folder, name);
    write_preview(plans[i], folder / stack.folder / kPreviewName);
    written.models.push_back(std::move(stack));
  }
  for (int tray = 1; tray <= job.trays; ++tray) {
    const std::filesystem::path place = folder / tray_folder(tray);
    make_folder(place);
    const TrayStack stack(job, tray, plans);
    WrittenTray files{.count = {}, .corner_x_mm = stack.corner_x_mm(), .corner_y_mm = stack.corner_y_mm()};
    if (job.request.tray_stacks) files.count = write_stack(stack, place, fmt::format("tray {}", tray));
    write_tray_preview(job, tray, plans, place / kPreviewName);
    written.trays.push_back(std::move(files));
  }
  if (!std::filesystem::exists(folder / kTableName))  // people fill it in
    write_file_atomically(folder / kTableName, specimen_table(job));
  write_file_atomically(folder / kPeoplesSheetName, build_sheet_html(job, written));
  write_file_atomically(folder / kSheetName, build_sheet_json(job, written));
  return written;
}

}  // namespace nacre::fabricate
