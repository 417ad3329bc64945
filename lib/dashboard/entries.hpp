#pragma once
// What people enter, from JSON that may be anything. Every error names the field and what was typed there.

#include <string_view>

#include "base/result.hpp"
#include "dashboard/desk.hpp"
#include "dashboard/notes.hpp"

namespace nacre::dashboard {

/// A specimen: the columns of a measurement set as members (text or numbers; `valid` may be a boolean), and
/// `curve_csv`, the text of a curve file. Errors are `COLUMN: what is wrong, what was expected`.
Result<measurement::SpecimenRecord> specimen_from_json(std::string_view text);

/// `specimen`, `valid`, `by`, `why` (not empty).
Result<SpecimenReview> specimen_review_from_json(std::string_view text);

/// `design` (canonical name), `round` (-1 or absent: a design of the person's own), `approved`, `by`, `why`.
Result<Approval> approval_from_json(std::string_view text);

/// `specimen`, `by`, `why` (not empty), and columns of a measurement set with other values.
Result<Amendment> amendment_from_json(std::string_view text);

/// `order` or `design` (canonical name), `withdrawn`, `by`, `why` (may be empty where an order is given again).
Result<Withdrawal> withdrawal_from_json(std::string_view text);

/// `name`, `printer`, `tray_stacks`, `tray_mm` (two numbers); all may be absent.
Result<PrintJobWish> print_job_from_json(std::string_view text);

/// `job`, `tray`, `printed`, `by`.
Result<PrintedTray> printed_tray_from_json(std::string_view text);

/// `job`: the name of a print job.
Result<std::string> job_name_from_json(std::string_view text);

/// `about`, `name`, `by`, `text` (lines end with LF), `photo` (base64, may be absent); a text or a photo at least.
Result<Note> note_from_json(std::string_view text);

/// `id` of a note.
Result<std::string> note_id_from_json(std::string_view text);

/// Whether a text names a model: the number of a round or the name of a family.
bool is_model_name(std::string_view name);

/// Which design to simulate with which model: `design`, `model` (the number of a round, or the name of a family).
struct SimulationRequest {
  pattern::Design design;
  std::string model;
};
Result<SimulationRequest> simulation_request_from_json(std::string_view text);

/// Families, a list of `name` and `seeds` (pattern keys): each name once, each seed in one family.
Result<std::vector<families::SeedFamily>> grouping_from_json(std::string_view text);

}  // namespace nacre::dashboard
