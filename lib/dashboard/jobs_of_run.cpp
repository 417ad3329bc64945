// Part of the dashboard of one run: its print jobs.

#include <fmt/format.h>

#include "base/files.hpp"
#include "dashboard/dashboard.hpp"
#include "dashboard/entries.hpp"
#include "dashboard/request_parts.hpp"
#include "fabricate/job_zip.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kMostPictureBytes = 16u << 20;

}  // namespace

Response Dashboard::jobs(const Request&) {
  const std::lock_guard lock(desk_mutex_);
  return row_response(print_jobs_.row(desk_.laboratory()->facts, settings_.scenario));
}

std::filesystem::path Dashboard::job_folder(const Request& request) const {
  const std::string name = parameter(request, "job");
  const auto folder = print_jobs_.folder_of(name);
  if (!folder) throw Refusal{404, fmt::format("there is no print job `{}`", name)};
  return *folder;
}

Response Dashboard::job(const Request& request) {
  const std::filesystem::path folder = job_folder(request);
  return {.type = "application/zip",
          .body = {},
          .headers = {{"Content-Disposition", fmt::format("attachment; filename=\"{}-{}.zip\"", settings_.run_id,
                                                          folder.filename().string())}},
          .stream = [folder](const auto& send) { fabricate::write_zip(folder, send); }};
}

Response Dashboard::tray(const Request& request) {
  const int tray = number(parameter(request, "tray"), "tray");
  const std::filesystem::path file = job_folder(request) / "trays" / std::to_string(tray) / "preview.png";
  std::error_code unreadable;
  if (std::filesystem::symlink_status(file, unreadable).type() != std::filesystem::file_type::regular)
    return error_response(404, "there is no picture of this tray");
  return {.type = "image/png", .body = read_file_up_to(file, kMostPictureBytes), .headers = {}};
}

Response Dashboard::make_job(const Request& request) {
  const auto wish = or_refuse(print_job_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  const std::string name = or_refuse(print_jobs_.make(wish, desk_.laboratory()->facts, settings_.scenario));
  return json_response({{"answer", to_string(Delivery::accepted)}, {"job", name}});
}

Response Dashboard::discard_job(const Request& request) {
  const auto name = or_refuse(job_name_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  or_refuse(print_jobs_.discard(name, desk_.laboratory()->facts));
  return delivery_response({});
}

Response Dashboard::print(const Request& request) {
  const auto tray = or_refuse(printed_tray_from_json(request.body));
  const auto folder = print_jobs_.folder_of(tray.job);
  if (!folder) throw Refusal{404, fmt::format("there is no print job `{}`", tray.job)};
  const std::lock_guard lock(desk_mutex_);
  return delivery_response(desk_.print(tray, *folder / "build_sheet.json"));
}

}  // namespace nacre::dashboard
