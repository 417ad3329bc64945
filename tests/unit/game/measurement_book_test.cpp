#include "game/measurement_book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nacre::game {
namespace {

using measurement::SpecimenRecord;
using Receipt = MeasurementBook::Receipt;

SpecimenRecord specimen(const std::string& name, double modulus_pa = 1e9) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = pattern::Mixture{0.65};
  record.modulus_pa = modulus_pa;
  return record;
}

Order order(const std::string& id, int replicates) {
  Order order;
  order.id = id;
  order.round = 1;
  order.design = pattern::Mixture{0.65};
  order.replicates = replicates;
  return order;
}

TEST(MeasurementBook, IdenticalRepeatIsIgnoredAndADifferentOneRefused) {
  MeasurementBook book;
  EXPECT_EQ(book.enter(specimen("a"), "o"), Receipt::accepted);
  EXPECT_EQ(book.enter(specimen("a"), "o"), Receipt::repeated);
  EXPECT_EQ(book.enter(specimen("a", 2e9), "o"), Receipt::conflicting);
  ASSERT_EQ(book.specimens().size(), 1u);
  EXPECT_EQ(book.specimens().front().modulus_pa, 1e9);
}

TEST(MeasurementBook, ASpecimenPulledAtAnotherRateIsBesideItsOrder) {
  const std::vector<Order> orders = {order("o", 2)};
  EXPECT_FALSE(order_mismatch(specimen("as ordered"), orders));
  SpecimenRecord fast = specimen("fast"), thick = specimen("thick"), turned = specimen("turned");
  fast.conditions.strain_rate_per_s *= 2.0;
  thick.conditions.thickness_mm *= 1.12;
  turned.conditions.orientation_deg = 90.0;
  ASSERT_TRUE(order_mismatch(fast, orders));
  EXPECT_NE(order_mismatch(fast, orders)->find("fast"), std::string::npos);
  EXPECT_NE(order_mismatch(fast, orders)->find("0.00123 /s"), std::string::npos) << *order_mismatch(fast, orders);
  EXPECT_TRUE(order_mismatch(thick, orders));
  EXPECT_FALSE(order_mismatch(turned, orders)) << "another order";
  fast.design = pattern::Mixture{1.0};
  EXPECT_FALSE(order_mismatch(fast, orders)) << "nobody ordered it";
}

TEST(MeasurementBook, ReplicatesCompleteAnOrderValidOrNot) {
  MeasurementBook book;
  SpecimenRecord broken = specimen("b");
  broken.valid = false;
  const std::vector<Order> orders = {order("o", 2)};
  book.enter(specimen("a"), "o");
  EXPECT_FALSE(book.progress(orders, 0).front().complete);
  EXPECT_TRUE(book.progress(orders, 1).front().complete) << "one valid specimen is enough when the scenario says so";
  book.enter(broken, "o");
  EXPECT_TRUE(book.progress(orders, 0).front().complete);
  EXPECT_EQ(book.progress(orders, 0).front().valid, 1);
}

TEST(MeasurementBook, AReviewBringsBackASpecimenButNoValueOfAnotherUnit) {
  MeasurementBook book;
  for (const double modulus_pa : {0.4, 0.4e9}) {
    SpecimenRecord left_out = specimen(modulus_pa < 1.0 ? "in GPa" : "in Pa", modulus_pa);
    left_out.valid = false;
    book.enter(left_out, "");
    book.review(left_out.specimen, {1, true, "looks fine"});
  }
  ASSERT_EQ(book.specimens().size(), 2u);
  for (const SpecimenRecord& each : book.specimens()) EXPECT_EQ(each.valid, each.specimen == "in Pa");
}

TEST(MeasurementBook, SpecimensWithoutOrderIdFillTheOldestOrderThatAskedTheSame) {
  MeasurementBook book;
  for (const char* name : {"a", "b", "c"}) book.enter(specimen(name), "");
  const std::vector<Order> orders = {order("first", 2), order("second", 2)};
  const auto progress = book.progress(orders, 0);
  EXPECT_EQ(progress[0].arrived, 2);
  EXPECT_EQ(progress[1].arrived, 1);
}

