#include "tester/loading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre::tester {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Loading, ReadsBackWhatItWrites) {
  for (const Loading& loading :
       {Loading{}, Loading{{0.02}}, Loading{{0.02, 0.005, 0.022}}, Loading{{0.1, 0.0}}, Loading{{0.02}, {60.0}},
        Loading{{0.02, 0.03}, {0.0, 5.5}, 0.0}, Loading{{0.02}, {60.0}, 600.0}}) {
    EXPECT_EQ(loading_from_string(to_string(loading)).value(), loading);
  }
  EXPECT_EQ(to_string(Loading{{0.02, 0.005, 0.022}}), "strain 0.02 0.005 0.022");
  EXPECT_EQ(to_string(Loading{{0.02}, {60.0}, 600.0}), "strain 0.02 hold 60 unload dwell 600");
}

TEST(Loading, WhatIsNoProgrammeIsRefusedWithWhatWasExpected) {
  for (const char* text : {"", "Monotonic", "strain", "strain 0.02 x", "strain -0.01", "strain 3", "strain 0.02 0.02",
                           "strain 0", "strain nan", "0.02 0.005", "strain hold 60", "strain 0.02 hold",
                           "strain 0.02 hold 60 hold 60", "strain 0.02 hold -1", "strain 0.02 dwell 60",
                           "strain 0.02 unload 0.03", "strain 0.02 0 unload", "strain 0.02 unload dwell 9 dwell 9"}) {
    const auto loading = loading_from_string(text);
    ASSERT_FALSE(loading) << text;
    EXPECT_THAT(loading.error().message, HasSubstr("expected \"monotonic\""));
  }
}

TEST(Loading, PathTurnsWhereItIsTold) {
  const std::vector<double> path = strain_path(Loading{{0.04, 0.02, 0.03}}, 0.01);
  EXPECT_THAT(path, ElementsAre(0.0, testing::DoubleEq(0.01), testing::DoubleEq(0.02), testing::DoubleEq(0.03), 0.04,
                                testing::DoubleEq(0.03), 0.02, 0.03));
}

}  // namespace
}  // namespace nacre::tester
