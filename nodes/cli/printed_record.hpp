#pragma once
// What of a run has been printed: RUN/laboratory/printed.csv, written by `nacre printed` and the dashboard, and the
// print jobs that the run knows, RUN/laboratory/jobs/NAME.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "game/design_states.hpp"
#include "run_access.hpp"

namespace nacre::cli {

/// A printed specimen and the person who wrote it down.
using PrintedRow = std::pair<game::PrintedSpecimen, std::string>;

/// Throws InputError naming file and line when the record cannot be read.
std::vector<PrintedRow> read_printed(const RunAccess& run);

/// Adds specimens to the record, but those that it holds already. Returns how many were new. Throws InputError, and
/// records nothing, when it holds another specimen of the same label.
int record_printed(const RunAccess& run, const std::vector<game::PrintedSpecimen>& specimens, const std::string& by);

/// The names of a run's measured specimens.
std::set<std::string> measured_names(const game::LaboratoryFacts& facts);

/// Takes specimens out of the record. Returns how many it held. Throws InputError, and takes none, when one of them is
/// among the names that are `measured`.
int forget_printed(const RunAccess& run, const std::vector<game::PrintedSpecimen>& specimens,
                   const std::set<std::string>& measured);

/// The specimens of a build sheet (JSON), or of one of its trays. Throws InputError naming file and key.
std::vector<game::PrintedSpecimen> specimens_of_build_sheet(const std::filesystem::path& file,
                                                            std::optional<int> tray = std::nullopt);

/// RUN/laboratory/jobs.
std::filesystem::path jobs_folder(const RunAccess& run);

}  // namespace nacre::cli
