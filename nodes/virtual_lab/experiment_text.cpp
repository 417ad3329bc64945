#include "virtual_lab/experiment_text.hpp"

#include <nlohmann/json.hpp>

namespace nacre::virtual_lab {

using nlohmann::json;

std::string to_spec(const Experiment& experiment) {
  json fields{{"design", experiment.design.name()},
              {"test", tester::to_string(experiment.test)},
              {"fidelity", tester::to_string(experiment.fidelity)},
              {"orientation_deg", experiment.conditions.orientation_deg},
              {"strain_rate_per_s", experiment.conditions.strain_rate_per_s},
              {"thickness_mm", experiment.conditions.thickness_mm},
              {"loading", tester::to_string(experiment.loading)}};
  if (experiment.specimens > 0) fields["specimens"] = experiment.specimens;
  return fields.dump();
}

Result<Experiment> experiment_from_spec(std::string_view spec) try {
  const json fields = json::parse(spec);
  const auto design = pattern::design_from_name(fields.at("design").get<std::string>());
  if (!design) return tl::unexpected(design.error());
  const auto test = tester::test_kind_from_string(fields.at("test").get<std::string>());
  if (!test) return tl::unexpected(test.error());
  const auto fidelity = tester::fidelity_from_string(fields.at("fidelity").get<std::string>());
  if (!fidelity) return tl::unexpected(fidelity.error());
  const auto loading = tester::loading_from_string(fields.at("loading").get<std::string>());
  if (!loading) return tl::unexpected(loading.error());
  return Experiment{.design = *design,
                    .test = *test,
                    .conditions = {.orientation_deg = fields.at("orientation_deg").get<double>(),
                                   .strain_rate_per_s = fields.at("strain_rate_per_s").get<double>(),
                                   .thickness_mm = fields.at("thickness_mm").get<double>()},
                    .fidelity = *fidelity,
                    .loading = *loading,
                    .specimens = fields.value("specimens", 0)};
} catch (const json::exception& error) {
  return fail("experiment of the virtual laboratory: {}", error.what());
}

std::string to_text(const Result<TrueResponse>& response) {
  if (!response) return json{{"failure", response.error().message}}.dump();
  json fields{{"modulus_pa", response->modulus_pa},
              {"strain", response->curve.strain},
              {"stress_pa", response->curve.stress_pa},
              {"remark", response->remark}};
  for (const tester::Curve& curve : response->other_curves)
    fields["others"].push_back({{"strain", curve.strain}, {"stress_pa", curve.stress_pa}});
  return fields.dump();
}

Result<TrueResponse> response_from_text(std::string_view text) try {
  const json fields = json::parse(text);
  if (fields.contains("failure")) return fail("{}", fields["failure"].get<std::string>());
  TrueResponse response;
  response.modulus_pa = fields.at("modulus_pa").get<double>();
  response.curve.strain = fields.at("strain").get<std::vector<double>>();
  response.curve.stress_pa = fields.at("stress_pa").get<std::vector<double>>();
  response.remark = fields.at("remark").get<std::string>();
  if (fields.contains("others"))
    for (const json& other : fields["others"])
      response.other_curves.push_back({.strain = other.at("strain").get<std::vector<double>>(),
                                       .stress_pa = other.at("stress_pa").get<std::vector<double>>()});
  if (response.curve.strain.size() != response.curve.stress_pa.size())
    return fail("response of the virtual laboratory: lengths differ");
  return response;
} catch (const json::exception& error) {
  return fail("response of the virtual laboratory: {}", error.what());
}

}  // namespace nacre::virtual_lab
