#pragma once
// All that a run has been told of one specimen: what was measured, in the order of arrival, and every review.

#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "run/run.hpp"

namespace nacre::dashboard {

struct ToldMeasurementRow {
  static constexpr std::string_view kPageName = "ToldMeasurement";
  wire::Measurement told;

  static void fields(auto& field, auto& m) {
    const measurement::SpecimenRecord& r = m.told.record;
    field("revision", m.told.revision);
    field("by", m.told.by);
    field("why", m.told.why);
    field("order", m.told.order_id);
    field("round", m.told.round);
    field("design", r.design);
    field("test", r.test);
    condition_fields(field, r.conditions);
    field("batch", r.batch);
    field("print_order", r.print_order);
    field("modulus_pa", r.modulus_pa);
    field("toughness_pa", r.toughness_pa);
    field("modulus_of_curve_pa", measurement::modulus_of(of_curve(r)));
    field("toughness_of_curve_pa", measurement::toughness_of(of_curve(r)));
    field("points", r.curve.size());
    field("valid", r.valid);
    field("note", r.note);
  }

 private:
  /// Without the values that were given.
  static measurement::SpecimenRecord of_curve(measurement::SpecimenRecord record) {
    record.modulus_pa.reset();
    record.toughness_pa.reset();
    return record;
  }
};

struct ToldReviewRow {
  static constexpr std::string_view kPageName = "ToldReview";
  wire::Review told;

  static void fields(auto& field, auto& m) {
    field("revision", m.told.revision);
    field("valid", m.told.valid);
    field("by", m.told.by);
    field("why", m.told.why);
  }
};

struct SpecimenStoryRow {
  static constexpr std::string_view kPageName = "SpecimenStory";
  std::string specimen;
  std::vector<ToldMeasurementRow> measurements;
  std::vector<ToldReviewRow> reviews;

  static void fields(auto& field, auto& m) {
    field("specimen", m.specimen);
    field("measurements", m.measurements);
    field("reviews", m.reviews);
  }
};
/// Throws InputError where run.db cannot be read.
SpecimenStoryRow specimen_story(run::Run& run, const std::string& specimen);

}  // namespace nacre::dashboard
