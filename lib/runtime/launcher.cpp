#include "runtime/launcher.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "game/scenario.hpp"
#include "runtime/debugger.hpp"
#include "runtime/endpoint.hpp"
#include "runtime/interrupts.hpp"
#include "runtime/live_display.hpp"
#include "runtime/round_history.hpp"
#include "runtime/run_folder.hpp"
#include "runtime/supervised_node.hpp"
#include "runtime/terminal.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using State = SupervisedNode::State;

RunFolder prepare_folder(const LaunchOptions& options, const std::optional<game::Scenario>& scenario) {
  if (!options.only.empty()) return RunFolder::visit(options.resume);
  return scenario ? RunFolder::create(options.logs.value_or("logs"), options.run_name, *scenario)
                  : RunFolder::resume(options.resume);
}

/// The scenario of a new run with what the command line replaces; nothing when a run is resumed.
std::optional<game::Scenario> new_scenario(const LaunchOptions& options) {
  if (!options.resume.empty()) return std::nullopt;
  game::Scenario scenario = game::read_scenario(options.scenario);
  if (options.seed) scenario.seed = *options.seed;
  return scenario;
}

/// A guest has no choice: everybody else is on the port that the run was launched with.
std::unique_ptr<PortReservation> reserve_port_of_host(int port) {
  try {
    return std::make_unique<PortReservation>(port);
  } catch (const InputError&) {
    throw InputError::format(
        "UDP port {}, which the run was launched with, is in use on this machine, and a guest (--only) cannot take "
        "another: expected whoever has it to be stopped, all nodes of this machine in one launch (--only A --only B), "
        "or the run launched with another --port N on the first machine and its folder copied again",
        port);
  }
}

/// A run that goes on takes its old port when it is still free.
std::unique_ptr<PortReservation> reserve_port(const LaunchOptions& options, const game::Scenario& scenario,
                                              int port_of_last_start) {
  if (!options.only.empty()) return reserve_port_of_host(port_of_last_start);
  const int wanted = options.port.value_or(scenario.port);
  if (wanted != 0 || port_of_last_start == 0) return std::make_unique<PortReservation>(wanted);
  try {
    return std::make_unique<PortReservation>(port_of_last_start);
  } catch (const InputError&) {
    return std::make_unique<PortReservation>(0);
  }
}

bool names(const std::vector<std::string>& list, const std::string& node) {
  return std::find(list.begin(), list.end(), node) != list.end();
}

bool is_started_here(const LaunchOptions& options, const std::string& node) {
  return options.only.empty() ? !names(options.elsewhere, node) : names(options.only, node);
}

/// Nodes that are named must be nodes of the run; the run must reach another machine's, debugged ones start here.
void expect_nodes(const LaunchOptions& options, const game::Scenario& scenario) {
  const std::vector<std::string> nodes = scenario.nodes();
  for (const auto* named : {&options.elsewhere, &options.only, &options.debug}) {
    for (const std::string& node : *named) {
      if (names(nodes, node)) continue;
      throw InputError::format("{}: no node of this run: expected one of {}", node, fmt::join(nodes, ", "));
    }
  }
  if (scenario.hosts != "lan" && !(options.elsewhere.empty() && options.only.empty()))
    throw InputError::format(
        "the scenario says hosts = \"{}\": no message leaves this machine; expected hosts = \"lan\"", scenario.hosts);
  for (const std::string& node : options.debug) {
    if (!is_started_here(options, node))
      throw InputError::format("--debug {}: expected a node that is started here", node);
  }
}

fs::path program_of(const LaunchOptions& options, const std::string& node) {
  const fs::path folder = options.program_folder.empty() ? this_program().parent_path() : options.program_folder;
  return folder / ("nacre_" + node);
}

/// Before a run is made that could only fail.
void expect_programs(const LaunchOptions& options, const game::Scenario& scenario) {
  for (const std::string& node : scenario.nodes()) {
    if (!is_started_here(options, node)) continue;
    const fs::path program = program_of(options, node);
    if (::access(program.c_str(), X_OK) != 0 || fs::is_directory(program))
      throw InputError::format("{}: no program that can be started: expected the one of {}", program.string(), node);
  }
}

bool has_failed(const std::unique_ptr<SupervisedNode>& node) { return node && node->state() == State::failed; }

class Launch {
 public:
  Launch(const LaunchOptions& options, RunFolder run, std::unique_ptr<PortReservation> port)
      : options_(options),
        run_(std::move(run)),
        port_(std::move(port)),
        display_(stdout, terminal_columns(STDOUT_FILENO), run_.scenario().rounds) {
    if (!is_guest()) run_.set_port(port_->port());
    std::signal(SIGPIPE, SIG_IGN);  // a reader of our output that has gone must not end the run
  }

