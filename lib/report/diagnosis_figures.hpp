#pragma once
// Figures of a diagnosis as inline SVG.

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/diagnosis.hpp"

namespace nacre::report {

/// A difference or an error of a feature as pages show it: a logarithm's as per cent, another's a hundredfold.
double shown(diagnosis::Feature feature, double difference);
/// The unit of that number: "%", "% strain", "x 100".
std::string_view shown_unit(diagnosis::Feature feature);

/// The strongest contrasts as pictures: measured over predicted of one feature, base and extended, against the abscissa
/// of the contrast.
std::vector<std::string> residual_figures(const diagnosis::Diagnosis& diagnosis, std::size_t most);

/// A plot over numbered features, and which number is which feature; both empty for fewer than three features.
struct FeatureFigure {
  std::string svg;
  std::string numbers;  ///< plain: "1: modulus; 2: toughness; ..."
};
/// Root mean square residual of every feature in standard errors, base and extended: where in the curve the simulation
/// is off.
FeatureFigure feature_figure(const diagnosis::Diagnosis& diagnosis);

/// Measured, base and extended curves of the groups in which the base is off most.
std::vector<std::string> diagnosis_curve_figures(const diagnosis::Diagnosis& diagnosis, std::size_t most);

}  // namespace nacre::report
