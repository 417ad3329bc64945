// Programs of one's own in a game: examples/laboratory, which comes late, and a client that is refused.

#include "client/client.hpp"

#include <csignal>

#include "persons_game.hpp"
#include "program_test.hpp"
#include "runtime/bus.hpp"
#include "runtime/run_folder.hpp"
#include "wire/convert.hpp"

namespace nacre {
namespace {

using client::Client;
using testing::Contains;

constexpr const char* kScenario = R"(rounds = 1
fidelity = "tiny"
[proposal]
samples = 12
seeds = 1
population = 6
designs = 1
"redraws" = 1
[validation]
random_patterns = 2
replicates = 2
mixtures = []
calibration_evaluations = 3
modulus_evaluations = 12
approval = true
[diagnosis]
bootstraps = 1000
simulations = 0
)";

/// A specimen of an order, lost in the test.
measurement::SpecimenRecord specimen_of(const client::Order& order, const std::string& name) {
  measurement::SpecimenRecord specimen;
  specimen.specimen = name;
  specimen.design = order.design;
  specimen.test = order.test;
  specimen.valid = false;
  specimen.note = "slipped";
  (order.test == tester::TestKind::modulus ? specimen.modulus_pa : specimen.toughness_pa) = 1.2e6;
  return specimen;
}

class ClientsGame : public testing::Test {
 protected:
  ClientsGame() : person_(fresh_folder("clients"), "clients", kScenario) {}
  void TearDown() override {
    if (HasFailure()) std::fputs(person_.game().said().c_str(), stderr);
  }
  PersonsGame person_;
};

TEST_F(ClientsGame, ALaboratoryThatComesLateMeasuresAllThatIsOrderedAndAPlannerDecides) {
  person_.wait_for("orders before the laboratory comes", [&] { return person_.orders().size() >= 10; });
  const fs::path run = person_.run();

  Client planner(run, "planner", {"PROPOSAL"});
  const std::vector<client::Order> open = planner.orders(10.0);
  ASSERT_THAT(open, Not(IsEmpty())) << "given before the planner came";
  const auto foreign_fidelity = [&] {
    client::Order order = open.front();
    order.fidelity = tester::Fidelity::full;
    return planner.report(order, specimen_of(order, "own-1"));
  };
  for (int i = 0; i < 2; ++i) {
    const auto refused = foreign_fidelity();
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("measured at fidelity full, the game is played at tiny"));
  }
  measurement::SpecimenRecord specimen = specimen_of(open.front(), "own-1");
  EXPECT_TRUE(planner.report(open.front(), specimen)) << "a refused specimen leaves its name free";
  EXPECT_TRUE(planner.report(open.front(), specimen));
  specimen.batch = "another";
  EXPECT_THAT(planner.report(open.front(), specimen).error().message, HasSubstr("reported before with other content"));
  specimen.modulus_pa = specimen.toughness_pa = -1.0;
  EXPECT_THAT(planner.report(open.front(), specimen).error().message, HasSubstr("-1"));

  std::vector<client::Heard> heard;
  const auto hear = [&](const client::Heard& message) { heard.push_back(message); };
  for (int i = 0; i < 100 && heard.empty(); ++i) planner.listen(0.1, hear);
  ASSERT_EQ(heard.size(), 1U) << "what waits for approval is told to who asks";
  EXPECT_EQ(heard[0].channel, "PROPOSAL");
  const auto proposal = nlohmann::json::parse(heard[0].json);
  nlohmann::json approval = {
      {"round", proposal["round"]}, {"design", "rigid"}, {"approved", true}, {"by", "planner"}, {"why", ""}};
  EXPECT_THAT(planner.send("APPROVAL", approval.dump()).error().message,
              HasSubstr("is not in the proposal of round 0"));
  approval["design"] = proposal["designs"][0]["design"];
  EXPECT_TRUE(planner.send("APPROVAL", approval.dump()));
  EXPECT_THAT(planner.send("APPROVAL", "[]").error().message, HasSubstr("not a JSON object"));
  EXPECT_FALSE(planner.send("STATUS", "{}"));

  runtime::ChildProcess laboratory({NACRE_TEST_BINARY_DIR "/laboratory", run.string()});
  std::string measured;
  person_.play_to_end();
  EXPECT_EQ(wait_for_end(laboratory, measured).exit_status, 0) << measured;
  EXPECT_THAT(measured, Not(HasSubstr(": "))) << "nothing was refused";
  int ordered = 0;
  for (const wire::TestOrder& order : person_.orders()) ordered += order.replicates;
  EXPECT_EQ(measurements_taken(run).size(), ordered + 3U) << "and the planner's, refused or not";
  EXPECT_EQ(person_.rounds().size(), 2U);
  EXPECT_EQ(run_nacre({"replay", run.string(), "--node", "validation_agent"}).status, 0);

  planner.listen(0.5, [](const client::Heard&) {});
  EXPECT_FALSE(planner.is_playing());
}

/// Says once on the bus of a run that a node of it is there.
void say_hello(const runtime::RunFolder& run) {
  runtime::BusOptions options;
  options.url = runtime::bus_url(run.manifest().port, false);
  options.node = "analyser";
  options.run_id = run.manifest().run_id;
  runtime::Bus::open(std::move(options)).value()->publish({"STATUS", wire::write(wire::NodeStatus{})});
}

TEST(Clients, FollowARunThatGoesOnAtAnotherPort) {
  const fs::path folder = fresh_folder("moved");
  game::Scenario scenario;
  scenario.base_materials_file.clear();
  scenario.discretisation_floor_file.clear();
  runtime::RunFolder run = runtime::RunFolder::create(folder, "moved", scenario);
  const runtime::PortReservation first(0), second(0);
  run.set_port(first.port());
  Client own(run.path(), "own", {"STATUS"});
  run.set_port(second.port());
  int heard = 0;
  for (int i = 0; i < 60 && heard == 0; ++i) {
    say_hello(run);
    own.listen(0.2, [&](const client::Heard& message) { heard += message.node == "analyser"; });
  }
  EXPECT_GT(heard, 0);
}

TEST(Clients, ThatCannotJoinSayWhy) {
  const fs::path folder = fresh_folder("no_run");
  EXPECT_THROW(Client(folder, "own"), InputError);
}

}  // namespace
}  // namespace nacre
