#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tester/names.hpp"

namespace nacre::tester {
namespace {

TEST(Names, ComeBackAsTheyWent) {
  for (const Fidelity fidelity : {Fidelity::tiny, Fidelity::preview, Fidelity::full})
    EXPECT_EQ(fidelity_from_string(to_string(fidelity)).value(), fidelity);
  for (const TestKind kind : {TestKind::modulus, TestKind::toughness, TestKind::tensile})
    EXPECT_EQ(test_kind_from_string(to_string(kind)).value(), kind);
  EXPECT_EQ(to_string(EndReason::no_failure), "no_failure");
}

TEST(Names, UnknownOnesAreAnsweredWithTheKnown) {
  const auto fidelity = fidelity_from_string("huge");
  ASSERT_FALSE(fidelity);
  EXPECT_EQ(fidelity.error().message, "fidelity 'huge': expected one of tiny, preview, full, fine");
  EXPECT_FALSE(test_kind_from_string(""));
}

}  // namespace
}  // namespace nacre::tester
