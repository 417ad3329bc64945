#include "run_desk.hpp"

#include <algorithm>

#include "base/expected.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "families/families_file.hpp"
#include "laboratory_view.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/typed_specimen.hpp"
#include "output.hpp"
#include "runtime/bus.hpp"
#include "runtime/log_pieces.hpp"
#include "specimen_delivery.hpp"
#include "specimen_doubts.hpp"
#include "specimen_messages.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {

using dashboard::Answer;
using dashboard::Delivery;

constexpr double kPatience_s = 8.0, kPatienceForMany_s = 30.0;

namespace {

/// The results of the farm since the last published gamut, in a recording of the bus that may be growing. Of a damaged
/// one nothing: the points to come are shown all the same.
void read_results(const std::filesystem::path& log, const std::function<void(const std::string&)>& take) {
  std::vector<std::string> results;
  try {
    if (!std::filesystem::exists(log)) return;
    runtime::PiecesReader reader(log);
    while (auto record = reader.next()) {
      if (record->channel == "GAMUT") results.clear();
      if (record->channel == "SIMULATED") results.push_back(std::move(record->data));
    }
  } catch (const InputError&) {
    return;
  }
  for (const std::string& payload : results) take(payload);
}

}  // namespace

RunDesk::RunDesk(RunAccess run)
    : run_(std::move(run)),
      reader_(run_),
      feed_({.open =
                 [this] {
                   return listen(now(), {"STATUS", "SIMULATED"});
                 },
             .identity = [this] { return std::to_string(now().manifest.port); },
             .recorded = [this](const auto& take) { read_results(run_.folder / "run.lcm", take); }}) {}

RunAccess RunDesk::now() const {
  RunAccess run = run_;
  run.manifest = runtime::read_manifest(run.folder);
  return run;
}

std::shared_ptr<const dashboard::Laboratory> RunDesk::laboratory() {
  const auto view = reader_.view();
  if (read_ != view)
    laboratory_ = std::make_shared<const dashboard::Laboratory>(
        dashboard::Laboratory{view->facts, view->open_proposal, price_of_round(run_, *view)});
  read_ = view;
  return laboratory_;
}

void RunDesk::keep_grouping(const std::filesystem::path& folder, const std::vector<families::SeedFamily>& families) {
  make_folder(folder.string());
  write_file_atomically(folder / "families.toml", families::to_toml(families));
}

Answer RunDesk::keep_note(const dashboard::NoteFolder& folder, const dashboard::Note& note) {
  const auto kept = folder.keep(note, runtime::now_utime());
  return kept ? Answer{} : Answer{Delivery::refused, kept.error().message};
}

Answer RunDesk::print(const dashboard::PrintedTray& tray, const std::filesystem::path& build_sheet) {
  try {
    const auto specimens = specimens_of_build_sheet(build_sheet, tray.tray);
    if (tray.printed) {
      record_printed(run_, specimens, tray.by);
    } else {
      forget_printed(run_, specimens, measured_names(reader_.view()->facts));
    }
    return {};
  } catch (const InputError& error) {
    return {Delivery::refused, error.what()};
  }
}

Answer RunDesk::hand_in(const runtime::Message& message) {
  if (!is_playing(feed_.nodes())) return {Delivery::unanswered};
  const Delivered delivered = deliver(now(), "dashboard", message, kPatience_s);
  if (delivered.refusal) return {Delivery::refused, *delivered.refusal};
  return {delivered.missing.empty() ? Delivery::accepted : Delivery::unanswered};
}

std::vector<std::string> RunDesk::doubts_about(const measurement::SpecimenRecord& specimen) {
  std::vector<std::string> doubts = measurement::doubts_about(specimen);
  for (const auto& doubt : doubts_of({&specimen, 1})) doubts.push_back(doubt.text);
  return doubts;
}

std::vector<dashboard::SpecimenDoubt> RunDesk::doubts_of(std::span<const measurement::SpecimenRecord> specimens) {
  return cli::doubts_about(run_, *reader_.view(), specimens);
}

Answer RunDesk::enter(const measurement::SpecimenRecord& specimen, const std::optional<game::Amendment>& amend) {
  const auto handed = cli::hand_in(held_measurements(run_), specimen, run_.scenario.fidelity, amend);
  if (!handed) return {Delivery::conflicting};
  // Of a repeated one, too: the validation agent has it, the analyser may have been away.
  Answer answer = hand_in(handed->message);
  if (answer.delivery == Delivery::accepted && handed->is_repeated) answer.delivery = Delivery::repeated;
  return answer;
}

