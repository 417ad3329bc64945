#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::base_sufficient:
      return "base_sufficient";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

bool lines_up(const Diagnosis& diagnosis, const Levels& levels) {
  return !diagnosis.contrasts.empty() && diagnosis.contrasts.front().p_family_wise <= levels.contrast;
}

Diagnosis undecided(const std::string& why) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::ambiguous;
  diagnosis.summary = "These data cannot tell yet: " + why + ".";
  return diagnosis;
}

}  // namespace nacre::diagnosis
