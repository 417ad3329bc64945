#include "dashboard/specimen_view.hpp"

#include <algorithm>

namespace nacre::dashboard {

SpecimenStoryRow specimen_story(run::Run& run, const std::string& specimen) {
  SpecimenStoryRow row{.specimen = specimen, .measurements = {}, .reviews = {}};
  if (run.version().empty()) return row;  // before the analyser's first write
  for (const std::string& payload : run.payloads("MEASUREMENT")) {
    auto told = wire::read<wire::Measurement>(payload);
    if (told && told->record.specimen == specimen) row.measurements.push_back({std::move(*told)});
  }
  for (const std::string& payload : run.payloads("REVIEW")) {
    auto told = wire::read<wire::Review>(payload);
    if (told && told->specimen == specimen) row.reviews.push_back({std::move(*told)});
  }
  std::ranges::stable_sort(row.reviews, {}, [](const ToldReviewRow& review) { return review.told.revision; });
  return row;
}

}  // namespace nacre::dashboard
