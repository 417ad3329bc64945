#include "diagnosis/diagnosis.hpp"

#include "diagnosis/words.hpp"

namespace nacre::diagnosis {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::base_sufficient:
      return "base_sufficient";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::insufficient:
      return "insufficient";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

std::string_view to_string(CandidateStatus status) {
  switch (status) {
    case CandidateStatus::in_set:
      return "in_set";
    case CandidateStatus::excluded:
      return "excluded";
    case CandidateStatus::invisible:
      return "invisible";
    case CandidateStatus::not_simulated:
      return "not_simulated";
    case CandidateStatus::not_applicable:
      break;
  }
  return "not_applicable";
}

bool is_told(const FittedNumber& number, const material::DerivedNumber& derived) {
  const double widest = derived.unit == "1" ? 1.0 : number.value;
  return number.interval_high - number.interval_low < widest;
}

bool lines_up(const Diagnosis& diagnosis) {
  return !diagnosis.contrasts.empty() && diagnosis.contrasts.front().p_family_wise <= diagnosis.contrast_level;
}

Diagnosis insufficient(const std::string& why) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::insufficient;
  diagnosis.summary = insufficient_in_words(why);
  return diagnosis;
}

}  // namespace nacre::diagnosis
