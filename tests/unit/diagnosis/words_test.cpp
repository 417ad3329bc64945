#include "diagnosis/words.hpp"

#include <gtest/gtest.h>

#include <set>

namespace nacre::diagnosis {
namespace {

/// Some diagnosis that was decided for this reason.
Diagnosis decided_by(Verdict verdict, Reason reason) {
  Diagnosis d;
  d.verdict = verdict;
  d.finding = {.reason = reason, .nearest = {"droplet_mixing"}, .along = "orientation"};
  if (reason == Reason::other_material) d.untold = {{.material = 1, .modulus_pa = 1.3e9}};
  if (verdict == Verdict::named) d.effects = {{"droplet_mixing", "geometry", 0.5, 0.4, 0.6, "pixels"}};
  return d;
}

TEST(Words, EveryReasonHasASentenceOfItsOwn) {
  using enum Reason;
  std::set<std::string> sentences = {summary_of(decided_by(Verdict::base_sufficient, residuals_are_noise)),
                                     summary_of(decided_by(Verdict::named, one_effect)),
                                     summary_of(decided_by(Verdict::named, two_effects)),
                                     summary_of(decided_by(Verdict::ambiguous, one_effect)),
                                     summary_of(decided_by(Verdict::ambiguous, other_material))};
  for (const Reason reason : {no_effect_helps, residuals_stay, at_bound, weak_signal, contrast, condition, discrepancy,
                              worse_unseen, further_column})
    sentences.insert(summary_of(decided_by(Verdict::unexplained, reason)));
  for (const Reason reason : {nothing_visible, room_is_left})
    sentences.insert(summary_of(decided_by(Verdict::insufficient, reason)));
  Diagnosis of_the_base = decided_by(Verdict::ambiguous, other_material);
  of_the_base.finding.nearest.clear();
  sentences.insert(summary_of(of_the_base));
  EXPECT_EQ(sentences.size(), 17u);
}

TEST(Words, ACautionIsSaidWhereItMatters) {
  Diagnosis d = decided_by(Verdict::base_sufficient, Reason::residuals_are_noise);
  const std::string plain = summary_of(d);
  d.cautions.disconnected_batches = 3;
  d.cautions.at_bounds = {{.material = 0, .modulus_pa = 3e5}};
  EXPECT_EQ(summary_of(d), plain) << "neither bears on a base that is sufficient";
  d.cautions.out_of_line = {"modulus of 577fffe9fffdef"};
  EXPECT_NE(summary_of(d).find("modulus of 577fffe9fffdef"), std::string::npos);
  Diagnosis misfit = decided_by(Verdict::unexplained, Reason::residuals_stay);
  const std::size_t bare = summary_of(misfit).size();
  misfit.cautions = d.cautions;
  EXPECT_GT(summary_of(misfit).size(), bare + 300) << "all three do";
}

}  // namespace
}  // namespace nacre::diagnosis
