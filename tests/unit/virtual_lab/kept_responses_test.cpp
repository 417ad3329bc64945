#include "virtual_lab/kept_responses.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "base/temporary_folder.hpp"
#include "laboratory/draw.hpp"

namespace nacre::virtual_lab {
namespace {

namespace fs = std::filesystem;

class KeptResponses : public testing::Test {
 protected:
  runtime::WorkFunction kept_of(std::uint64_t seed) {
    return kept([this](const std::string& spec) { return "response " + std::to_string(++done_) + " to " + spec; },
                laboratory::draw_truth(seed, tester::Fidelity::tiny), folder_);
  }

  TemporaryFolder scratch_{"kept-responses"};
  fs::path folder_ = scratch_.path() / kKeptFolder;
  int done_ = 0;
};

TEST_F(KeptResponses, OfOneTruthAndSpecAreWorkedOutOnce) {
  EXPECT_EQ(kept_of(1)("a"), "response 1 to a");
  EXPECT_EQ(kept_of(1)("a"), "response 1 to a") << "as another process reads it";
  EXPECT_EQ(kept_of(1)("b"), "response 2 to b");
  EXPECT_EQ(kept_of(2)("a"), "response 3 to a") << "of another truth";
}

TEST_F(KeptResponses, DamagedOnesAreWorkedOutAgain) {
  kept_of(1)("a");
  const fs::path file = fs::directory_iterator(folder_)->path();
  std::ofstream(file, std::ios::app) << "!";
  EXPECT_EQ(kept_of(1)("a"), "response 2 to a");
  EXPECT_EQ(kept_of(1)("a"), "response 2 to a");
  std::ofstream(file, std::ios::trunc);
  EXPECT_EQ(kept_of(1)("a"), "response 3 to a");
}

TEST_F(KeptResponses, ThatCannotBeWrittenAreGivenAllTheSame) {
  std::ofstream(folder_) << "no folder";
  EXPECT_EQ(kept_of(1)("a"), "response 1 to a");
  EXPECT_EQ(kept_of(1)("a"), "response 2 to a");
}

}  // namespace
}  // namespace nacre::virtual_lab