Answer RunDesk::enter(const measurement::SpecimenRecord& specimen) { return enter(specimen, std::nullopt); }

Result<measurement::SpecimenRecord> RunDesk::amended(const dashboard::Amendment& amendment) {
  const std::vector<game::Report> reports = reader_.view()->facts.book.reports_of(amendment.specimen);
  if (reports.empty()) return fail("specimen: the run has none of the name {}", amendment.specimen);
  auto specimen = measurement::with_changes(reports.back().record, amendment.changes);
  if (!specimen) return fail("{}: {}", specimen.error().column, specimen.error().reason);
  return *std::move(specimen);
}

Answer RunDesk::amend(const measurement::SpecimenRecord& specimen, const std::string& by, const std::string& why) {
  return enter(specimen, game::Amendment{.by = by, .why = why});
}

std::optional<std::string> RunDesk::against(const dashboard::Withdrawal& withdrawal) {
  const auto view = reader_.view();
  if (!withdrawal.order.empty()) return game::why_void(view->facts, withdrawal.order, withdrawal.withdrawn);
  const Result<pattern::Design> design = pattern::design_from_name(withdrawal.design);
  if (!design) return design.error().message;
  return game::why_void(view->facts, *design, withdrawal.withdrawn);
}

Answer RunDesk::withdraw(const dashboard::Withdrawal& withdrawal) {
  std::vector<std::string> orders = {withdrawal.order};
  if (withdrawal.order.empty())  // against() has read the design
    orders = game::orders_to_change(reader_.view()->facts, expected(pattern::design_from_name(withdrawal.design)),
                                    withdrawal.withdrawn);
  for (const std::string& order : orders) {
    const Answer answer = hand_in(withdrawal_message(
        run_, order, {.withdrawn = withdrawal.withdrawn, .by = withdrawal.by, .why = withdrawal.why}));
    if (answer.delivery != Delivery::accepted) return answer;
  }
  return {};
}

std::vector<Answer> RunDesk::enter_all(std::span<const measurement::SpecimenRecord> specimens) {
  std::vector<Answer> answers(specimens.size(), {Delivery::unanswered});
  if (specimens.empty() || !is_playing(feed_.nodes())) return answers;
  const auto delivered = deliver_specimens(now(), held_measurements(run_), specimens,
                                           {.name = "dashboard", .timeout_s = kPatienceForMany_s});
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = {delivered[i].delivery, delivered[i].reason};
  return answers;
}

/// In RUN/laboratory/imports; the same files are kept once.
void RunDesk::keep_import(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path imports = run_.folder / "laboratory" / "imports";
  if (std::filesystem::exists(imports / name)) return;
  make_folder(imports);
  const std::filesystem::path unfinished = imports / ("." + name);
  try {
    std::filesystem::remove_all(unfinished);
    std::filesystem::copy(folder, unfinished, std::filesystem::copy_options::recursive);
    std::filesystem::rename(unfinished, imports / name);
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError::format("{}: the imported files cannot be kept: {}", (imports / name).string(),
                             error.code().message());
  }
}

std::optional<std::string> RunDesk::against(const dashboard::SpecimenReview& review) {
  const auto view = reader_.view();
  const game::MeasurementBook& book = view->facts.book;
  const auto specimens = book.specimens();
  if (std::none_of(specimens.begin(), specimens.end(),
                   [&](const auto& each) { return each.specimen == review.specimen; }))
    return fmt::format("{}: expected the name of one of the run's {} specimens", review.specimen, specimens.size());
  return review.valid ? book.against_validity(review.specimen) : std::nullopt;
}

Answer RunDesk::review(const dashboard::SpecimenReview& review) {
  wire::Review message;
  message.specimen = review.specimen;
  message.revision = highest_revisions(run_)[review.specimen] + 1;
  message.valid = review.valid;
  message.by = review.by;
  message.why = review.why;
  return hand_in({"REVIEW", wire::write(message)});
}

std::optional<std::string> RunDesk::against(const dashboard::Approval& approval) {
  const Result<pattern::Design> design = pattern::design_from_name(approval.design);
  if (!design) return design.error().message;
  return game::why_void(reader_.view()->facts, {approval.round, *design, approval.approved, approval.by, approval.why},
                        run_.scenario.validation.approval);
}

Answer RunDesk::decide(const dashboard::Approval& approval) {
  wire::Approval message;
  message.round = approval.round;
  message.design = expected(pattern::design_from_name(approval.design));  // against() has read it
  message.approved = approval.approved;
  message.by = approval.by;
  message.why = approval.why;
  return hand_in({"APPROVAL", wire::write(message)});
}

}  // namespace nacre::cli
