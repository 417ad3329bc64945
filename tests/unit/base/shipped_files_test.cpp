#include "base/shipped_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(ShippedFiles, AProgramThatRunsWhereItWasBuiltFindsTheSourcesAboveIt) {
  EXPECT_EQ(installed_folder(), std::nullopt);
  EXPECT_TRUE(std::filesystem::exists(shipped_folder() / "launch" / "demo.toml")) << shipped_folder();
  EXPECT_TRUE(std::filesystem::exists(shipped_folder() / "data" / "defaults.toml")) << shipped_folder();
}

TEST(ShippedFiles, TheCommitIsAHashOrUnknown) {
  EXPECT_THAT(build_commit(), testing::AnyOf(testing::MatchesRegex("[0-9a-f]+(\\+changes)?"), "unknown"));
}

}  // namespace
}  // namespace nacre
