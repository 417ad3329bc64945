#include "runtime/pending_requests.hpp"

#include <gtest/gtest.h>

namespace nacre::runtime {
namespace {

constexpr const char* kAsked = "agent/r1/c/T2.0/0#00000000000000aa";
constexpr const char* kOtherwise = "agent/r1/c/T2.0/0#00000000000000bb";

TEST(PendingRequests, WhatWasAskedIsTaken) {
  PendingRequests requests;
  requests.ask(kAsked);
  EXPECT_EQ(requests.fate_of(kAsked, false), ResponseFate::take);
  EXPECT_EQ(requests.fate_of(kAsked, true), ResponseFate::take);
}

// The farm says again what a lost journal held, before the node has come to ask it.
TEST(PendingRequests, WhatMayStillBeAskedIsLeftOnItsWay) {
  PendingRequests requests;
  EXPECT_EQ(requests.fate_of(kAsked, false), ResponseFate::leave);
  requests.ask("agent/r1/c/T1.0/0#00000000000000aa");
  EXPECT_EQ(requests.fate_of(kAsked, false), ResponseFate::leave);
}

TEST(PendingRequests, NobodyWaitsForWhatWasAskedOtherwiseOrCannotBeAskedAnyMore) {
  PendingRequests requests;
  requests.ask(kAsked);
  EXPECT_EQ(requests.fate_of(kOtherwise, false), ResponseFate::dismiss);
  EXPECT_EQ(requests.fate_of("agent/r9/other#00000000000000cc", true), ResponseFate::dismiss);
}

TEST(PendingRequests, IdsWithoutAHashAreTheirOwnPlaces) {
  PendingRequests requests;
  requests.ask("echo/1");
  EXPECT_EQ(requests.fate_of("echo/1", false), ResponseFate::take);
  EXPECT_EQ(requests.fate_of("echo/2", false), ResponseFate::leave);
}

}  // namespace
}  // namespace nacre::runtime
