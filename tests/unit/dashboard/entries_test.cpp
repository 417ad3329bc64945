#include "dashboard/entries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre::dashboard {
namespace {

using testing::HasSubstr;

constexpr const char* kSpecimen =
    R"({"specimen":"a-1","pattern":"577fffe9fffdef","test":"toughness","batch":"b1","valid":true,)"
    R"("curve_csv":"strain,stress_pa\n0,0\n0.01,1e6\n0.02,2e6\n0.03,1e6\n0.04,0\n"})";

std::string fault(const std::string& json) {
  const auto specimen = specimen_from_json(json);
  return specimen ? "none" : specimen.error().message;
}

std::string with(const std::string& member) {
  return R"({"specimen":"a","pattern":"soft","test":"modulus",)" + member + "}";
}

TEST(Entries, ASpecimenIsARowOfAMeasurementSet) {
  const auto specimen = specimen_from_json(kSpecimen);
  ASSERT_TRUE(specimen) << specimen.error().message;
  EXPECT_EQ(specimen->specimen, "a-1");
  EXPECT_EQ(specimen->design.name(), "577fffe9fffdef");
  EXPECT_EQ(specimen->curve.size(), 5u);
  EXPECT_TRUE(specimen->valid);
  EXPECT_DOUBLE_EQ(measurement::toughness_of(*specimen).value(), 4e4);
}

TEST(Entries, NumbersKeepEveryBit) {
  const auto specimen = specimen_from_json(with(R"("modulus_pa":1234567890.1234567)"));
  ASSERT_TRUE(specimen) << specimen.error().message;
  EXPECT_EQ(specimen->modulus_pa.value(), 1234567890.1234567);
}

TEST(Entries, WhatIsWrongIsNamedWithItsColumn) {
  EXPECT_THAT(fault("{}"), HasSubstr("specimen: "));
  EXPECT_THAT(fault(with(R"("modulus_pa":-1)")), HasSubstr("modulus_pa: -1"));
  EXPECT_THAT(fault(with(R"("modulus_pa":"1e999")")), HasSubstr("modulus_pa"));
  EXPECT_THAT(fault(with(R"("modulus_pa":[1])")), HasSubstr("modulus_pa: [1], expected a text or a number"));
  EXPECT_THAT(fault(with(R"("modulus_pa":0.4)")), HasSubstr("modulus_pa: 0.4 Pa, expected 10000"));
  EXPECT_EQ(fault(with(R"("modulus_pa":0.4,"valid":false)")), "none");
  EXPECT_THAT(fault(with(R"("colour":"red")")), HasSubstr("colour: no such column"));
  EXPECT_THAT(fault(with(R"("curve":"/etc/passwd")")), HasSubstr("curve: no such column"));
  EXPECT_THAT(fault(with(R"("curve_csv":"strain,stress_pa\n0,0\n")")), HasSubstr("curve: "));
  EXPECT_THAT(fault(R"({"specimen":"a","pattern":"../../etc/passwd","test":"modulus","modulus_pa":1})"),
              HasSubstr("pattern: "));
}

TEST(Entries, WhatIsNoShallowObjectIsRefused) {
  for (const char* json : {"", "[]", "1", "\"x\"", "{", "\xff\xfe", "nul"})
    EXPECT_THAT(fault(json), HasSubstr("no JSON object")) << json;
  EXPECT_NE(fault("{\"a\":" + std::string(100'000, '[') + std::string(100'000, ']') + "}"), "none");
}

TEST(Entries, AnAmendmentNamesWhatChangesAndWhy) {
  const auto amendment =
      amendment_from_json(R"({"specimen":"a","by":"Ada","why":"decimal point","modulus_pa":1.2e9,"valid":true})");
  ASSERT_TRUE(amendment) << amendment.error().message;
  EXPECT_EQ(amendment->changes, (std::map<std::string, std::string>{{"modulus_pa", "1200000000"}, {"valid", "1"}}));
  EXPECT_FALSE(amendment_from_json(R"({"specimen":"a","by":"Ada","why":" ","modulus_pa":1.2e9})"));
  EXPECT_FALSE(amendment_from_json(R"({"specimen":"a","by":"Ada","why":"x"})")) << "nothing changes";
  EXPECT_FALSE(amendment_from_json(R"({"specimen":"a","by":"Ada","why":"x","modulus_pa":[1]})"));
}

TEST(Entries, AWithdrawalIsOfAnOrderOrADesign) {
  EXPECT_EQ(withdrawal_from_json(R"({"order":"r1/soft/modulus","withdrawn":true,"by":"Ada","why":"resin"})")->order,
            "r1/soft/modulus");
  EXPECT_EQ(withdrawal_from_json(R"({"design":"soft","withdrawn":false,"by":"Ada"})")->design, "soft");
  EXPECT_FALSE(withdrawal_from_json(R"({"design":"soft","withdrawn":true,"by":"Ada","why":""})")) << "no reason";
  EXPECT_FALSE(withdrawal_from_json(R"({"withdrawn":true,"by":"Ada","why":"x"})"));
  EXPECT_FALSE(withdrawal_from_json(R"({"order":"o","design":"soft","withdrawn":true,"by":"Ada","why":"x"})"));
  EXPECT_FALSE(withdrawal_from_json(R"({"design":"no design","withdrawn":true,"by":"Ada","why":"x"})"));
}

TEST(Entries, AReviewNeedsAPersonAndAReason) {
  EXPECT_TRUE(specimen_review_from_json(R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})"));
  EXPECT_FALSE(specimen_review_from_json(R"({"specimen":"a","valid":false,"by":"Ada","why":" "})"));
  EXPECT_FALSE(specimen_review_from_json(R"({"specimen":"a","valid":0,"by":"Ada","why":"x"})"));
  EXPECT_FALSE(specimen_review_from_json(R"({"specimen":"a","valid":false,"why":"x"})"));
  EXPECT_FALSE(specimen_review_from_json(R"({"specimen":"a\nb","valid":false,"by":"Ada","why":"x"})"));
}

TEST(Entries, AnApprovalNamesADesignAndARound) {
  const auto approval =
      approval_from_json(R"({"design":"577fffe9fffdef","round":2,"approved":false,"by":"Ada","why":""})");
  ASSERT_TRUE(approval) << approval.error().message;
  EXPECT_EQ(approval->round, 2);
  EXPECT_EQ(approval_from_json(R"({"design":"mix:0.65","approved":true,"by":"Ada"})")->round, -1);
  const auto coupon = approval_from_json(R"({"design":"checkerboard:2","approved":true,"by":"Ada"})");
  ASSERT_TRUE(coupon) << coupon.error().message;
  EXPECT_EQ(coupon->design, pattern::design_from_word("checkerboard:2")->name());
  EXPECT_FALSE(approval_from_json(R"({"design":"577fffe9fffdef","approved":false,"by":"Ada"})"));
  for (const char* round : {"-2", "1e3", "\"1\"", "18446744073709551615", "99999999999999999999999", "2000000"})
    EXPECT_FALSE(approval_from_json(fmt::format(R"({{"design":"soft","round":{},"approved":true,"by":"Ada"}})", round)))
        << round;
  EXPECT_FALSE(approval_from_json(R"({"design":"nothing","approved":true,"by":"Ada"})"));
}

TEST(Entries, AnErrorNamesTheFieldAndWhatWasTyped) {
  const auto error = [](const auto& result) { return result ? std::string("none") : result.error().message; };
  EXPECT_EQ(error(approval_from_json(R"({"design":"soft","round":2.5,"approved":true,"by":"Ada"})")),
            "round: 2.5, expected a whole number");
  EXPECT_EQ(error(approval_from_json(R"({"design":"soft","round":-7,"approved":true,"by":"Ada"})")),
            "round: -7, expected -1 to 1000000");
  EXPECT_EQ(error(approval_from_json(R"({"design":"soft","approved":"yes","by":"Ada"})")),
            "approved: \"yes\", expected true or false");
  EXPECT_EQ(error(specimen_review_from_json(R"({"specimen":7,"valid":true,"by":"Ada","why":"x"})")),
            "specimen: 7, expected a text");
  EXPECT_EQ(error(simulation_request_from_json(R"({"design":"soft","model":"a/b"})")),
            "model: `a/b`, expected the number of a round or the name of a family");
  EXPECT_EQ(error(grouping_from_json(R"({"families":[{"name":"a","seeds":["soft"]}]})")),
            "family a: seeds: \"soft\", expected a key of 14 hex digits");
  const std::string long_text =
      error(approval_from_json(R"({"design":"soft","approved":")" + std::string(5000, 'x') + R"(","by":"Ada"})"));
  EXPECT_LT(long_text.size(), 120u) << "what was typed is cut where it is long";
}

TEST(Entries, ASimulationRequestNamesAModel) {
  EXPECT_TRUE(simulation_request_from_json(R"({"design":"577fffe9fffdef","model":"2"})"));
  EXPECT_TRUE(simulation_request_from_json(R"({"design":"577fffe9fffdef","model":2})"));
  EXPECT_TRUE(simulation_request_from_json(R"({"design":"577fffe9fffdef","model":"family-1"})"));
  EXPECT_FALSE(simulation_request_from_json(R"({"design":"577fffe9fffdef","model":"../family-1"})"));
  EXPECT_FALSE(simulation_request_from_json(R"({"design":"577fffe9fffdef"})"));
}

TEST(Entries, AGroupingFollowsTheRulesOfItsFile) {
  const auto grouping = grouping_from_json(
      R"({"families":[{"name":"a-1","seeds":["577fffe9fffdef"]},{"name":"b","seeds":["3ffc9b4ad4d2d9"]}]})");
  ASSERT_TRUE(grouping) << grouping.error().message;
  EXPECT_EQ((*grouping)[1].seeds.front().key(), "3ffc9b4ad4d2d9");
  const auto faults = {
      R"({})",
      R"({"families":[]})",
      R"({"families":[1]})",
      R"({"families":[{"name":"a","seeds":[]}]})",
      R"({"families":[{"name":"a/b","seeds":["577fffe9fffdef"]}]})",
      R"({"families":[{"name":"a\"]\n","seeds":["577fffe9fffdef"]}]})",
      R"({"families":[{"name":"a","seeds":["soft"]}]})",
      R"({"families":[{"name":"a","seeds":[7]}]})",
      R"({"families":[{"name":"a","seeds":["577fffe9fffdef"]},{"name":"a","seeds":["3ffc9b4ad4d2d9"]}]})",
      R"({"families":[{"name":"a","seeds":["577fffe9fffdef"]},{"name":"b","seeds":["577fffe9fffdef"]}]})"};
  for (const char* json : faults) EXPECT_FALSE(grouping_from_json(json)) << json;
}

}  // namespace
}  // namespace nacre::dashboard
