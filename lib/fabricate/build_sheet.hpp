#pragma once
// A print job on disk: slices, previews, and the sheets that people and `nacre import` read.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fabricate/job.hpp"
#include "fabricate/slices.hpp"

namespace nacre::fabricate {

/// The files of one model.
struct WrittenModel {
  std::string folder;  ///< of its slices and preview, relative to the job; "" for a job of one model
  StackCount count;    ///< counted back from the files
};

/// The files of one tray.
struct WrittenTray {
  StackCount count;                             ///< counted back from the files; no layers: no stack was asked for
  double corner_x_mm = 0.0, corner_y_mm = 0.0;  ///< of the stack, from the tray's front left corner
};

struct WrittenJob {
  std::vector<WrittenModel> models;
  std::vector<WrittenTray> trays;
};

/// What the droplets of a job's specimens, as counted in the files, hold: without support and purging.
struct Resin {
  double soft_ml = 0.0, rigid_ml = 0.0;
};
Resin resin_of(const Job& job, const WrittenJob& written);

/// Called with the finished share (0..1) and the present activity.
using JobProgress = std::function<void(double, std::string_view)>;

/// Writes a job into `folder`: per model `slices/NNNN.png` and `preview.png` (in the folder itself when there is one
/// model, else in a folder of its name), per tray `trays/N/preview.png` and, where asked for, `trays/N/slices`,
/// `specimens.csv` for `nacre import` unless it is there, `build_sheet.html`, and last `build_sheet.json`. Throws
/// InputError naming the file.
WrittenJob write_job(const Job& job, const std::filesystem::path& folder, const JobProgress& progress = {});

/// Whether the sheets in `folder` belong to another job, so that writing this one would lose them.
bool holds_another_job(const std::filesystem::path& folder, const Job& job);

/// Removes a job so that another can be written: its slices and previews, as its build sheet lists them, folders that
/// are empty then, and last its sheets, including what people filled in. Other files stay. Throws InputError.
void forget_job(const std::filesystem::path& folder);

/// The build sheet as JSON (docs/FORMATS.md).
std::string build_sheet_json(const Job& job, const WrittenJob& written);

/// The table that `nacre import --specimens` reads, one row per specimen, to be filled in at the testing machine.
std::string specimen_table(const Job& job);

}  // namespace nacre::fabricate
