#include "stand_ins.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.hpp"
#include "base/random.hpp"
#include "game/model.hpp"
#include "material/extensions.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "simulator_farm/farm_core.hpp"
#include "sysid/objective.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::game_test {
namespace {

struct Shares {
  double soft = 0.0, rigid = 0.0, interface = 0.0;
};

Shares shares_of(const pattern::Design& design) {
  if (const auto* mixture = design.mixture()) {
    const double r = mixture->rigid_fraction;
    return {std::max(0.0, 1.0 - 2.0 * r), std::max(0.0, 2.0 * r - 1.0), 1.0 - std::abs(2.0 * r - 1.0)};
  }
  const pattern::Layout& layout = *design.layout();
  int unlike = 0;
  for (int row = 0; row < pattern::kSide; ++row) {
    for (int column = 0; column < pattern::kSide; ++column) {
      const bool here = layout.rigid(row, column);
      unlike += here != layout.rigid((row + 1) % pattern::kSide, column);
      unlike += here != layout.rigid(row, (column + 1) % pattern::kSide);
    }
  }
  const double interface = unlike / 800.0;
  return {(1.0 - layout.rigid_fraction()) * (1.0 - interface), layout.rigid_fraction() * (1.0 - interface), interface};
}

double geometric_mean(const Shares& shares, double soft, double rigid, double interface) {
  return std::exp(shares.soft * std::log(soft) + shares.rigid * std::log(rigid) +
                  shares.interface * std::log(interface));
}

tester::Curve triangle(double toughness_pa, double peak_stress_pa, int points) {
  const double strain = 2.0 * toughness_pa / peak_stress_pa;
  tester::Curve curve;
  for (int point = 0; point < points; ++point) {
    const double share = static_cast<double>(point) / (points - 1);
    curve.strain.push_back(share * strain);
    curve.stress_pa.push_back(share * peak_stress_pa);
  }
  return curve;
}

// A core made of a function of messages on one channel.
class Responder : public runtime::NodeCore {
 public:
  Responder(std::string channel, std::function<std::vector<runtime::Message>(const std::string&)> respond)
      : channel_(std::move(channel)), respond_(std::move(respond)) {}
  runtime::Outputs step(const runtime::Input& input) override {
    runtime::Outputs outputs;
    const auto* message = std::get_if<runtime::Message>(&input);
    if (message != nullptr && message->channel == channel_) outputs.messages = respond_(message->payload);
    return outputs;
  }
  runtime::Status status() const override { return {}; }

 private:
  std::string channel_;
  std::function<std::vector<runtime::Message>(const std::string&)> respond_;
};

tester::Simulation truth_of(const wire::TestOrder& order, const LaboratorySettings& settings) {
  tester::Simulation simulation{order.design, material::default_parameters(), order.conditions, order.fidelity};
  simulation.parameters.extensions =
      game::material_side({.modulus = {}, .toughness = {}, .extensions = settings.hidden}).extensions;
  for (double* modulus_pa : {&simulation.parameters.modulus.e_tb_pa, &simulation.parameters.modulus.e_vw_pa,
                             &simulation.parameters.modulus.e_if_pa}) {
    *modulus_pa *= settings.modulus_factor;
  }
  auto& eta = simulation.parameters.toughness;
  for (double* threshold : {&eta.w_tb_j_per_m3, &eta.w_vw_j_per_m3, &eta.w_if_j_per_m3})
    *threshold *= settings.toughness_factor;
  return simulation;
}

wire::SimulatedDesign true_response(const wire::TestOrder& order, const LaboratorySettings& settings) {
  const tester::Simulation truth = truth_of(order, settings);
  const bool modulus = order.test == tester::TestKind::modulus;
  if (!settings.real_testers) return closed_form(truth, modulus, !modulus, 32);
  wire::SimulatedDesign response;
  response.design = order.design;
  if (modulus) {
    response.modulus_pa = tester::test_modulus(truth).value().modulus_pa;
  } else {
    const auto result = tester::test_toughness(truth).value();
    response.toughness_pa = result.toughness_pa;
    response.curve = tester::resampled(result.curve, 32);
  }
  return response;
}

}  // namespace

wire::SimulatedDesign closed_form(const tester::Simulation& simulation, bool modulus, bool toughness,
                                  int curve_points) {
  const Shares shares = shares_of(simulation.design);
  const material::ModulusParameters& theta = simulation.parameters.modulus;
  const material::ToughnessParameters& eta = simulation.parameters.toughness;
  const double turned = simulation.conditions.orientation_deg == 90.0 ? -1.0 : 1.0;
  const double anisotropy = material::extension_value(simulation.parameters.extensions, "interface_anisotropy");
  const double mixing = material::extension_value(simulation.parameters.extensions, "droplet_mixing");
  const double mixed =
      simulation.design.layout() && content_hash64(simulation.design.name()) % 2 == 1 ? mixing : -mixing;
  wire::SimulatedDesign response;
  response.design = simulation.design;
  if (modulus) {
    response.modulus_pa = geometric_mean(shares, theta.e_tb_pa, theta.e_vw_pa, theta.e_if_pa) *
                          (1.0 + turned * anisotropy * shares.interface) * std::exp(mixed);
  }
  if (toughness) {
    response.toughness_pa =
        geometric_mean(shares, eta.w_tb_j_per_m3, eta.w_vw_j_per_m3, eta.w_if_j_per_m3) * (1.0 + shares.interface);
    const double young_pa = geometric_mean(shares, eta.e_tb_pa, eta.e_vw_pa, eta.e_if_pa);
    response.peak_stress_pa = std::sqrt(young_pa * response.toughness_pa);
    response.failure_strain = 2.0 * response.toughness_pa / response.peak_stress_pa;
    if (curve_points > 1) response.curve = triangle(response.toughness_pa, response.peak_stress_pa, curve_points);
  }
  return response;
}