  int play();

 private:
  /// Joins a run that another launcher, on another machine, has begun and will sum up.
  bool is_guest() const { return !options_.only.empty(); }
  SupervisedNode::Settings helper(const std::string& name, std::vector<std::string> arguments) const;
  void start_recorder();
  void start_dashboard();
  void open_endpoint();
  std::vector<std::string> command_of(const std::string& node) const;
  void start_nodes();
  void turn(std::chrono::milliseconds wait);
  void take_message(const Received& received);
  void show_output(SupervisedNode& node);
  void announce_when_ready();
  bool game_is_over();
  bool guests_part_is_over() const;
  std::string why_it_cannot_go_on() const;
  bool awaits_mending() const;
  void stop(std::vector<SupervisedNode*> processes);
  void sum_up(bool is_complete);
  std::vector<SupervisedNode*> nodes() const;
  std::string names_of_nodes_not_ready() const;

  LaunchOptions options_;
  RunFolder run_;
  std::unique_ptr<PortReservation> port_;
  Interrupts interrupts_;
  LiveDisplay display_;
  std::unique_ptr<SupervisedNode> recorder_;
  std::unique_ptr<SupervisedNode> dashboard_;  ///< where one is wanted; the game goes on without it
  std::vector<std::unique_ptr<SupervisedNode>> nodes_;
  std::unique_ptr<Endpoint> endpoint_;
  bool recorder_is_ready_ = false;
  bool is_announced_ = false;
  bool is_stopping_ = false;
  bool has_last_round_ = false;
  std::set<std::pair<int, bool>> shown_rounds_;  // number, whether it was the last
  Clock::time_point said_waiting_ = Clock::now();
  Clock::time_point checked_for_end_ = Clock::now();
};

/// A command of nacre that is no node.
SupervisedNode::Settings Launch::helper(const std::string& name, std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), (options_.nacre.empty() ? this_program() : options_.nacre).string());
  return {.name = name,
          .command = std::move(arguments),
          .log_file = run_.node_folder(name) / "output.log",
          .restarts = options_.restarts};
}

void Launch::start_recorder() {
  std::vector<std::string> arguments = {"record",
                                        "--log",
                                        run_.bus_log().string(),
                                        "--port",
                                        std::to_string(port_->port()),
                                        "--hosts",
                                        run_.scenario().hosts};
  if (options_.max_log_mb > 0) arguments.insert(arguments.end(), {"--max-log-mb", std::to_string(options_.max_log_mb)});
  recorder_ = std::make_unique<SupervisedNode>(helper("recorder", std::move(arguments)));
  recorder_->start();
}

void Launch::start_dashboard() {
  dashboard_ = std::make_unique<SupervisedNode>(helper("dashboard", {"dashboard", run_.path().string()}));
  dashboard_->start();
}

void Launch::open_endpoint() {
  BusOptions bus;
  bus.url = bus_url(port_->port(), run_.manifest().lan);
  bus.node = "launcher";
  bus.run_id = run_.manifest().run_id;
  bus.faults = faults_from_environment();
  auto endpoint = Endpoint::open(std::move(bus), run_.scenario().nodes(), {"STATUS", "ROUND"});
  if (!endpoint) throw InputError(endpoint.error().message + "; `nacre doctor` says more");
  endpoint_ = std::move(*endpoint);
}

std::vector<std::string> Launch::command_of(const std::string& node) const {
  std::vector<std::string> command = {
      program_of(options_, node).string(), "--run-dir", run_.path().string(),   "--scenario",
      run_.scenario_file().string(),       "--run-id",  run_.manifest().run_id, "--port",
      std::to_string(port_->port())};
  if (names(options_.debug, node)) command.push_back("--wait-for-debugger");
  return command;
}

void Launch::start_nodes() {
  for (const std::string& name : run_.scenario().nodes()) {
    if (!is_started_here(options_, name)) {
      nodes_.push_back(std::make_unique<SupervisedNode>(
          SupervisedNode::Settings{.name = name, .command = {}, .log_file = {}, .restarts = {}}));
      continue;
    }
    nodes_.push_back(
        std::make_unique<SupervisedNode>(SupervisedNode::Settings{.name = name,
                                                                  .command = command_of(name),
                                                                  .log_file = run_.node_folder(name) / "output.log",
                                                                  .restarts = options_.restarts}));
    nodes_.back()->start();
  }
}

