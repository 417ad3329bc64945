#include "dashboard/several_runs.hpp"

#include <algorithm>

#include <fmt/ranges.h>

#include "dashboard/runs_view.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::string_view kRuns = "/runs/";

}  // namespace

SeveralRuns::SeveralRuns(const std::filesystem::path& page_folder, std::vector<ShownRun> runs)
    : page_(page_folder), runs_(std::move(runs)) {}

Response SeveralRuns::handle(const Request& request) {
  const bool is_post = request.method == "POST";
  if (request.path == "/api/runs") return is_post ? error_response(405, "expected GET") : list();
  if (request.path.starts_with(kRuns)) return of_run(request);
  if (auto file = is_post ? std::nullopt : page_.find(request.path)) return *file;
  return of_first(request);
}

Response SeveralRuns::list() {
  RunsRow row;
  for (const ShownRun& shown : runs_) {
    row.runs.push_back(shown.dashboard ? shown.dashboard->listed() : ListedRunRow{.problem = shown.problem});
    row.runs.back().run = shown.name;
  }
  return json_response(wire::json_of(row));
}

Response SeveralRuns::of_run(Request request) {
  const std::size_t end = std::min(request.path.find('/', kRuns.size()), request.path.size());
  const std::string name = request.path.substr(kRuns.size(), end - kRuns.size());
  const auto is_meant = [&](const ShownRun& each) { return each.name == name; };
  // A folder that cannot be read may have the name of a run that can.
  auto shown = std::ranges::find_if(runs_, [&](const ShownRun& each) { return is_meant(each) && each.dashboard; });
  if (shown == runs_.end()) shown = std::ranges::find_if(runs_, is_meant);
  if (shown == runs_.end()) {
    std::vector<std::string> names;
    for (const ShownRun& each : runs_) names.push_back(each.name);
    return error_response(404, fmt::format("there is no run `{}` here, expected {}", name, fmt::join(names, ", ")));
  }
  if (shown->dashboard == nullptr) return error_response(503, shown->problem);
  request.path.erase(0, end);
  return shown->dashboard->handle(request);
}

Response SeveralRuns::of_first(const Request& request) {
  const auto first = std::ranges::find_if(runs_, [](const ShownRun& each) { return each.dashboard != nullptr; });
  return first->dashboard->handle(request);
}

}  // namespace nacre::dashboard
