#include "game/family_errors.hpp"

#include <algorithm>
#include <vector>

namespace nacre::game {
namespace {

sysid::PredictionErrors errors_of(std::span<const FamilyDesign> designs, bool seeds,
                                  DesignValues FamilyDesign::*model) {
  std::vector<measurement::Replicates> measured;
  std::vector<sysid::Prediction> predictions;
  for (const FamilyDesign& design : designs) {
    if (design.is_seed != seeds) continue;
    measurement::Replicates& one = measured.emplace_back();
    one.design = design.pattern;
    one.modulus_count = design.measured.modulus_pa.has_value();
    one.toughness_count = design.measured.toughness_pa.has_value();
    one.modulus_pa = design.measured.modulus_pa.value_or(0.0);
    one.toughness_pa = design.measured.toughness_pa.value_or(0.0);
    predictions.push_back(
        {.modulus_pa = (design.*model).modulus_pa, .toughness_pa = (design.*model).toughness_pa, .curve = {}});
  }
  return sysid::prediction_errors(measured, predictions);
}

bool judges(const FamilyErrors& errors, int sysid::PredictionErrors::*count) {
  return std::min({errors.seeds_global.*count, errors.seeds_family.*count, errors.chosen_global.*count,
                   errors.chosen_family.*count}) > 0;
}

}  // namespace

std::optional<double> error_over(int count, double error) { return count > 0 ? std::optional(error) : std::nullopt; }

bool FamilyErrors::judges_modulus() const { return judges(*this, &sysid::PredictionErrors::modulus_count); }

bool FamilyErrors::judges_toughness() const { return judges(*this, &sysid::PredictionErrors::toughness_count); }

bool FamilyErrors::over_fits_modulus() const {
  return judges_modulus() && seeds_family.modulus_mean < seeds_global.modulus_mean &&
         chosen_family.modulus_mean > chosen_global.modulus_mean;
}

bool FamilyErrors::over_fits_toughness() const {
  return judges_toughness() && seeds_family.toughness_mean < seeds_global.toughness_mean &&
         chosen_family.toughness_mean > chosen_global.toughness_mean;
}

FamilyErrors family_errors(std::span<const FamilyDesign> designs) {
  return {.seeds_global = errors_of(designs, true, &FamilyDesign::global_model),
          .seeds_family = errors_of(designs, true, &FamilyDesign::family_model),
          .chosen_global = errors_of(designs, false, &FamilyDesign::global_model),
          .chosen_family = errors_of(designs, false, &FamilyDesign::family_model)};
}

}  // namespace nacre::game
