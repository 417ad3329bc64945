#include "measurement/candidate_column.hpp"

namespace nacre::measurement {

std::string reason_for(const CandidateColumn& taken, const CandidateColumn& other) {
  if (other.name->role == ColumnRole::set_point) return "a set point";
  if (other.name->role == ColumnRole::lateral) return "across the specimen";
  if (other.is_dead && !taken.is_dead) return "does not move";
  if (other.name->role == ColumnRole::raw && taken.name->role != ColumnRole::raw) return "not calibrated";
  if (other.is_cut && !taken.is_cut) return "stays at its largest number";
  if (taken.has_unit && !other.has_unit) return "has no unit";
  if (other.goes_back && !taken.goes_back) return "goes back";
  if (other.name->is_qualified && !taken.name->is_qualified) return "another word says more of it";
  if (taken.name->rank < other.name->rank) return "less usual";
  return "stands further right";
}

}  // namespace nacre::measurement
