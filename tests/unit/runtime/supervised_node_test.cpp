#include "runtime/supervised_node.hpp"

#include <unistd.h>

#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace nacre::runtime {
namespace {

using NodeState = SupervisedNode::State;
using testing::HasSubstr;

/// A node whose program ends at once with exit status 1, and what is said of it.
class MortalNode : public testing::Test {
 protected:
  void SetUp() override {
    write_program();
    node_ = std::make_unique<SupervisedNode>(SupervisedNode::Settings{.name = "node",
                                                                      .command = {program_.string()},
                                                                      .log_file = folder_.path() / "output.log",
                                                                      .restarts = {.most = 3, .first_wait = {}}});
    node_->start();
  }
  void write_program() const {
    std::ofstream(program_) << "#!/bin/sh\nexit 1\n";
    std::filesystem::permissions(program_, std::filesystem::perms::owner_all);
  }
  void supervise_until(NodeState state) {
    for (int turn = 0; turn < 1000 && node_->state() != state; ++turn) {
      if (const auto news = node_->supervise(SupervisedNode::Clock::now())) said_ += *news + "\n";
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(node_->state(), state) << said_;
  }

  TemporaryFolder folder_;
  std::filesystem::path program_ = folder_.path() / "program";
  std::unique_ptr<SupervisedNode> node_;
  std::string said_;
};

TEST_F(MortalNode, AStartThatDoesNotSucceedIsADeathUnderTheBudget) {
  supervise_until(NodeState::restarting);
  std::filesystem::remove(program_);
  supervise_until(NodeState::failed);
  EXPECT_THAT(said_, HasSubstr("cannot be started: No such file"));
  EXPECT_THAT(said_, HasSubstr("node died too often"));
}

TEST_F(MortalNode, AProgramThatComesBackInTimeIsStarted) {
  supervise_until(NodeState::restarting);
  std::filesystem::remove(program_);
  EXPECT_THAT(node_->supervise(SupervisedNode::Clock::now()).value_or(""), HasSubstr("cannot be started"));
  write_program();
  supervise_until(NodeState::starting);
  EXPECT_THAT(said_, HasSubstr("node started again"));
}

}  // namespace
}  // namespace nacre::runtime
