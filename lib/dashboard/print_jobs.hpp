#pragma once
// Print jobs of a run, in RUN/laboratory/jobs/NAME: made here of the open orders, with all their files, or told by
// `nacre fabricate --orders`, with their build sheet alone.

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "dashboard/background.hpp"
#include "dashboard/desk.hpp"
#include "dashboard/page_fields.hpp"

namespace nacre::dashboard {

/// What nobody has printed or measured of the orders that are open.
std::vector<fabricate::WantedSpecimens> unprinted(const game::LaboratoryFacts& facts);

/// `name`, or the first of name_2, name_3, ... whose labels are free, since a label names a measurement: no specimen
/// that is printed or measured has one, and no job with files in `jobs` is called so.
std::string free_job_name(const std::string& name, const game::LaboratoryFacts& facts,
                          const std::filesystem::path& jobs);

/// Keeps the build sheet (JSON) of a job that was made elsewhere. Throws InputError.
void keep_build_sheet(const std::filesystem::path& jobs, const std::string& name, const std::string& sheet);

struct PrintTrayRow {
  static constexpr std::string_view kPageName = "PrintTray";
  int tray = 0;
  std::string batch;
  std::vector<std::string> labels;

  static void fields(auto& field, auto& m) {
    field("tray", m.tray);
    field("batch", m.batch);
    field("labels", m.labels);
  }
};

struct PrintJobRow {
  static constexpr std::string_view kPageName = "PrintJob";
  std::string job, state;    ///< `ready`, `queued`, `working`, `failed`
  double progress = 0.0;     ///< 0..1
  std::string problem = {};  ///< why it failed
  bool has_files = false;    ///< made here: slices and pictures are there
  std::string printer = {};  ///< in words
  std::string price = {};    ///< a sentence
  std::vector<PrintTrayRow> trays = {};

  static void fields(auto& field, auto& m) {
    field("job", m.job);
    field("state", m.state);
    field("progress", m.progress);
    field("problem", m.problem);
    field("has_files", m.has_files);
    field("printer", m.printer);
    field("price", m.price);
    field("trays", m.trays);
  }
};

struct PrinterRow {
  static constexpr std::string_view kPageName = "Printer";
  std::string name, words;
  double tray_x_mm = 0.0, tray_y_mm = 0.0;

  static void fields(auto& field, auto& m) {
    field("name", m.name);
    field("words", m.words);
    field("tray_x_mm", m.tray_x_mm);
    field("tray_y_mm", m.tray_y_mm);
  }
};

struct PrintJobsRow {
  static constexpr std::string_view kPageName = "PrintJobs";
  std::vector<PrinterRow> printers;  ///< the first has the scenario's tray
  int unprinted = 0;                 ///< specimens
  std::vector<PrintJobRow> jobs;     ///< by name

  static void fields(auto& field, auto& m) {
    field("printers", m.printers);
    field("unprinted", m.unprinted);
    field("jobs", m.jobs);
  }
};

class PrintJobs {
 public:
  explicit PrintJobs(std::filesystem::path folder) : folder_(std::move(folder)) {}
  PrintJobsRow row(const game::LaboratoryFacts& facts, const game::Scenario& scenario) const;
  /// Begins to make a job of what is unprinted; returns its name. The error says why there can be none.
  Result<std::string> make(const PrintJobWish& wish, const game::LaboratoryFacts& facts,
                           const game::Scenario& scenario);
  /// Of a job that is ready; nothing where there is none of that name.
  std::optional<std::filesystem::path> folder_of(const std::string& name) const;
  /// Removes a job with its files. The error says why it stays.
  Result<bool> discard(const std::string& name, const game::LaboratoryFacts& facts);

 private:
  std::filesystem::path folder_;
  mutable std::mutex mutex_;
  /// A job that was begun here.
  struct Asked {
    std::string key;  ///< of its work: another job may have the name of one that was discarded
    std::string price;
  };
  std::map<std::string, Asked> asked_;  ///< by name
  int begun_ = 0;
  Background background_;
};

}  // namespace nacre::dashboard
