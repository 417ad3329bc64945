#include "runtime/questions.hpp"

#include <gtest/gtest.h>

namespace nacre::runtime {
namespace {

constexpr const char* kAsked = "agent/r1/c/T2.0/0#00000000000000aa";
constexpr const char* kOtherwise = "agent/r1/c/T2.0/0#00000000000000bb";

TEST(Questions, WhatWasAskedIsTaken) {
  Questions questions;
  questions.ask(kAsked);
  EXPECT_EQ(questions.fate_of(kAsked, false), AnswerFate::take);
  EXPECT_EQ(questions.fate_of(kAsked, true), AnswerFate::take);
}

// The farm says again what a lost journal held, before the node has come to ask it.
TEST(Questions, WhatMayStillBeAskedIsLeftOnItsWay) {
  Questions questions;
  EXPECT_EQ(questions.fate_of(kAsked, false), AnswerFate::leave);
  questions.ask("agent/r1/c/T1.0/0#00000000000000aa");
  EXPECT_EQ(questions.fate_of(kAsked, false), AnswerFate::leave);
}

TEST(Questions, NobodyWaitsForWhatWasAskedOtherwiseOrCannotBeAskedAnyMore) {
  Questions questions;
  questions.ask(kAsked);
  EXPECT_EQ(questions.fate_of(kOtherwise, false), AnswerFate::dismiss);
  EXPECT_EQ(questions.fate_of("agent/r9/other#00000000000000cc", true), AnswerFate::dismiss);
}

TEST(Questions, IdsWithoutAHashAreTheirOwnPlaces) {
  Questions questions;
  questions.ask("echo/1");
  EXPECT_EQ(questions.fate_of("echo/1", false), AnswerFate::take);
  EXPECT_EQ(questions.fate_of("echo/2", false), AnswerFate::leave);
}

}  // namespace
}  // namespace nacre::runtime
