#include "diagnosis/test_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre::diagnosis {
namespace {

/// "pulled ten times as fast "
std::string_view rate_in_words(AddedTest kind) {
  switch (kind) {
    case AddedTest::faster_twin:
    case AddedTest::faster_coupon:
      return "ten times as fast";
    case AddedTest::twin_between_rates:
    case AddedTest::coupon_between_rates:
      return "at a rate between those measured";
    default:
      return "";
  }
}

std::string way_in_words(const PossibleTest& test) {
  const TestWay& way = test.way;
  switch (way.kind) {
    case AddedTest::turned_twin:
      return "a twin printed turned by 90 degrees";
    case AddedTest::faster_twin:
    case AddedTest::twin_between_rates:
      return fmt::format("a twin pulled {}", rate_in_words(way.kind));
    case AddedTest::thinner_twin:
      return "a twin of half the thickness";
    case AddedTest::checkerboard:
      return fmt::format("a checkerboard of period {}", way.period);
    case AddedTest::laminate_across:
      return fmt::format("a laminate of period {} across the pull", way.period);
    case AddedTest::laminate_along:
      return fmt::format("a laminate of period {} along the pull", way.period);
    case AddedTest::at_other_rate:
      return "a further specimen at another strain rate";
    case AddedTest::relaxation:
      return fmt::format("a further specimen held at its strain for {:g} s", *hold_of(test));
    case AddedTest::notched:
      return "a homogeneous specimen with a notch";
    case AddedTest::paused_coupon:
      return fmt::format(
          "a homogeneous coupon pulled to 2 % strain, held for {0:g} s, unloaded to zero force and left for {0:g} s",
          *hold_of(test));
    case AddedTest::at_other_temperature:
      return "a further specimen at another temperature";
    case AddedTest::in_other_humidity:
      return "a further specimen in another humidity";
    case AddedTest::at_other_age:
      return "a further specimen of another age";
    case AddedTest::on_other_machine:
      return "a measured specimen on another machine";
    case AddedTest::on_two_machines:
      return "one piece on two machines";
    default:
      break;
  }
  const std::string_view rate = rate_in_words(way.kind);
  return fmt::format("a homogeneous coupon pulled {}{}to 2 % strain, back to 0.5 % and on", rate,
                     rate.empty() ? "" : " ");
}

}  // namespace

std::string in_words(const PossibleTest& test) {
  std::vector<std::string> batches;
  for (const auto& [batch, pieces] : test.batches) batches.push_back(fmt::format("\"{}\"", batch));
  if (batches.size() == 1) return fmt::format("{}, of the batch {}", way_in_words(test), batches.front());
  if (test.batch_step == 0.0) return way_in_words(test);
  return way_in_words(test) + (test.is_of_measured_batch ? ", of the same batch" : ", in a new batch");
}

std::string surroundings_in_words(const NextExperiment& experiment) {
  const measurement::Surroundings& s = experiment.surroundings;
  std::string words;
  if (s.temperature_c) words += fmt::format(", at {:.3g} C", *s.temperature_c);
  if (s.humidity_pct) words += fmt::format(", in {:.3g} % humidity", *s.humidity_pct);
  if (experiment.hold_s) words += fmt::format(", held for {:.3g} s", *experiment.hold_s);
  if (s.age_days) words += fmt::format(", {:.3g} days old", *s.age_days);
  if (!experiment.machines.empty())
    words += fmt::format(", on the machine{} \"{}\"", experiment.machines.size() > 1 ? "s" : "",
                         fmt::join(experiment.machines, "\" and \""));
  return words;
}

std::string in_words(const Separated& separated) {
  return fmt::format("{}: its {} separates {} from {} by {:.1f} standard errors after their constants are refitted",
                     in_words(separated.test), in_words(separated.by.feature), separated.one, separated.other,
                     separated.by.errors);
}

std::string in_words(const UntoldMaterial& untold) {
  return fmt::format(
      "homogeneous {} specimens: {} want an E of {:.3g} Pa, theirs would tell another material from an effect "
      "that the model lacks",
      kConstantMaterials[untold.modulus.material], untold.modulus.of_coupons ? "blends" : "layouts",
      untold.modulus.modulus_pa);
}

std::string bundle_in_words(const PossibleTest& test) {
  switch (test.way.kind) {
    case AddedTest::checkerboard:
      return "checkerboards of period 1, 2 and 5";
    case AddedTest::laminate_across:
    case AddedTest::laminate_along:
      return "laminates of period 1, 2 and 5, across and along the pull";
    case AddedTest::notched:
      return "homogeneous specimens with a notch";
    default:
      break;
  }
  if (test.way.kind >= AddedTest::at_other_rate)
    return fmt::format("moduli of {} specimens: {}", test.design.name(), way_in_words(test));
  if (is_twin(test.way.kind)) return fmt::format("{}, {} tests", in_words(test), tester::to_string(test.test));
  if (test.way.kind == AddedTest::paused_coupon) return "homogeneous coupons held, unloaded and left";
  return "homogeneous coupons at several rates, unloaded on the way";
}

std::string specimen_in_words(const PossibleTest& test) {
  return fmt::format("{} of {} at {:.0f} degrees, {:.3g} /s, {} mm", tester::to_string(test.test), test.design.name(),
                     test.conditions.orientation_deg, test.conditions.strain_rate_per_s, test.conditions.thickness_mm);
}

}  // namespace nacre::diagnosis