TEST(MeasurementBook, ASpecimenOfAnotherQuestionDoesNotCount) {
  MeasurementBook book;
  SpecimenRecord turned = specimen("a");
  turned.conditions.orientation_deg = 90.0;
  SpecimenRecord fast = specimen("b");
  fast.conditions.strain_rate_per_s *= 10.0;
  SpecimenRecord tough = specimen("c");
  tough.test = tester::TestKind::toughness;
  for (const SpecimenRecord& each : {turned, fast, tough}) book.enter(each, "");
  EXPECT_EQ(book.progress(std::vector{order("o", 1)}, 0).front().arrived, 0);
}

TEST(MeasurementBook, AnOrdersNameOnASpecimenOfAnotherQuestionClosesNothing) {
  SpecimenRecord other = specimen("other design");
  other.design = pattern::Mixture{0.75};
  SpecimenRecord tough = specimen("other test");
  tough.test = tester::TestKind::toughness;
  SpecimenRecord turned = specimen("turned");
  turned.conditions.orientation_deg = 90.0;
  SpecimenRecord fast = specimen("fast");
  fast.conditions.strain_rate_per_s *= 10.0;
  SpecimenRecord thin = specimen("thin");
  thin.conditions.thickness_mm *= 0.5;
  MeasurementBook book;
  for (const SpecimenRecord& each : {other, tough, turned, fast, thin}) book.enter(each, "o");
  EXPECT_EQ(book.progress(std::vector{order("o", 1)}, 0).front().arrived, 0);
  SpecimenRecord by_callipers = specimen("as callipers and clock show it");
  by_callipers.conditions.thickness_mm = 3.27;
  by_callipers.conditions.strain_rate_per_s *= 1.1;
  book.enter(by_callipers, "o");
  EXPECT_TRUE(book.progress(std::vector{order("o", 1)}, 0).front().complete);
}

TEST(MeasurementBook, SpecimensOfSwappedLabelsCountForTheOrdersThatAskedForThem) {
  Order other = order("other", 1);
  other.design = pattern::Mixture{0.75};
  SpecimenRecord of_other = specimen("b");
  of_other.design = other.design;
  of_other.valid = false;
  MeasurementBook book;
  book.enter(specimen("a"), "other");
  book.enter(of_other, "o");
  const auto progress = book.progress(std::vector{order("o", 1), other}, 0);
  EXPECT_EQ(progress[0].valid, 1);
  EXPECT_EQ(progress[1].valid, 0);
  EXPECT_TRUE(progress[1].complete);
}

TEST(MeasurementBook, HighestRevisionOfAReviewWinsInWhateverOrder) {
  std::vector<Review> reviews = {{1, false, "slipped"}, {2, true, "grip was fine"}, {3, false, "bubble"}};
  std::sort(reviews.begin(), reviews.end(), [](const auto& a, const auto& b) { return a.revision < b.revision; });
  do {
    MeasurementBook book;
    for (const Review& review : reviews) book.review("a", review);
    book.enter(specimen("a"), "");
    EXPECT_FALSE(book.specimens().front().valid);
    EXPECT_EQ(book.specimens().front().note, "bubble");
  } while (std::next_permutation(reviews.begin(), reviews.end(),
                                 [](const auto& a, const auto& b) { return a.revision < b.revision; }));
}

TEST(MeasurementBook, AJudgementThatChangesNothingIsToldWhichOneStands) {
  MeasurementBook book;
  EXPECT_FALSE(book.review_against("a", {1, true, ""}));
  book.review("a", {2, false, "bubble"});
  for (const Review& late : {Review{1, true, ""}, Review{1, false, ""}, Review{2, true, ""}}) {
    ASSERT_TRUE(book.review_against("a", late)) << late.revision;
    EXPECT_EQ(book.review_against("a", late)->revision, 2);
    EXPECT_FALSE(book.review("a", late));
  }
  EXPECT_FALSE(book.review_against("a", {2, false, "bubble"})) << "the same again";
  EXPECT_FALSE(book.review_against("a", {3, true, ""}));
}

