// Part of the dashboard of one run: its designs, simulated on demand.

#include "dashboard/dashboard.hpp"
#include "dashboard/design_check.hpp"
#include "dashboard/design_view.hpp"
#include "dashboard/entries.hpp"
#include "dashboard/mechanisms_view.hpp"
#include "dashboard/request_parts.hpp"
#include "game/starting_point.hpp"

namespace nacre::dashboard {
namespace {

pattern::Design design_of(const Request& request) {
  const auto design = pattern::design_from_word(parameter(request, "design"));
  if (!design) throw Refusal{400, "design: " + design.error().message};
  return *design;
}

/// `model`: the number of a round or the name of a family.
std::string model_of(const Request& request) {
  const std::string model = parameter(request, "model");
  if (!is_model_name(model))
    throw Refusal{400, fmt::format("model: `{}`, expected the number of a round or the name of a family", model)};
  return model;
}

/// The model before anything was fitted: what breaks while the first search has only begun.
constexpr std::string_view kStart = "start";

/// One more while it lives.
struct Counted {
  explicit Counted(std::atomic<int>& counter) : all(counter), others(counter++) {}
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() { --all; }
  std::atomic<int>& all;
  int others;
};

bool is_round(const std::string& model) { return model.find_first_not_of("0123456789") == std::string::npos; }

}  // namespace

Response Dashboard::design(const Request& request) {
  return row_response(design_row(*run_.record(), design_of(request)));
}

Dashboard::FractureRequest Dashboard::fracture_request(const Request& request, const pattern::Design& design,
                                                       const std::string& model) {
  const auto map = request.query.find("map");
  return {design, model, map != request.query.end() && map->second.starts_with(model + "/")};
}

Dashboard::FractureRequest Dashboard::fracture_request(const Request& request) {
  return fracture_request(request, design_of(request), model_of(request));
}

std::optional<material::ParameterSet> Dashboard::model_of_game(const std::string& model) {
  const auto record = run_.record();
  for (const run::FamilyRecord& family : record->families)
    if (family.stated.name == model) return family.stated.parameters;
  if (!is_round(model)) return std::nullopt;
  const auto round = record->rounds.find(number(model, "model"));
  if (round == record->rounds.end() || !round->second.model) return std::nullopt;
  return round->second.model->parameters;
}

Result<material::ParameterSet> Dashboard::parameters_of(const FractureRequest& fracture) {
  if (fracture.model == kStart) return game::starting_model(settings_.scenario).parameters;
  if (!fracture.is_of_folder)
    if (const auto parameters = model_of_game(fracture.model)) return *parameters;
  if (is_round(fracture.model)) return fail("round {} has no model yet", fracture.model);
  return family_folder_.model(fracture.model);  // of a family grouped otherwise the folder alone knows
}

bool Dashboard::is_by_game(const FractureRequest& fracture) {
  if (!fracture.is_of_folder) return true;
  const auto of_folder = family_folder_.model(fracture.model);
  return of_folder && model_of_game(fracture.model) == *of_folder;  // `nacre families` takes models from the stage
}

Background::State Dashboard::made(const FractureRequest& fracture) {
  const auto parameters = parameters_of(fracture);
  return parameters ? films_.made(fracture.design, *parameters) : Background::State{};
}

Json Dashboard::simulation_state(const FractureRequest& fracture) {
  if (films_.name_in_run(*run_.record(), fracture.design.name(), fracture.model) && is_by_game(fracture))
    return {{"state", "ready"}, {"source", "run"}};
  const Background::State state = made(fracture);
  Json json = {{"state", to_string(state.stage)}, {"source", "here"}, {"working_s", state.working_s}};
  if (state.result) json["modulus_pa"] = json_or_null(unpacked(*state.result).modulus_pa);
  if (!state.problem.empty()) json["problem"] = state.problem;
  return json;
}

Response Dashboard::simulation(const Request& request) {
  return json_response(simulation_state(fracture_request(request)));
}

Response Dashboard::film(const Request& request) {
  const FractureRequest fracture = fracture_request(request);
  auto film = films_.of_run(*run_.record(), fracture.design.name(), fracture.model);
  if (film && is_by_game(fracture)) return binary(*std::move(film));
  const Background::State state = made(fracture);
  if (!state.result) return error_response(404, "there is no film of this design yet");
  return binary(std::string(unpacked(*state.result).film));
}

Response Dashboard::check(const Request& request) {
  constexpr int kMostAsked = 8;  // each waits milliseconds for those before it
  const FractureRequest asked = fracture_request(request);
  const auto parameters = parameters_of(asked);
  if (!parameters) return error_response(409, parameters.error().message);
  const Counted asking(moduli_asked_);
  if (asking.others >= kMostAsked) return error_response(503, "too many moduli are asked for: try again in a moment");
  const std::lock_guard turn(modulus_mutex_);
  return row_response(checked(asked.design, *parameters, settings_.scenario.fidelity));
}

Response Dashboard::mechanisms(const Request&) {
  return row_response(mechanisms_row(*run_.record(), settings_.scenario.fidelity));
}

Response Dashboard::simulate(const Request& request) {
  const SimulationRequest wanted = or_refuse(simulation_request_from_json(request.body));
  const FractureRequest fracture = fracture_request(request, wanted.design, wanted.model);
  const auto parameters = parameters_of(fracture);
  if (!parameters) return error_response(409, parameters.error().message);
  if (!films_.make(wanted.design, *parameters))
    return error_response(503, "too many simulations are waiting: try again in a minute");
  return json_response(simulation_state(fracture), 202);
}

}  // namespace nacre::dashboard