std::map<std::string, runtime::WorkFunction> closed_form_work(std::set<std::string> failing) {
  return {{"simulate", [failing = std::move(failing)](const std::string& spec) {
             const auto test_request = wire::read<wire::SimulateRequest>(spec).value();
             const pattern::Design& design = test_request.designs.front();
             wire::SimulatedDesign response =
                 closed_form({design, test_request.parameters, test_request.conditions, test_request.fidelity},
                             test_request.modulus, test_request.toughness, test_request.curve_points);
             if (failing.contains(design.name())) {
               response = {};
               response.design = design;
               response.failure = "made to fail";
             }
             return wire::write(wire::SimulateResult{
                 .request_id = test_request.request_id, .chunk = 0, .chunks = 1, .first = 0, .results = {response}});
           }}};
}

std::vector<wire::Measurement> measure(const wire::TestOrder& order, const LaboratorySettings& settings) {
  const wire::SimulatedDesign response = true_response(order, settings);
  const bool pulled = order.test == tester::TestKind::modulus;
  const sysid::Prediction truth =
      sysid::observed({.modulus_pa = pulled ? std::optional(response.modulus_pa) : std::nullopt,
                       .toughness_pa = pulled ? std::nullopt : std::optional(response.toughness_pa),
                       .curve = response.curve},
                      settings.hidden);
  std::vector<wire::Measurement> measurements;
  for (int replicate = 1; replicate <= order.replicates; ++replicate) {
    wire::Measurement measured;
    measured.round = order.round;
    measured.order_id = order.order_id;
    measured.fidelity = order.fidelity;
    measurement::SpecimenRecord& record = measured.record;
    record.specimen = order.order_id + "#" + std::to_string(replicate);
    record.design = order.design;
    record.test = order.test;
    record.conditions = order.conditions;
    record.batch = order.batch;
    RandomStream noise(content_hash64(record.specimen), "noise");
    if (order.test == tester::TestKind::modulus) {
      record.modulus_pa = *truth.modulus_pa * (1.0 + settings.modulus_noise * noise.normal());
    } else {
      const double factor = std::max(0.1, 1.0 + settings.toughness_noise * noise.normal());
      record.toughness_pa = *truth.toughness_pa * factor;
      record.curve = truth.curve;
      for (double& stress_pa : record.curve.stress_pa) stress_pa *= factor;
    }
    if (settings.spoil) settings.spoil(measured);
    measurements.push_back(std::move(measured));
  }
  return measurements;
}

std::unique_ptr<runtime::NodeCore> make_laboratory(const LaboratorySettings& settings) {
  return std::make_unique<Responder>("TEST_ORDER", [settings](const std::string& payload) {
    std::vector<runtime::Message> messages;
    for (const wire::Measurement& measured : measure(wire::read<wire::TestOrder>(payload).value(), settings)) {
      messages.push_back({"MEASUREMENT", wire::write(measured)});
    }
    return messages;
  });
}

std::unique_ptr<runtime::NodeCore> make_analyser(std::function<wire::Diagnosis(int)> diagnosis) {
  return std::make_unique<Responder>("DIAGNOSE", [diagnosis = std::move(diagnosis)](const std::string& payload) {
    const int round = wire::read<wire::DiagnoseRequest>(payload).value().round;
    wire::Diagnosis response;
    if (diagnosis) {
      response = diagnosis(round);
    } else {
      response.verdict = "base_sufficient";
    }
    response.round = round;
    return std::vector<runtime::Message>{{"DIAGNOSIS", wire::write(response)}};
  });
}

game::Scenario small_scenario() {
  game::Scenario scenario;
  scenario.name = "in process";
  scenario.seed = 3;
  scenario.rounds = 2;
  scenario.fidelity = tester::Fidelity::tiny;
  scenario.stop_at_equilibrium = false;
  scenario.base_materials_file = std::string(NACRE_SOURCE_DIR) + "/data/thesis/base_materials.csv";
  scenario.discretisation_floor_file = std::string(NACRE_SOURCE_DIR) + "/data/discretisation_floor.toml";
  scenario.proposal.samples = 60;
  scenario.proposal.seeds = 2;
  scenario.proposal.population = 10;
  scenario.proposal.designs = 3;
  scenario.validation.random_patterns = 4;
  scenario.validation.replicates = 3;
  scenario.validation.calibration_evaluations = 8;
  scenario.validation.modulus_evaluations = 20;
  scenario.validation.mixtures = {0.5, 0.75};
  scenario.diagnosis.discrimination_orders = 2;
  return scenario;
}

game::Scenario unfitted_scenario() {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 6;
  scenario.validation.calibration_evaluations = scenario.validation.modulus_evaluations = 0;
  scenario.diagnosis.enabled = false;
  return scenario;
}

void add_players(InProcessGame& game, const game::Scenario& scenario, const LaboratorySettings& laboratory,
                 std::function<wire::Diagnosis(int)> diagnosis, std::set<std::string> failing) {
  game.add("simulator_farm", simulator_farm::make_core(scenario), closed_form_work(std::move(failing)));
  game.add("proposal_agent", proposal_agent::make_core(scenario), proposal_agent::work_functions());
  game.add("validation_agent", validation_agent::make_core(scenario), validation_agent::work_functions({}));
  if (scenario.laboratory.virtual_lab) game.add("virtual_lab", make_laboratory(laboratory));
  game.add("analyser", make_analyser(std::move(diagnosis)));
}

}  // namespace nacre::game_test
