#pragma once
// Toughness without the winner's curse. The best of N samples are those whose one simulation came out high. Whatever
// may be selected is therefore simulated again (re-evaluation of elites in noisy optimisation): where specimens differ,
// its T is the mean over further specimens, which did not choose it; else it is the geometric mean over simulations
// with parameters perturbed within their uncertainty (realisations, docs/decisions/0014).

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "wire/convert.hpp"

namespace nacre::proposal_agent {

class Realisations {
 public:
  /// @param gamut   what the searches found
  /// @param chosen  patterns that cannot be selected any more; they are simulated again only on the front itself
  /// @param count   realisations of a candidate; 0: none, and next() asks for nothing
  Realisations(std::vector<explore::Evaluated> gamut, const std::vector<pattern::Pattern>& chosen, int count,
               std::uint64_t seed, std::string request_prefix);

  /// Requests for the candidates (first ranks, thesis 2.3.4) whose T is that of one simulation; empty when there are
  /// none left. As means fall below the best of N, other candidates take their places.
  std::vector<wire::SimulateRequest> next(const wire::SimulateRequest& model);
  bool waits_for(const std::string& request_id) const { return open_.contains(request_id); }
  /// Takes the response to one of the requests. Returns whether all have come (then ask for next()).
  bool take(const std::string& request_id, const std::vector<wire::SimulatedDesign>& response);

  /// The gamut with the means known so far.
  const std::vector<explore::Evaluated>& gamut() const { return gamut_; }
  /// Those of them that decide: the front of all, and the first ranks of what can be selected.
  std::vector<explore::Evaluated> best() const;
  int simulated() const { return simulated_; }

 private:
  std::vector<pattern::Pattern> candidates() const;
  std::vector<wire::SimulateRequest> requests_of(const std::vector<pattern::Pattern>& wanted,
                                                 const wire::SimulateRequest& model);
  void settle();

  std::vector<explore::Evaluated> gamut_;
  std::set<pattern::Pattern> chosen_, realised_;
  int count_ = 0;
  std::uint64_t seed_ = 0;
  std::string prefix_;
  int step_ = 0;
  std::map<std::string, int> open_;                             // request -> number of the realisation
  std::map<std::string, std::map<int, double>> log_toughness_;  // of this step, by design and realisation
  bool are_specimens_ = false;                                  // they alone count
  int simulated_ = 0;
};

}  // namespace nacre::proposal_agent
