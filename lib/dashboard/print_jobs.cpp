#include "dashboard/print_jobs.hpp"

#include <algorithm>

#include "base/files.hpp"
#include "base/names.hpp"
#include "base/result.hpp"
#include "dashboard/round_price.hpp"
#include "fabricate/build_sheet.hpp"

namespace nacre::dashboard {
namespace {

namespace fs = std::filesystem;

constexpr const char *kBuildSheet = "build_sheet.json", *kTrays = "trays";
constexpr std::size_t kLongestJobName = 40, kMostSheetBytes = 64u << 20;

bool is_job_name(const std::string& name) {
  return is_plain_name(name, kLongestJobName, ".") && !name.starts_with('.');
}

/// Whether `label` is one of a job of this name: NAME-NN.
bool is_label_of(const std::string& job, const std::string& label) {
  const std::size_t digits = job.size() + 1;
  return label.starts_with(job + "-") && label.size() > digits &&
         label.find_first_not_of("0123456789", digits) == std::string::npos;
}

bool has_labels_of(const std::string& job, const game::LaboratoryFacts& facts) {
  const auto measured = facts.book.specimens();
  return std::ranges::any_of(facts.printed, [&](const auto& each) { return is_label_of(job, each.label); }) ||
         std::ranges::any_of(measured, [&](const auto& each) { return is_label_of(job, each.specimen); });
}

fabricate::Price price_in(const Json& sheet) {
  fabricate::Price price;
  const Json& stated = sheet.at("price");
  const auto field = [&](const char* name, auto& value) { stated.at(name).get_to(value); };
  fabricate::Price::fields(field, price);
  return price;
}

std::string printer_in(const Json& sheet) {
  const Json& printer = sheet.at("printer");
  return fmt::format("{} x {} dpi, layers of {:.1f} um, slices {}", printer.at("dpi").at(0).get<int>(),
                     printer.at("dpi").at(1).get<int>(), printer.at("layer_um").get<double>(),
                     printer.at("pixels") == "rgba" ? "in colours" : "indexed");
}

std::vector<PrintTrayRow> trays_in(const Json& sheet) {
  std::vector<PrintTrayRow> trays;
  for (const Json& tray : sheet.at("tray_stacks"))
    trays.push_back({.tray = tray.at("tray"), .batch = tray.at("batch"), .labels = {}});
  for (const Json& specimen : sheet.at("specimens"))
    trays.at(specimen.at("tray").get<std::size_t>() - 1).labels.push_back(specimen.at("label"));
  return trays;
}

PrintJobRow job_in(const fs::path& folder) {
  PrintJobRow row{.job = folder.filename().string(), .state = "ready", .progress = 1.0};
  try {
    const Json sheet = Json::parse(read_file_up_to(folder / kBuildSheet, kMostSheetBytes));
    row.has_files = fs::exists(folder / kTrays);
    row.printer = printer_in(sheet);
    row.price = fabricate::in_words(price_in(sheet));
    row.trays = trays_in(sheet);
  } catch (const std::exception& error) {  // a damaged sheet is no reason to hide the other jobs
    row.state = "failed";
    row.problem = fmt::format("{}: {}", (folder / kBuildSheet).string(), error.what());
  }
  return row;
}

/// The printer of the wish; the first one has the scenario's tray.
fabricate::Printer printer_wished(const PrintJobWish& wish, const game::Scenario& scenario) {
  fabricate::Printer printer = wish.printer.empty() || wish.printer == fabricate::named_printers()[0].name
                                   ? printer_of(scenario)
                                   : fabricate::printer_of_name(wish.printer).printer;
  if (wish.tray_mm) {
    printer.tray_x_mm = wish.tray_mm->at(0);
    printer.tray_y_mm = wish.tray_mm->at(1);
  }
  return printer;
}

/// Aside, then in its place: a job that can be seen is whole.
void write_job_in(const fs::path& jobs, const fabricate::Job& job, const std::function<void(double)>& progress) {
  const fs::path aside = jobs / ("." + job.request.name);
  fs::remove_all(aside);
  make_folder(aside.string());
  fabricate::write_job(job, aside, [&](double share, std::string_view) { progress(share); });
  fs::rename(aside, jobs / job.request.name);
}

}  // namespace

std::vector<fabricate::WantedSpecimens> unprinted(const game::LaboratoryFacts& facts) {
  const auto printed = game::printed_for(facts.orders, facts.printed);
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  std::vector<fabricate::WantedSpecimens> missing;
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const game::Order& order = facts.orders[i];
    const int count = order.replicates - std::max(printed[i], progress[i].arrived);
    if (!progress[i].complete && !facts.withdrawals.is_withdrawn(order.id) && count > 0)
      missing.push_back(wanted(order, count));
  }
  return missing;
}

