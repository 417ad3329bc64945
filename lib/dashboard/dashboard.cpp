#include "dashboard/dashboard.hpp"

#include <algorithm>

#include "base/files.hpp"
#include "dashboard/diagnosis_view.hpp"
#include "dashboard/entries.hpp"
#include "dashboard/families_view.hpp"
#include "dashboard/gamut_view.hpp"
#include "dashboard/imports.hpp"
#include "dashboard/laboratory_view.hpp"
#include "dashboard/next_view.hpp"
#include "dashboard/nodes_view.hpp"
#include "dashboard/request_parts.hpp"
#include "dashboard/rounds_view.hpp"
#include "dashboard/run_view.hpp"
#include "game/budget.hpp"
#include "run/measured_patterns.hpp"
#include "runtime/bus.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kMostReportBytes = 64u << 20;

int round_of(const Request& request) { return number(parameter(request, "round"), "round"); }

/// The response to an entry that would change nothing.
Response conflict_response(const std::string& reason) {
  return json_response({{"answer", to_string(Delivery::conflicting)}, {"error", reason}}, 409);
}

/// Where the database cannot be read, no: the page shall go on showing the nodes.
bool is_known_to_be_over(run::Run& data) {
  try {
    return run::is_over(*data.record());
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

Dashboard::Dashboard(DashboardSettings settings, Desk& desk)
    : settings_(std::move(settings)),
      desk_(desk),
      run_(settings_.run_folder),
      family_folder_(settings_.family_folder),
      note_folder_(settings_.run_folder / "notes"),
      print_jobs_(settings_.run_folder / "laboratory" / "jobs"),
      films_(settings_.run_folder, settings_.scenario.fidelity) {}

const std::map<std::string, Dashboard::Route>& Dashboard::get_routes() {
  static const std::map<std::string, Route> routes = {{"/api/run", &Dashboard::run},
                                                      {"/api/live", &Dashboard::live},
                                                      {"/api/rounds", &Dashboard::rounds},
                                                      {"/api/gamut", &Dashboard::gamut},
                                                      {"/api/design", &Dashboard::design},
                                                      {"/api/film", &Dashboard::film},
                                                      {"/api/check", &Dashboard::check},
                                                      {"/api/mechanisms", &Dashboard::mechanisms},
                                                      {"/api/simulation", &Dashboard::simulation},
                                                      {"/api/laboratory", &Dashboard::laboratory},
                                                      {"/api/specimen", &Dashboard::specimen},
                                                      {"/api/notes", &Dashboard::notes},
                                                      {"/api/photo", &Dashboard::photo},
                                                      {"/api/jobs", &Dashboard::jobs},
                                                      {"/api/job", &Dashboard::job},
                                                      {"/api/tray", &Dashboard::tray},
                                                      {"/api/diagnosis", &Dashboard::diagnosis},
                                                      {"/api/next", &Dashboard::next},
                                                      {"/api/maps", &Dashboard::maps},
                                                      {"/api/map", &Dashboard::map},
                                                      {"/api/between", &Dashboard::between},
                                                      {"/api/families", &Dashboard::families},
                                                      {"/report", &Dashboard::report}};
  return routes;
}

const std::map<std::string, Dashboard::Route>& Dashboard::post_routes() {
  static const std::map<std::string, Route> routes = {
      {"/api/measurement", &Dashboard::enter}, {std::string(kImportPath), &Dashboard::import_files},
      {"/api/review", &Dashboard::review},     {"/api/approval", &Dashboard::decide},
      {"/api/amendment", &Dashboard::amend},   {"/api/withdrawal", &Dashboard::withdraw},
      {"/api/simulate", &Dashboard::simulate}, {"/api/grouping", &Dashboard::group},
      {"/api/note", &Dashboard::note},         {"/api/note_removal", &Dashboard::remove_note},
      {"/api/job", &Dashboard::make_job},      {"/api/discard", &Dashboard::discard_job},
      {"/api/printed", &Dashboard::print}};
  return routes;
}

Response Dashboard::handle(const Request& request) {
  try {
    const bool is_post = request.method == "POST";
    const auto& routes = is_post ? post_routes() : get_routes();
    if (const auto route = routes.find(request.path); route != routes.end()) return (this->*route->second)(request);
    if ((is_post ? get_routes() : post_routes()).contains(request.path))
      return error_response(405, is_post ? "expected GET" : "expected POST");
    return error_response(404, "there is nothing here");
  } catch (const Refusal& refusal) {
    return error_response(refusal.status, refusal.message);
  } catch (const std::exception& error) {
    return error_response(500, error.what());
  }
}

Response Dashboard::run(const Request&) {
  const game::Scenario& s = settings_.scenario;
  return row_response(RunRow{.run = settings_.run_id,
                             .scenario = s.name,
                             .fidelity = s.fidelity,
                             .rounds = s.rounds,
                             .approval = s.validation.approval,
                             .virtual_lab = s.laboratory.virtual_lab,
                             .diagnosis = s.diagnosis.enabled,
                             .replicates = game::within_budget(s, 1).validation.replicates,
                             .started = settings_.started,
                             .nacre_version = settings_.nacre_version,
                             .commit = settings_.commit,
                             .report = std::filesystem::exists(settings_.run_folder / "report.html"),
                             .user = settings_.user});
}

ListedRunRow Dashboard::listed() {
  ListedRunRow row{.run = settings_.run_id,
                   .scenario = settings_.scenario.name,
                   .fidelity = settings_.scenario.fidelity,
                   .rounds = settings_.scenario.rounds};
  try {
    row.data = run_.version();
    enter_standing(row, *run_.record(), is_playing(desk_.nodes()));
  } catch (const std::exception& error) {
    row.problem = error.what();
  }
  return row;
}

Response Dashboard::live(const Request&) {
  const auto nodes = desk_.nodes();
  const auto search = desk_.search();
  const std::string data = fmt::format("{}/{}", run_.version(), search ? search->patterns : 0);
  return row_response(LiveRow{is_playing(nodes), data, node_rows(nodes, is_known_to_be_over(run_))});
}

Response Dashboard::rounds(const Request&) {
  const auto record = run_.record();
  const auto search = desk_.search();
  const std::lock_guard lock(rounds_mutex_);
  if (rounds_of_ != record || rounds_search_ != search) {
    rounds_ = row_response(rounds_row(*record, search)).body;
    rounds_of_ = record;
    rounds_search_ = search;
  }
  return {.body = rounds_, .headers = {}};
}

Response Dashboard::gamut(const Request& request) {
  if (const auto family = request.query.find("family"); family != request.query.end()) {
    const auto record = run_.record();
    for (const run::FamilyRecord& each : record->families)
      if (each.stated.name == family->second)
        return binary(gamut_bytes(*run_.variants(each.stated.number), each.stated.round));
    return error_response(404, "there is no such family");
  }
  const int round = round_of(request);
  const auto gamut = run_.gamut(round);
  if (!gamut->patterns.empty()) return binary(gamut_bytes(*gamut, round));
  const run::Gamut searched = desk_.searched(round);
  if (searched.patterns.empty() && !run_.record()->rounds.contains(round))
    return error_response(404, "there is no such round");
  return binary(gamut_bytes(searched, round));
}

Response Dashboard::laboratory(const Request&) {
  constexpr std::int64_t kFreshPerCost = 10;  // a growing run is read for at most a tenth of the time
  const std::lock_guard lock(desk_mutex_);
  const std::int64_t begun_us = runtime::steady_us();
  if (begun_us >= laboratory_fresh_until_us_) {
    const auto laboratory = desk_.laboratory();
    if (laboratory_of_ != laboratory) laboratory_ = row_response(laboratory_row(*laboratory)).body;
    laboratory_of_ = laboratory;
    const std::int64_t now_us = runtime::steady_us();
    laboratory_fresh_until_us_ = now_us + kFreshPerCost * (now_us - begun_us);
  }
  return {.body = laboratory_, .headers = {}};
}

Response Dashboard::next(const Request&) {
  const std::lock_guard lock(desk_mutex_);
  return row_response(next_round_row(settings_.scenario, *run_.record(), desk_.laboratory()->facts));
}

Response Dashboard::diagnosis(const Request& request) {
  return row_response(diagnosis_row(*run_.record(), round_of(request)));
}

Response Dashboard::maps(const Request&) {
  Json gamuts = Json::array();
  const auto record = run_.record();
  for (const auto& [number, round] : record->rounds)
    if (round.gamut_count > 0) gamuts.push_back(fmt::format("gamut/{}", number));
  return json_response({{"families", family_folder_.families()}, {"gamuts", gamuts}});
}

Response Dashboard::map(const Request& request) {
  const std::string id = parameter(request, "id");
  if (!id.starts_with("gamut/")) {
    const auto map = family_folder_.map(id);
    return map ? json_response({{"state", "ready"}, {"map", to_json(*map)}}) : error_response(404, map.error().message);
  }
  const int round = number(id.substr(6), "id");
  const auto gamut = run_.gamut(round);
  const std::string key = fmt::format("{}@{}", id, gamut->patterns.size());
  Background::State state = maps_.state(key);
  if (state.stage == Background::Stage::unknown) {
    maps_.ask(key, [gamut, round](const auto& progress) -> Result<std::string> {
      const auto map = map_of_gamut(*gamut, round, progress);
      if (!map) return tl::unexpected(map.error());
      return to_json(*map).dump();
    });
    state = maps_.state(key);
  }
  if (state.result) return {.body = R"({"state":"ready","map":)" + *state.result + "}", .headers = {}};
  if (state.stage == Background::Stage::failed) return error_response(404, state.problem);
  return json_response(
      {{"state", to_string(state.stage)}, {"progress", state.progress < 0.0 ? Json(nullptr) : Json(state.progress)}});
}

Response Dashboard::between(const Request& request) {
  return json_response(or_refuse(dashboard::between(parameter(request, "patterns"), parameter(request, "weights"))));
}

Response Dashboard::families(const Request&) {
  const auto record = run_.record();
  const game::FamilySettings& settings = settings_.scenario.families;
  return row_response(
      families_row(*record, family_folder_.grouping(measured_members(*record), settings.rank), settings.enabled));
}

Response Dashboard::report(const Request&) {
  const std::filesystem::path file = settings_.run_folder / "report.html";
  std::error_code unreadable;
  if (std::filesystem::symlink_status(file, unreadable).type() != std::filesystem::file_type::regular)
    return error_response(404, "There is no report yet: the analyser writes it after the first round.");
  return {.type = "text/html; charset=utf-8",
          .body = read_file_up_to(file, kMostReportBytes),
          .headers = {
              {"Content-Security-Policy", "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:"}}};
}

Response Dashboard::delivery_response(const Answer& answer, const std::vector<std::string>& doubts) {
  laboratory_fresh_until_us_ = 0;
  Json json = {{"answer", to_string(answer.delivery)}};
  if (!doubts.empty()) json["doubts"] = doubts;
  switch (answer.delivery) {
    case Delivery::accepted:
    case Delivery::repeated:
      return json_response(json);
    case Delivery::conflicting:
      json["error"] =
          "The run already has another measurement of this name, and keeps it: amend it in the table of specimens, or "
          "enter yours under a new name.";
      return json_response(json, 409);
    case Delivery::refused:
      json["error"] = answer.refusal;
      return json_response(json, 409);
    case Delivery::unanswered:
      break;
  }
  json["error"] = "Not every node has confirmed it: is the game still running? Entering it again is safe.";
  return json_response(json, 504);
}

Response Dashboard::enter(const Request& request) {
  const auto specimen = or_refuse(specimen_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  return delivery_response(desk_.enter(specimen), desk_.doubts_about(specimen));
}

Response Dashboard::import_files(const Request& request) {
  if (settings_.import_reader.command.empty()) throw Refusal{503, "this server has no reader of exports"};
  const Upload upload = or_refuse(upload_from_parts(request.parts));
  const ReadUpload read(upload, settings_.import_reader);
  const std::lock_guard lock(desk_mutex_);
  if (!upload.enter.empty()) laboratory_fresh_until_us_ = 0;
  return import_response(upload, read, desk_);
}

Response Dashboard::review(const Request& request) {
  const auto review = or_refuse(specimen_review_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  if (const auto reason = desk_.against(review)) return conflict_response(*reason);
  return delivery_response(desk_.review(review));
}

Response Dashboard::decide(const Request& request) {
  const auto approval = or_refuse(approval_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  if (const auto reason = desk_.against(approval)) return conflict_response(*reason);
  return delivery_response(desk_.decide(approval));
}

Response Dashboard::amend(const Request& request) {
  const auto amendment = or_refuse(amendment_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  const auto specimen = or_refuse(desk_.amended(amendment));
  return delivery_response(desk_.amend(specimen, amendment.by, amendment.why), desk_.doubts_about(specimen));
}

Response Dashboard::withdraw(const Request& request) {
  const auto withdrawal = or_refuse(withdrawal_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  if (const auto reason = desk_.against(withdrawal)) return conflict_response(*reason);
  return delivery_response(desk_.withdraw(withdrawal));
}

Response Dashboard::group(const Request& request) {
  const auto grouping = or_refuse(grouping_from_json(request.body));
  const auto measured = measured_members(*run_.record());
  for (const families::SeedFamily& family : grouping)
    for (const pattern::Pattern& seed : family.seeds)
      if (std::ranges::count(measured, seed, &families::MeasuredPattern::pattern) == 0)
        throw Refusal{400, fmt::format("{}: seed {} is not measured in both tests yet", family.name, seed.key())};
  const std::lock_guard lock(desk_mutex_);
  desk_.keep_grouping(family_folder_.path(), grouping);
  return delivery_response({});
}

std::string_view to_string(Delivery delivery) {
  switch (delivery) {
    case Delivery::accepted:
      return "accepted";
    case Delivery::repeated:
      return "repeated";
    case Delivery::conflicting:
      return "conflicting";
    case Delivery::refused:
      return "refused";
    case Delivery::unanswered:
      break;
  }
  return "unanswered";
}

}  // namespace nacre::dashboard
