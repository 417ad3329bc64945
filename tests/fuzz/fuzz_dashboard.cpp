// Requests of the dashboard: the first line is `METHOD PATH`, further lines up to an empty one `name: value` (a header)
// or `?name=value` (a parameter), then the body. A body at /api/import is parts, `NAME FILE`, a line end and its
// content up to `%%` each.

#include <set>

#include "../unit/dashboard/fake_desk.hpp"
#include "dashboard/dashboard.hpp"
#include "dashboard/entries.hpp"
#include "dashboard/guard.hpp"
#include "dashboard/maps.hpp"
#include "dashboard/several_runs.hpp"
#include "dashboard/upload.hpp"
#include "families/families_file.hpp"
#include "fuzz.hpp"

namespace nacre::fuzz {
namespace {

dashboard::Request request_from(std::string_view text) {
  dashboard::Request request;
  std::string_view head = cut(text, "\n\n");
  std::string_view first = cut(head, "\n");
  request.method = std::string(cut(first, " "));
  request.path = std::string(first);
  while (!head.empty()) {
    std::string_view line = cut(head, "\n");
    const bool is_parameter = line.starts_with("?");
    if (is_parameter) line.remove_prefix(1);
    const std::string name(cut(line, is_parameter ? "=" : ": "));
    (is_parameter ? request.query : request.headers).emplace(name, line);
  }
  request.body = std::string(text);
  return request;
}

std::vector<dashboard::Part> parts_from(std::string_view body) {
  std::vector<dashboard::Part> parts;
  while (!body.empty()) {
    std::string_view content = cut(body, "%%");
    std::string_view head = cut(content, "\n");
    const std::string name(cut(head, " "));
    parts.push_back({name, std::string(head), std::string(content)});
  }
  return parts;
}

/// What must hold of files that are written to a folder of this machine.
void expect_harmless(const dashboard::Upload& upload) {
  std::set<std::string> names{upload.sheet.name};
  for (const dashboard::UploadedFile& file : upload.exports) expect(names.insert(file.name).second);
  expect(!upload.exports.empty() && upload.exports.size() <= dashboard::kMostExports);
  for (const std::string& name : names) {
    const std::filesystem::path path = memory_folder() / name;
    expect(path.lexically_normal() == path && path.parent_path() == memory_folder() && !name.starts_with('.'));
  }
}

/// One page for all inputs: what is entered goes nowhere, and no simulation is started.
dashboard::SeveralRuns& page() {
  static dashboard::FakeDesk desk;
  static dashboard::Dashboard of_run(
      [] {
        dashboard::DashboardSettings settings;
        settings.run_folder = memory_folder() / "run";
        settings.family_folder = memory_folder() / "families";
        return settings;
      }(),
      desk);
  static dashboard::SeveralRuns page(memory_folder() / "page", {{"run", &of_run}, {"bad", nullptr, "unreadable"}});
  desk.specimens.clear();
  desk.reviews.clear();
  desk.approvals.clear();
  desk.withdrawals.clear();
  desk.amendments.clear();
  desk.groupings.clear();
  desk.notes.clear();
  return page;
}

}  // namespace
}  // namespace nacre::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  static const dashboard::AccessRules open{
      .hosts = dashboard::host_names("127.0.0.1", 8765), .token = "", .cookie_name = "nacre_8765"};
  static const dashboard::AccessRules closed{
      .hosts = open.hosts, .token = "0123456789abcdef", .cookie_name = "nacre_8765"};
  dashboard::Request request = fuzz::request_from(fuzz::text_of(data, size));
  const auto refusal = dashboard::refused(closed, request);
  // Whoever gets past the closed door knows the token.
  if (!refusal)
    fuzz::expect(request.header("authorization").ends_with(closed.token) ||
                 request.header("cookie").find(closed.token) != std::string::npos);
  (void)dashboard::refused(open, request);
  if (const auto specimen = dashboard::specimen_from_json(request.body)) fuzz::expect(!specimen->specimen.empty());
  if (const auto review = dashboard::specimen_review_from_json(request.body))
    fuzz::expect(!review->why.empty() && review->why.size() <= 500);
  if (const auto approval = dashboard::approval_from_json(request.body)) fuzz::expect(approval->round >= -1);
  if (const auto amendment = dashboard::amendment_from_json(request.body))
    fuzz::expect(!amendment->why.empty() && !amendment->changes.empty());
  if (const auto withdrawal = dashboard::withdrawal_from_json(request.body))
    fuzz::expect(withdrawal->order.empty() != withdrawal->design.empty());
  if (const auto note = dashboard::note_from_json(request.body))
    fuzz::expect(note->photo.empty() ? !note->text.empty() : dashboard::picture_kind(note->photo).has_value());
  if (request.path.ends_with(dashboard::kImportPath)) request.parts = fuzz::parts_from(request.body);
  if (const auto upload = dashboard::upload_from_parts(request.parts)) fuzz::expect_harmless(*upload);
  if (const auto wish = dashboard::print_job_from_json(request.body))
    fuzz::expect(!wish->tray_mm || wish->tray_mm->size() == 2);
  if (const auto tray = dashboard::printed_tray_from_json(request.body)) fuzz::expect(tray->tray >= 1);
  (void)dashboard::job_name_from_json(request.body);
  (void)dashboard::simulation_request_from_json(request.body);
  if (const auto grouping = dashboard::grouping_from_json(request.body))
    for (const families::SeedFamily& family : *grouping)
      fuzz::expect(families::is_family_name(family.name) && !family.seeds.empty());
  if (request.path.ends_with("/api/simulate")) return 0;  // would break specimens for minutes
  const dashboard::Response response = fuzz::page().handle(request);
  fuzz::expect(response.status != 500 && response.status >= 200);
  return 0;
}
