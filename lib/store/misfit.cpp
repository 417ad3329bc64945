#include "store/misfit.hpp"

#include <fmt/format.h>

namespace nacre::store {
namespace {

/// "E (chi squared 1223 at 8 degrees of freedom)".
std::string in_words(std::string_view property, const sysid::GoodnessOfFit& fit) {
  return fmt::format("{} (chi squared {:.0f} at {} degrees of freedom)", property, fit.chi_squared, fit.freedom);
}

}  // namespace

std::string misfit_beside_verdict(const RoundRecord& round) {
  if (!round.diagnosis || round.diagnosis->verdict != "base_sufficient") return "";
  std::string words;
  if (round.modulus_fit.misfit()) {
    words += fmt::format(
        "The calibration's own fit does not explain {}; the base fit of the diagnosis, which weights by scatter and "
        "searches beyond the calibration's ranges, does. The game goes on with the calibrated parameters.",
        in_words("E", round.modulus_fit));
  }
  if (round.toughness_fit.misfit()) {
    words += fmt::format(
        "{}The calibration's own fit does not explain {}; the diagnosis of a round does not look at fracture.",
        words.empty() ? "" : " ", in_words("T", round.toughness_fit));
  }
  return words;
}

}  // namespace nacre::store
