// A node with next to no behaviour, for tests of the launcher: it goes by the name it was started as (nacre_NODE) and
// finishes a moment after RUN. NACRE_FAKE describes misbehaviour as NODE:WHAT, separated by commas:
//   crash=N   aborts at each of its first N starts        refuse   ends with exit status 2
//   deaf      ignores SIGINT and SIGTERM                   endless  never finishes

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "runtime/node_main.hpp"
#include "wire/convert.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// The value of `what` for this node; "" when it is not asked for, "1" when it has no value.
std::string misbehaviour(const std::string& node, const std::string& what) {
  const char* text = std::getenv("NACRE_FAKE");
  std::istringstream items(text == nullptr ? "" : text);
  for (std::string item; std::getline(items, item, ',');) {
    if (item == node + ":" + what) return "1";
    if (item.starts_with(node + ":" + what + "=")) return item.substr(item.find('=') + 1);
  }
  return "";
}

void crash_at_first_starts(const runtime::NodeOptions& options) {
  const std::string wanted = misbehaviour(options.node, "crash");
  if (wanted.empty()) return;
  fs::create_directories(options.node_dir());
  const fs::path file = options.node_dir() / "starts";
  int starts = 0;
  std::ifstream(file) >> starts;
  std::ofstream(file) << ++starts;
  if (starts <= std::stoi(wanted)) std::abort();
}

class FakeCore : public runtime::NodeCore {
 public:
  explicit FakeCore(std::string node) : node_(std::move(node)) {}

  runtime::Outputs step(const runtime::Input& input) override {
    runtime::Outputs outputs;
    const auto* message = std::get_if<runtime::Message>(&input);
    if (message == nullptr || message->channel != "RUN" || is_running_) return outputs;
    is_running_ = true;
    if (node_ != "validation_agent" || !misbehaviour(node_, "endless").empty()) return outputs;
    wire::RoundSummary round;
    round.round = 0;
    round.last = true;
    round.decided_by = "the fake";
    outputs.messages.push_back({"ROUND", wire::write(round)});
    return outputs;
  }

  runtime::Status status() const override {
    return {.phase = is_running_ ? "pretending" : "waiting",
            .round = 0,
            .progress = is_running_ ? 1.0 : -1.0,
            .finished = is_running_ && misbehaviour(node_, "endless").empty()};
  }

 private:
  std::string node_;
  bool is_running_ = false;
};

/// Ctrl-C and SIGTERM do nothing to it.
void become_deaf() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  const std::string node = nacre::fs::path(argv[0]).filename().string().substr(std::string("nacre_").size());
  return nacre::runtime::node_main(argc, argv, node, [&](const nacre::runtime::NodeOptions& options, const auto&) {
    nacre::crash_at_first_starts(options);
    if (!nacre::misbehaviour(node, "refuse").empty()) std::exit(2);
    if (!nacre::misbehaviour(node, "deaf").empty()) nacre::become_deaf();
    return nacre::runtime::NodeProgram{std::make_unique<nacre::FakeCore>(node), {}, 1};
  });
}