std::string free_job_name(const std::string& name, const game::LaboratoryFacts& facts, const fs::path& jobs) {
  std::string free = name;
  for (int copy = 2; has_labels_of(free, facts) || fs::exists(jobs / free / kTrays); ++copy)
    free = fmt::format("{}_{}", name, copy);
  return free;
}

void keep_build_sheet(const fs::path& jobs, const std::string& name, const std::string& sheet) {
  make_folder((jobs / name).string());
  write_file_atomically(jobs / name / kBuildSheet, sheet);
}

PrintJobsRow PrintJobs::row(const game::LaboratoryFacts& facts, const game::Scenario& scenario) const {
  PrintJobsRow row;
  for (const fabricate::NamedPrinter& each : fabricate::named_printers()) {
    const fabricate::Printer printer = printer_wished({.printer = std::string(each.name)}, scenario);
    row.printers.push_back({std::string(each.name), std::string(each.words), printer.tray_x_mm, printer.tray_y_mm});
  }
  for (const auto& missing : unprinted(facts)) row.unprinted += missing.replicates;
  if (fs::exists(folder_))
    for (const auto& entry : fs::directory_iterator(folder_))
      if (const std::string name = entry.path().filename().string(); entry.is_directory() && is_job_name(name))
        row.jobs.push_back(job_in(entry.path()));
  const std::lock_guard lock(mutex_);
  for (const auto& [name, asked] : asked_) {
    if (std::ranges::find(row.jobs, name, &PrintJobRow::job) != row.jobs.end()) continue;
    const Background::State state = background_.state(asked.key);
    if (state.stage == Background::Stage::ready) continue;  // discarded since
    row.jobs.push_back({.job = name,
                        .state = std::string(to_string(state.stage)),
                        .progress = std::max(0.0, state.progress),
                        .problem = state.problem,
                        .price = asked.price});
  }
  std::ranges::sort(row.jobs, {}, &PrintJobRow::job);
  return row;
}

Result<std::string> PrintJobs::make(const PrintJobWish& wish, const game::LaboratoryFacts& facts,
                                    const game::Scenario& scenario) {
  try {
    const auto missing = unprinted(facts);
    if (missing.empty()) return fail("nothing to print: every order is printed, measured or withdrawn");
    int round = 0;
    for (const game::Order& order : facts.orders) round = std::max(round, order.round);
    const std::string name = wish.name.empty() ? fmt::format("r{}", round) : wish.name;
    if (!is_job_name(name)) return fail("name: '{}', expected 1 to 40 letters, digits, - _ and ., no . first", name);
    const fabricate::Job job = fabricate::plan_job({.name = free_job_name(name, facts, folder_),
                                                    .wanted = missing,
                                                    .printer = printer_wished(wish, scenario),
                                                    .rates = rates_of(scenario),
                                                    .tray_stacks = wish.tray_stacks});
    const std::lock_guard lock(mutex_);
    for (const auto& [other, asked] : asked_)
      if (const auto stage = background_.state(asked.key).stage;
          stage == Background::Stage::queued || stage == Background::Stage::working)
        return fail("{} is being made: wait for it", other);
    const std::string key = fmt::format("{}#{}", job.request.name, ++begun_);
    background_.ask(key, [job, folder = folder_](const auto& progress) {
      write_job_in(folder, job, progress);
      return Result<std::string>(std::string());
    });
    asked_[job.request.name] = {key, fabricate::in_words(fabricate::price_of(job))};
    return job.request.name;
  } catch (const InputError& error) {
    return fail("{}", error.what());
  }
}

std::optional<fs::path> PrintJobs::folder_of(const std::string& name) const {
  if (!is_job_name(name) || !fs::exists(folder_ / name / kBuildSheet)) return std::nullopt;
  return folder_ / name;
}

Result<bool> PrintJobs::discard(const std::string& name, const game::LaboratoryFacts& facts) {
  const auto folder = folder_of(name);
  if (!folder) return fail("there is no print job `{}`", name);
  if (has_labels_of(name, facts)) return fail("{} is printed in part: undo that first", name);
  std::error_code failure;
  fs::remove_all(*folder, failure);
  if (failure) return fail("{}: cannot be removed: {}", folder->string(), failure.message());
  return true;
}

}  // namespace nacre::dashboard