std::vector<SupervisedNode*> Launch::nodes() const {
  std::vector<SupervisedNode*> pointers;
  for (const auto& node : nodes_) pointers.push_back(node.get());
  return pointers;
}

void Launch::take_message(const Received& received) {
  if (received.message.channel == "ROUND") {
    const auto round = wire::read<wire::RoundSummary>(received.message.payload);
    if (!round) return;
    // A ROUND is repeated until everybody has it; the last one is said once more when families followed it.
    if (shown_rounds_.emplace(round->round, round->last).second) display_.say(in_words(*round));
    has_last_round_ = has_last_round_ || round->last;
    return;
  }
  if (received.message.channel != "STATUS") return;
  const auto status = wire::read<wire::NodeStatus>(received.message.payload);
  if (!status) return;
  for (const auto& node : nodes_) {
    if (node->name() != received.header.node) continue;
    node->saw(*status, received.header.epoch, Clock::now());
    // What it said once in a game that is resumed it does not say again.
    has_last_round_ = has_last_round_ || (node->name() == "validation_agent" && node->state() == State::finished);
  }
}

void Launch::show_output(SupervisedNode& node) {
  for (const std::string& line : node.take_output()) {
    if (&node == recorder_.get() && line.rfind("recording", 0) == 0) recorder_is_ready_ = true;
    if (&node == dashboard_.get() && line.starts_with("http"))
      display_.say(fmt::format("see it live in the browser: {}", line));
    if (line.starts_with(kWaitsForDebugger)) display_.say(fmt::format("{} {}", node.name(), line));
    if (!display_.on_terminal()) std::fprintf(stderr, "%s | %s\n", node.name().c_str(), line.c_str());
  }
}

/// One turn of the launcher's loop: messages, output, ends and restarts, display.
void Launch::turn(std::chrono::milliseconds wait) {
  if (endpoint_) {
    endpoint_->pump(wait.count(), [this](const Received& received) { take_message(received); });
  } else {
    std::this_thread::sleep_for(wait);
  }
  std::vector<SupervisedNode*> processes = nodes();
  for (const auto* process : {&recorder_, &dashboard_}) {
    if (*process) processes.push_back(process->get());
  }
  for (SupervisedNode* process : processes) {
    show_output(*process);
    if (const auto news = process->supervise(Clock::now())) display_.say(*news);
  }
  std::vector<NodeView> views;
  for (const auto& node : nodes_) views.push_back(node->view());
  if (!is_stopping_ || display_.on_terminal()) display_.show(views, Clock::now());
}

