#pragma once
// The family stage after the game (thesis 2.4.1): the designs of a family, and whether its own model predicts better
// than the global one.

#include <optional>
#include <span>

#include "pattern/layout.hpp"
#include "sysid/errors.hpp"

namespace nacre::game {

/// E and T of one design, as far as known, Pa.
struct DesignValues {
  std::optional<double> modulus_pa, toughness_pa;
  bool operator==(const DesignValues&) const = default;
};

/// A design of a family, as in a row of Tables A.5 and A.6.
struct FamilyDesign {
  pattern::Pattern pattern;
  bool is_seed = false;  ///< a measured design that the family grew from; else chosen from its variants
  DesignValues measured;
  DesignValues global_model;  ///< predicted by the model of the game's last round
  DesignValues family_model;  ///< by the family's own model; of chosen designs before they were measured
  bool operator==(const FamilyDesign&) const = default;
};

/// A mean or largest error over `count` designs; nothing when there are none, as that is no error of 0.
std::optional<double> error_over(int count, double error);

/// Tables 3.6 (seeds) and 3.7 (chosen designs) of one family.
struct FamilyErrors {
  sysid::PredictionErrors seeds_global, seeds_family, chosen_global, chosen_family;
  /// Whether over-fitting can be judged: both models predicted measured seeds and measured chosen designs.
  bool judges_modulus() const;
  bool judges_toughness() const;
  /// The family's model fits the seeds better than the global one and predicts the chosen designs worse: it over-fits.
  /// False where that cannot be judged, as before the chosen designs are measured.
  bool over_fits_modulus() const;
  bool over_fits_toughness() const;
  bool operator==(const FamilyErrors&) const = default;
};

FamilyErrors family_errors(std::span<const FamilyDesign> designs);

}  // namespace nacre::game
