#include "family_mechanisms.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "families/evidence.hpp"
#include "progress.hpp"

namespace nacre::cli {

std::vector<CrackedPattern> broken(const std::string& task, const std::vector<pattern::Pattern>& members, int count,
                                   const material::ParameterSet& parameters, tester::Fidelity fidelity,
                                   const Performances& performances) {
  const int wanted = std::min(count, static_cast<int>(members.size()));
  std::vector<std::optional<CrackedPattern>> found(wanted);
  Progress progress(task, wanted);
  parallel_for(wanted, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    const auto known = performances.find(members[index]);
    const tester::Simulation simulation{members[index], parameters, {}, fidelity};
    const auto result = tester::test_toughness(simulation);
    if (result && known != performances.end())
      found[index] = {members[index], known->second.modulus_pa, result->toughness_pa,
                      crack::mechanisms_of(simulation, crack::record_of(simulation, result->breaks))};
    progress.advance();
  });
  std::vector<CrackedPattern> all;
  for (const std::optional<CrackedPattern>& each : found)
    if (each) all.push_back(*each);
  return all;
}

nlohmann::ordered_json mechanisms_of_family(const std::vector<CrackedPattern>& cracked,
                                            const std::filesystem::path& file, std::uint64_t seed) {
  std::string text = "pattern,rigid_fraction,modulus_pa,toughness_pa";
  std::vector<families::FeatureColumn> features, controls = {{"rigid_fraction", {}}, {"modulus_pa", {}}};
  families::FeatureColumn outcome{"toughness_pa", {}};
  for (const crack::Mechanism& mechanism : crack::mechanism_names()) {
    text += fmt::format(",{}", mechanism.name);
    features.push_back({std::string(mechanism.name), {}});
  }
  for (const CrackedPattern& each : cracked) {
    text += fmt::format("\n{},{:.4f},{:.6g},{:.6g}", each.pattern.key(), each.pattern.rigid_fraction(), each.modulus_pa,
                        each.toughness_pa);
    controls[0].values.push_back(each.pattern.rigid_fraction());
    controls[1].values.push_back(each.modulus_pa);
    outcome.values.push_back(each.toughness_pa);
    const auto values = crack::values_of(each.mechanisms);
    for (std::size_t k = 0; k < values.size(); ++k) {
      text += fmt::format(",{:.5g}", values[k]);
      features[k].values.push_back(values[k]);
    }
  }
  write_file_atomically(file, text + "\n");
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  if (cracked.size() < 20) return document;  // nothing could be said
  for (const families::Association& each : families::associations(features, outcome, controls, seed))
    document.push_back({{"mechanism", each.feature},
                        {"patterns", cracked.size()},
                        {"spearman_with_toughness", each.spearman},
                        {"partial", each.partial},
                        {"p_family_wise", each.p_family_wise}});
  return document;
}

}  // namespace nacre::cli
