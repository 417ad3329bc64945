#include "proposal_agent/realisations.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "optimize/pareto.hpp"
#include "proposal_agent/branch.hpp"
#include "tester/specimen_numbers.hpp"
#include "tester/strength_field.hpp"
#include "thesis/constants.hpp"

namespace nacre::proposal_agent {
namespace {

// About what a calibration leaves open. Smaller perturbations seldom change a crack's path, larger ones gain no more
// (docs/decisions/0014).
constexpr double kPerturbation = 0.2;

}  // namespace

Realisations::Realisations(std::vector<explore::Evaluated> gamut, const std::vector<pattern::Pattern>& chosen,
                           int count, std::uint64_t seed, std::string request_prefix)
    : gamut_(std::move(gamut)),
      chosen_(chosen.begin(), chosen.end()),
      count_(count),
      seed_(seed),
      prefix_(std::move(request_prefix)) {}

/// The front of all, and the first ranks of those that can be selected.
std::vector<pattern::Pattern> Realisations::candidates() const {
  std::set<pattern::Pattern> best;
  const auto add_ranks = [&](bool with_chosen, int last_rank) {
    std::vector<const explore::Evaluated*> samples;
    std::vector<optimize::Performance> performances;
    for (const explore::Evaluated& sample : gamut_) {
      if (!with_chosen && chosen_.contains(sample.pattern)) continue;
      samples.push_back(&sample);
      performances.push_back(sample.performance);
    }
    const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (ranks[i] <= last_rank) best.insert(samples[i]->pattern);
    }
  };
  add_ranks(true, 1);
  add_ranks(false, thesis::kBoundaryRanks);
  return {best.begin(), best.end()};
}

std::vector<explore::Evaluated> Realisations::best() const {
  const std::vector<pattern::Pattern> patterns = candidates();  // sorted
  std::vector<explore::Evaluated> samples;
  std::ranges::copy_if(gamut_, std::back_inserter(samples), [&](const explore::Evaluated& sample) {
    return std::ranges::binary_search(patterns, sample.pattern);
  });
  return samples;
}

std::vector<wire::SimulateRequest> Realisations::next(const wire::SimulateRequest& model) {
  std::vector<pattern::Pattern> wanted = count_ > 0 ? candidates() : std::vector<pattern::Pattern>();
  std::erase_if(wanted, [&](const pattern::Pattern& pattern) { return realised_.contains(pattern); });
  ++step_;
  are_specimens_ = tester::specimens_differ(model.parameters);
  simulated_ += count_ * static_cast<int>(wanted.size());
  realised_.insert(wanted.begin(), wanted.end());
  return wanted.empty() ? std::vector<wire::SimulateRequest>() : requests_of(wanted, model);
}

std::vector<wire::SimulateRequest> Realisations::requests_of(const std::vector<pattern::Pattern>& wanted,
                                                             const wire::SimulateRequest& model) {
  std::vector<wire::SimulateRequest> requests;
  for (int number = 0; number < (are_specimens_ ? 1 : count_); ++number) {
    wire::SimulateRequest again = model;
    again.modulus = false;
    if (are_specimens_) {
      again.first_specimen = tester::kFirstSelectionSpecimen;
      again.specimens = count_;
    } else {
      // The same perturbed parameters for every design and round: designs are compared like with like.
      RandomStream random(seed_, fmt::format("redraw {}", number));
      again.parameters.toughness = material::perturbed(model.parameters.toughness, kPerturbation, random);
    }
    for (wire::SimulateRequest& request :
         requests_for_patterns(wanted, again, fmt::format("{}/redraw{}/d{}", prefix_, step_, number))) {
      open_.emplace(request.request_id, number);
      requests.push_back(std::move(request));
    }
  }
  return requests;
}

bool Realisations::take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response) {
  const auto request = open_.find(request_id);
  for (const wire::SimulatedDesign& each : response) {
    if (each.failure.empty()) log_toughness_[each.design.name()][request->second] = std::log(each.toughness_pa);
  }
  open_.erase(request);
  if (open_.empty()) settle();
  return open_.empty();
}

void Realisations::settle() {
  for (explore::Evaluated& sample : gamut_) {
    const auto further = log_toughness_.find(sample.pattern.key());
    if (further == log_toughness_.end()) continue;
    if (are_specimens_) {
      sample.performance.toughness_pa = std::exp(further->second.at(0));
      continue;
    }
    double sum = std::log(sample.performance.toughness_pa);  // in order of number, whatever came first
    for (const auto& [number, log_toughness] : further->second) sum += log_toughness;
    sample.performance.toughness_pa = std::exp(sum / (1.0 + static_cast<double>(further->second.size())));
  }
  log_toughness_.clear();
}

}  // namespace nacre::proposal_agent
