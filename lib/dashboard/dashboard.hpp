#pragma once
// The dashboard of one run: requests in, responses out. The routes are listed in docs/FORMATS.md.

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "dashboard/background.hpp"
#include "dashboard/desk.hpp"
#include "dashboard/films.hpp"
#include "dashboard/http.hpp"
#include "dashboard/import_reader.hpp"
#include "dashboard/maps.hpp"
#include "dashboard/notes.hpp"
#include "dashboard/print_jobs.hpp"
#include "dashboard/runs_view.hpp"
#include "game/scenario.hpp"
#include "run/run.hpp"

namespace nacre::dashboard {

struct DashboardSettings {
  std::filesystem::path run_folder;
  std::filesystem::path family_folder;  ///< of `nacre families`; need not exist
  std::string run_id, started, nacre_version, commit;
  std::string user;  ///< who enters things, unless the page says otherwise
  game::Scenario scenario;
  ImportReader import_reader = {};
};

/// Responds to requests from any number of threads.
class Dashboard {
 public:
  /// `desk` must outlive it.
  Dashboard(DashboardSettings settings, Desk& desk);
  /// Never throws: what is wrong comes back as a status with `{"error": ...}`.
  Response handle(const Request& request);
  /// The run in a list of runs; never throws.
  ListedRunRow listed();

 private:
  using Route = Response (Dashboard::*)(const Request&);
  static const std::map<std::string, Route>& get_routes();
  static const std::map<std::string, Route>& post_routes();

  Response run(const Request&);
  Response live(const Request&);
  Response rounds(const Request&);
  Response gamut(const Request&);
  Response design(const Request&);
  Response film(const Request&);
  Response check(const Request&);
  Response mechanisms(const Request&);
  Response simulation(const Request&);
  Response laboratory(const Request&);
  Response specimen(const Request&);
  Response notes(const Request&);
  Response photo(const Request&);
  Response jobs(const Request&);
  Response job(const Request&);
  Response tray(const Request&);
  Response diagnosis(const Request&);
  Response next(const Request&);
  Response maps(const Request&);
  Response map(const Request&);
  Response between(const Request&);
  Response families(const Request&);
  Response report(const Request&);
  Response enter(const Request&);
  Response import_files(const Request&);
  Response review(const Request&);
  Response decide(const Request&);
  Response amend(const Request&);
  Response withdraw(const Request&);
  Response simulate(const Request&);
  Response group(const Request&);
  Response note(const Request&);
  Response remove_note(const Request&);
  Response make_job(const Request&);
  Response discard_job(const Request&);
  Response print(const Request&);

  /// A design whose fracture is asked for, and with which model: the number of a round or the name of a family.
  struct FractureRequest {
    pattern::Design design;
    std::string model;
    bool is_of_folder = false;  ///< the model of `nacre families`, not that of the game's family stage
  };
  /// The query may say `map`, FAMILY/SEED: the map of the folder that the design was picked on.
  static FractureRequest fracture_request(const Request& request, const pattern::Design& design,
                                          const std::string& model);
  static FractureRequest fracture_request(const Request& request);
  /// The folder of the print job that the query names.
  std::filesystem::path job_folder(const Request& request) const;
  /// The error says which model is missing.
  Result<material::ParameterSet> parameters_of(const FractureRequest& fracture);
  std::optional<material::ParameterSet> model_of_game(const std::string& model);
  /// Whether the film that the game keeps under this model's name was made with the model that is meant.
  bool is_by_game(const FractureRequest& fracture);
  Background::State made(const FractureRequest& fracture);
  Json simulation_state(const FractureRequest& fracture);
  Response delivery_response(const Answer& answer, const std::vector<std::string>& doubts = {});

  DashboardSettings settings_;
  Desk& desk_;
  std::mutex desk_mutex_;                            ///< the desk serves one request at a time
  std::shared_ptr<const Laboratory> laboratory_of_;  ///< what `laboratory_` was made of
  std::string laboratory_;                           ///< JSON; of 10,000 specimens it takes a second
  std::int64_t laboratory_fresh_until_us_ = 0;
  run::Run run_;
  std::mutex rounds_mutex_;
  std::shared_ptr<const run::RunRecord> rounds_of_;  ///< the record that `rounds_` was made of
  std::optional<LiveSearch::Progress> rounds_search_;
  std::string rounds_;  ///< JSON; of 10,000 specimens it takes a while
  FamilyFolder family_folder_;
  NoteFolder note_folder_;
  PrintJobs print_jobs_;
  std::mutex modulus_mutex_;  ///< one modulus at a time, however many ask
  std::atomic<int> moduli_asked_ = 0;
  Films films_;
  Background maps_;
};

}  // namespace nacre::dashboard