std::string Launch::names_of_nodes_not_ready() const {
  std::vector<std::string> names;
  for (const auto& node : nodes_) {
    if (!node->is_ready()) names.push_back(node->name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void Launch::announce_when_ready() {
  if (is_announced_ || is_guest()) return;
  const std::string missing = names_of_nodes_not_ready();
  if (missing.empty()) {
    wire::RunStart message;
    message.seed = run_.scenario().seed;
    message.scenario_hash = run_.manifest().scenario_hash;
    message.schema_version = kSchemaVersion;
    const auto offered = endpoint_->offer({"RUN", wire::write(message)});
    if (!offered) throw InputError("RUN: " + offered.error().message);
    is_announced_ = true;
    display_.say("every node is ready: the game begins");
  } else if (Clock::now() - said_waiting_ > std::chrono::seconds(15)) {
    said_waiting_ = Clock::now();
    display_.say(fmt::format("still waiting for {} to be ready", missing));
  }
}

/// The nodes started here have finished, and whoever else plays has finished too or left.
bool Launch::guests_part_is_over() const {
  const auto now = Clock::now();
  return std::all_of(nodes_.begin(), nodes_.end(), [&](const auto& node) {
    return node->state() == State::finished || (has_last_round_ && node->is_silent(now));
  });
}

/// Every node reports that it has finished, and the validation agent, where it runs here, has written the last round
/// down, before which it does not report so.
bool Launch::game_is_over() {
  if (is_guest()) return guests_part_is_over();
  const bool all_finished =
      std::all_of(nodes_.begin(), nodes_.end(), [](const auto& node) { return node->state() == State::finished; });
  if (!all_finished || Clock::now() - checked_for_end_ < std::chrono::milliseconds(500)) return false;
  checked_for_end_ = Clock::now();
  if (!is_started_here(options_, "validation_agent")) return true;
  const std::vector<wire::RoundSummary> rounds = read_rounds(run_.path());
  return !rounds.empty() && rounds.back().last;
}

/// A sentence; empty while the game can go on. What the recorder writes is for people: once the game has begun it goes
/// on without it.
std::string Launch::why_it_cannot_go_on() const {
  const auto gone = [](const auto& node) { return node->state() == State::stopped || node->runs_elsewhere(); };
  if (const auto node = std::find_if(nodes_.begin(), nodes_.end(), has_failed); node != nodes_.end())
    return fmt::format("a node has failed for good ({})", (*node)->name());
  if (!is_announced_ && has_failed(recorder_)) return "the recorder has failed for good before the game began";
  if (std::all_of(nodes_.begin(), nodes_.end(), gone)) return "the nodes started here were all stopped by somebody";
  return "";
}

/// What ended it would end it again.
bool Launch::awaits_mending() const {
  return std::any_of(nodes_.begin(), nodes_.end(), has_failed) || (!is_announced_ && has_failed(recorder_));
}

/// SIGINT, five seconds, SIGTERM, five seconds, SIGKILL; a further Ctrl-C goes to the next signal at once.
void Launch::stop(std::vector<SupervisedNode*> processes) {
  constexpr auto kPatience = std::chrono::seconds(5);
  is_stopping_ = true;
  for (SupervisedNode* process : processes) process->expect_end();
  const auto is_alive = [](const SupervisedNode* process) { return process->is_alive(); };
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    const auto deadline = Clock::now() + kPatience;
    const int interrupts = interrupts_.count();
    for (SupervisedNode* process : processes) process->signal(signal);
    while (std::any_of(processes.begin(), processes.end(), is_alive) && Clock::now() < deadline &&
           interrupts_.count() == interrupts) {
      turn(std::chrono::milliseconds(20));
    }
  }
}

void Launch::sum_up(bool is_complete) {
  try {
    for (const wire::RoundSummary& round : read_rounds(run_.path())) print_line(stdout, in_words(round));
  } catch (const InputError&) {  // a damaged journal, which its node has said
  }
  const fs::path report = run_.path() / "report.html";
  if (fs::exists(report)) print_line(stdout, "report: " + report.string());
  if (options_.dashboard)
    print_line(stdout, fmt::format("page: `nacre dashboard {}`", shell_word(fs::proximate(run_.path()))));
  print_line(stdout, "run: " + run_.path().string());
  if (!is_complete) {
    print_line(stdout, fmt::format("the game is not over: `nacre launch --resume {}` goes on with it{}",
                                   shell_word(fs::proximate(run_.path())),
                                   awaits_mending() ? ", once the cause above is mended" : ""));
  }
}

int Launch::play() {
  constexpr auto kTurn = std::chrono::milliseconds(50);
  display_.say(
      fmt::format("run {} on UDP port {}, in {}", run_.manifest().run_id, port_->port(), run_.path().string()));
  open_endpoint();
  if (options_.dashboard) start_dashboard();
  if (!is_guest()) start_recorder();
  while (recorder_ && !recorder_is_ready_ && recorder_->state() != State::failed && !interrupts_.any()) turn(kTurn);
  bool is_complete = false;
  if (is_guest() || recorder_is_ready_) start_nodes();
  while (!interrupts_.any() && why_it_cannot_go_on().empty() && !is_complete) {
    turn(kTurn);
    announce_when_ready();
    is_complete = game_is_over();
  }
  const bool was_interrupted = interrupts_.any() && !is_complete;
  display_.say(is_complete ? "the game is over" : was_interrupted ? "stopping" : why_it_cannot_go_on() + ": stopping");
  stop(nodes());
  for (const auto* process : {&recorder_, &dashboard_}) {
    if (*process) stop({process->get()});
  }
  if (!is_guest()) sum_up(is_complete);
  std::fflush(stdout);
  std::clearerr(stdout);  // a reader who has gone takes nothing from the game
  return is_complete ? 0 : 1;
}

}  // namespace

int launch(const LaunchOptions& options) {
  const std::optional<game::Scenario> scenario = new_scenario(options);
  const int old_port = scenario ? 0 : read_manifest(options.resume).port;
  const game::Scenario& read = scenario ? *scenario : game::read_scenario(options.resume / "scenario.toml");
  expect_nodes(options, read);
  expect_programs(options, read);
  auto port = reserve_port(options, read, old_port);
  if (const auto route = check_multicast_route(port->port(), read.hosts == "lan"); !route) {
    throw InputError(route.error().message + "; `nacre doctor` says more");
  }
  Launch run(options, prepare_folder(options, scenario), std::move(port));
  return run.play();
}

}  // namespace nacre::runtime
