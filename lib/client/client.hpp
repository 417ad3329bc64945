#pragma once
// A program of one's own in a running game: a laboratory, a planner, a logger. It needs the folder of the run and a
// name; headers, hashes, repetition until a message has arrived, and what was said before the program came are seen to
// here. examples/laboratory is a whole program.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/specimen_record.hpp"
#include "pattern/design.hpp"
#include "tester/loading.hpp"
#include "tester/simulation.hpp"

namespace nacre::client {

/// What the validation agent wants measured (TEST_ORDER): replicates of one design in one test.
struct Order {
  int round = 0;
  std::string id;  ///< unique within the run
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::Fidelity fidelity = tester::Fidelity::full;  ///< the game's; who measures real specimens ignores it
  int replicates = 1;
  tester::TestConditions conditions;
  tester::Loading loading;  ///< of a coupon
  std::string batch;        ///< print batch
  std::string reason;       ///< base, mixture, random, proposal, discrimination, person, family
};

/// A message as it was heard.
struct Heard {
  std::string channel;
  std::string node;        ///< that sent it
  std::int64_t utime = 0;  ///< microseconds since 1970, by that node's clock
  std::string json;        ///< its fields, with names and numbers as in the .lcm file of its type
};

/// To be used from one thread. What comes in while the program does other things waits. A run that was stopped and goes
/// on at another port is followed there.
class Client {
 public:
  /// Joins the run in a folder (`logs/latest`) as `name`, which no other program of the run has. `channels`: what
  /// listen() hears (lcmtypes/README.md). Throws InputError: no folder of a run, a name of one of its nodes, an unknown
  /// channel, no multicast.
  Client(const std::filesystem::path& run, const std::string& name, const std::vector<std::string>& channels = {});
  ~Client();
  Client(Client&&) noexcept;

  /// Whether there is still something to do: false once the last round is over, or when a minute of waiting has brought
  /// no sign of any node.
  bool is_playing() const;

  /// Orders that were not returned before, also those given before this program came; waits up to `wait_s` for the
  /// first one.
  std::vector<Order> orders(double wait_s);

  /// Hands in a specimen of an order; its name is unique within the run. Returns when every node that needs it has it
  /// in its journal; the same specimen may be reported again. Error: why it is refused (a name that stands for other
  /// values, values out of range), or who did not answer within `patience_s`.
  Result<void> report(const Order& order, const measurement::SpecimenRecord& specimen, double patience_s = 60.0);

  /// Sends any message in the same way, all its fields as Heard::json has them: on APPROVAL {"round": 1,
  /// "design": "577fffe9fffdef", "approved": true, "by": "planner", "why": ""}.
  Result<void> send(const std::string& channel, const std::string& json, double patience_s = 60.0);

  /// Hands over what comes in on the client's channels within `wait_s`: a repeated message once, of PROPOSAL also the
  /// one whose designs wait for approval.
  void listen(double wait_s, const std::function<void(const Heard&)>& hear);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::client
