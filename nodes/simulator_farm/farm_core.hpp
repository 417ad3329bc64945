#pragma once
// The simulator farm's decisions: which tests are open, who waits for them, when a request gets its response.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "game/scenario.hpp"
#include "runtime/node_core.hpp"
#include "simulator_farm/test_request.hpp"
#include "store/kept_simulation.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {

/// Points of the curves kept in memory and in the cache; requests get at most so many.
inline constexpr int kCurvePoints = store::kKeptCurvePoints;

/// SIMULATE in, one Compute (kind "simulate", see simulate_work.hpp) per test that nobody has requested yet, SIMULATED
/// out when all tests of a request are done, and a FRACTURE per design where crack or film was asked for. A test
/// request is one design, one test of one specimen, one set of parameters and conditions; its simulation_key is the id
/// of its Compute. Equal test requests of different requests are computed once. Computes are handed out in the order of
/// the requests.
class FarmCore : public runtime::NodeCore {
 public:
  runtime::Outputs step(const runtime::Input& input) override;
  runtime::Status status() const override;

 private:
  struct OpenTest {
    tester::TestKind test = tester::TestKind::modulus;
    int specimen = 0;
    bool is_done = false;
    bool running = false;
    Extras has, computing;  ///< of the response, and of the one that is being computed
    TestResponse response;
    std::string extras_failure;        ///< why crack or film cannot be had, although the numbers are there
    std::vector<std::string> waiting;  ///< request ids, in the order of asking
    /// Whether the response is there and holds what is wanted (a failure has nothing to add).
    bool suffices(const Extras& wanted) const;
    /// Why whoever wants these gets no number; empty: the numbers are there.
    const std::string& failure(const Extras& wanted) const;
  };
  struct Request {
    std::string content;            ///< hash; another request may not take its id
    wire::SimulateRequest request;  ///< while tests are missing: whoever asks again brings it
    int missing = 0;                ///< tests that are not done
  };

  void accept(const std::string& payload, runtime::Outputs& outputs);
  void settle(const runtime::WorkDone& work, runtime::Outputs& outputs);
  void launch(const std::string& key, const wire::SimulateRequest& request, const pattern::Design& design,
              const Extras& wanted, runtime::Outputs& outputs);
  const OpenTest& open_test(const wire::SimulateRequest& request, const pattern::Design& design,
                            const WantedTest& wanted) const;
  void respond(const wire::SimulateRequest& request, runtime::Outputs& outputs) const;
  wire::SimulatedDesign assembled(const wire::SimulateRequest& request, const pattern::Design& design) const;

  std::map<std::string, OpenTest> tests_;    // by simulation_key
  std::map<std::string, Request> requests_;  // by request_id
  int open_requests_ = 0;
  int asked_ = 0;  // tests of the present busy spell
  int done_ = 0;
  int round_ = 0;  // for people: the one being played
  bool game_over_ = false;
};

/// The core of the farm; the scenario decides nothing here.
std::unique_ptr<runtime::NodeCore> make_core(const game::Scenario& scenario);

}  // namespace nacre::simulator_farm
