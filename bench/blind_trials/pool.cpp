#include "pool.hpp"

#include <fstream>
#include <map>
#include <mutex>

#include <nlohmann/json.hpp>

#include "base/parallel.hpp"

namespace nacre::blind_trials {
namespace {

namespace lab = laboratory;
using nlohmann::json;

json json_of(const tester::Curve& curve) { return {curve.strain, curve.stress_pa}; }

tester::Curve curve_from(const json& pair) {
  tester::Curve curve;
  curve.strain = pair.at(0).get<std::vector<double>>();
  curve.stress_pa = pair.at(1).get<std::vector<double>>();
  return curve;
}

json json_of(const Result<lab::TrueResponse>& response) {
  if (!response) return {{"error", response.error().message}};
  json others = json::array();
  for (const tester::Curve& curve : response->other_curves) others.push_back(json_of(curve));
  return {{"modulus_pa", response->modulus_pa},
          {"curve", json_of(response->curve)},
          {"others", std::move(others)},
          {"remark", response->remark}};
}

Result<lab::TrueResponse> response_from(const json& line) {
  if (line.contains("error")) return fail("{}", line["error"].get<std::string>());
  lab::TrueResponse response{.modulus_pa = line.at("modulus_pa"),
                             .curve = curve_from(line.at("curve")),
                             .remark = line.at("remark"),
                             .other_curves = {}};
  for (const json& curve : line.at("others")) response.other_curves.push_back(curve_from(curve));
  return response;
}

/// By number of the experiment. A last line that was cut off by an interruption does not count.
std::map<std::size_t, Result<lab::TrueResponse>> kept_in(const std::filesystem::path& file) {
  std::map<std::size_t, Result<lab::TrueResponse>> kept;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const json read = json::parse(line, nullptr, false);
    if (!read.is_discarded()) kept.emplace(read.at("experiment").get<std::size_t>(), response_from(read));
  }
  return kept;
}

}  // namespace

std::vector<Result<lab::TrueResponse>> pooled_responses(const lab::Truth& truth,
                                                        const std::vector<lab::Experiment>& experiments,
                                                        const std::filesystem::path& file) {
  std::map<std::size_t, Result<lab::TrueResponse>> known = kept_in(file);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream kept(file, std::ios::app);
  if (kept.tellp() > 0) kept << "\n";  // whatever an interruption left
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < experiments.size(); ++i)
    if (!known.contains(i)) missing.push_back(i);
  std::mutex one_at_a_time;
  parallel_for(static_cast<int>(missing.size()), [&](int k) {
    const std::size_t i = missing[k];
    Result<lab::TrueResponse> response = lab::respond(truth, experiments[i]);
    json line = json_of(response);
    line["experiment"] = i;
    const std::lock_guard lock(one_at_a_time);
    kept << line.dump() << "\n" << std::flush;
    known.emplace(i, std::move(response));
  });
  if (!kept) throw InputError::format("{}: the pool of specimens cannot be written", file.string());
  std::vector<Result<lab::TrueResponse>> responses;
  for (std::size_t i = 0; i < experiments.size(); ++i) responses.push_back(known.at(i));
  return responses;
}

}  // namespace nacre::blind_trials
