#pragma once
// The virtual laboratory's decisions: which orders are open, what is simulated, which specimens are reported.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/scenario.hpp"
#include "laboratory/laboratory.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::virtual_lab {

using laboratory::Experiment;
using laboratory::TrueResponse;
using laboratory::Truth;

/// TEST_ORDER in; one Compute (kind "measure") per design, test, conditions and fidelity that nobody has ordered yet;
/// MEASUREMENT out, one per specimen, when the simulation is done. What is measured depends on truth and order alone,
/// never on the order of arrival. A repeated order changes nothing; another order under the same id is refused
/// with a warning. After the last round a REVEAL tells what was hidden.
class VirtualLabCore : public runtime::NodeCore {
 public:
  explicit VirtualLabCore(Truth truth) : truth_(std::move(truth)) {}
  runtime::Outputs step(const runtime::Input& input) override;
  runtime::Status status() const override;

 private:
  /// One simulation and who waits for it.
  struct Simulation {
    Experiment experiment;
    std::optional<Result<TrueResponse>> response;
    std::vector<std::string> waiting;  ///< order ids
  };

  void accept(const std::string& payload, runtime::Outputs& outputs);
  void settle(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void report(const wire::TestOrder& order, const Experiment& experiment, const Result<TrueResponse>& response,
              runtime::Outputs& outputs) const;

  Truth truth_;
  std::map<std::string, wire::TestOrder> orders_;  // by order_id
  std::map<std::string, Simulation> simulations_;  // by id of their Compute
  int latest_round_ = 0;
  int settled_ = 0;  // simulations
  bool game_over_ = false;
};

/// The truth of the scenario's laboratory: from its file, else drawn from the scenario's seed; at the scenario's
/// fidelity. Throws InputError.
Truth truth_of(const game::Scenario& scenario);

/// The core and the long work of the scenario's laboratory.
std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);
std::map<std::string, runtime::WorkFunction> work_functions(const Truth& truth);

}  // namespace nacre::virtual_lab
