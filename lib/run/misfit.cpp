#include "run/misfit.hpp"

#include <fmt/format.h>

namespace nacre::run {
namespace {

/// "E (chi squared 1223 at 8 degrees of freedom)".
std::string in_words(std::string_view property, const sysid::GoodnessOfFit& fit) {
  return fmt::format("{} (chi squared {:.0f} at {} degrees of freedom)", property, fit.chi_squared, fit.freedom);
}

}  // namespace

std::string misfit_beside_verdict(const RoundRecord& round) {
  if (!round.diagnosis || round.diagnosis->verdict != "base_sufficient") return "";
  if (!round.model) return "";
  const sysid::Provenance& fit = round.model->provenance;
  std::string words;
  if (fit.modulus_fit.misfit()) {
    words += fmt::format(
        "The calibration's own fit does not explain {}; the base fit of the diagnosis, which weights by scatter and "
        "searches beyond the calibration's ranges, does. The game goes on with the calibrated parameters.",
        in_words("E", fit.modulus_fit));
  }
  if (fit.toughness_fit.misfit()) {
    words += fmt::format(
        "{}The calibration's own fit does not explain {}; the diagnosis of a round does not look at fracture.",
        words.empty() ? "" : " ", in_words("T", fit.toughness_fit));
  }
  return words;
}

}  // namespace nacre::run