TEST(MeasurementBook, NobodyMakesASpecimenValidThatSaysNothing) {
  measurement::SpecimenRecord in_gpa = specimen("a");
  in_gpa.valid = false;
  in_gpa.modulus_pa = 1.2;
  MeasurementBook book;
  book.enter(in_gpa, "");
  ASSERT_TRUE(book.against_validity("a"));
  EXPECT_NE(book.against_validity("a")->find("modulus_pa"), std::string::npos) << *book.against_validity("a");
  book.review("a", {1, true, "looks fine"});
  EXPECT_FALSE(book.specimens().front().valid);
  book.enter(specimen("b"), "");
  EXPECT_FALSE(book.against_validity("b"));
  EXPECT_FALSE(book.against_validity("nobody's"));
}

TEST(MeasurementBook, TheNewestAmendmentCountsInWhateverOrderAndTheOthersAreKept) {
  const SpecimenRecord typed = specimen("a", 1e8), amended = specimen("a", 1e9), again = specimen("a", 1.1e9);
  for (const bool backwards : {false, true}) {
    MeasurementBook book;
    const std::vector<std::pair<Amendment, SpecimenRecord>> reports = {
        {{}, typed}, {{1, "Ada", "decimal point"}, amended}, {{2, "Ada", "second digit"}, again}};
    for (int i = 0; i < 3; ++i) {
      const auto& [amendment, record] = reports[backwards ? 2 - i : i];
      const auto receipt = book.enter(record, "o", amendment);
      EXPECT_EQ(receipt, backwards && i > 0 ? Receipt::superseded : Receipt::accepted);
    }
    ASSERT_EQ(book.specimens().size(), 1u);
    EXPECT_EQ(book.specimens()[0].modulus_pa, 1.1e9);
    EXPECT_EQ(book.revisions().at("a"), 2);
    const std::vector<Report> kept = book.reports_of("a");
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_EQ(kept[0].record.modulus_pa, 1e8);
    EXPECT_EQ(kept[1].amendment.why, "decimal point");
    EXPECT_EQ(book.enter(amended, "o", {1, "Ada", "decimal point"}), Receipt::repeated);
    EXPECT_EQ(book.enter(typed, "o", {1, "Ada", "decimal point"}), Receipt::conflicting);
    EXPECT_EQ(book.specimens()[0].modulus_pa, 1.1e9);
  }
}

TEST(MeasurementBook, AnAmendmentMovesASpecimenToTheOrderThatItFulfils) {
  MeasurementBook book;
  SpecimenRecord fast = specimen("a", 1e9);
  const std::vector<Order> orders = {order("o", 2)};
  fast.conditions.strain_rate_per_s *= 10.0;
  book.enter(fast, "");
  EXPECT_EQ(book.progress(orders, 0)[0].arrived, 0);
  fast.conditions.strain_rate_per_s /= 10.0;
  book.enter(fast, "", {1, "Ada", "rate of the sheet"});
  EXPECT_EQ(book.progress(orders, 0)[0].arrived, 1);
}

TEST(MeasurementBook, OrderOfArrivalDoesNotMatter) {
  std::vector<std::string> names = {"a", "b", "c", "d"};
  std::vector<SpecimenRecord> reference;
  do {
    MeasurementBook book;
    for (const std::string& name : names) book.enter(specimen(name), name == "b" ? "second" : "");
    const auto progress = book.progress(std::vector{order("first", 2), order("second", 2)}, 0);
    EXPECT_EQ(progress[0].arrived, 2);
    EXPECT_EQ(progress[1].arrived, 2);
    if (reference.empty()) reference = book.specimens();
    EXPECT_EQ(book.specimens(), reference);
  } while (std::next_permutation(names.begin(), names.end()));
}

}  // namespace
}  // namespace nacre::game
