#pragma once
// Contrasts: pre-declared unit vectors d over the rows; the statistic of one is d' r of the whitened residual r,
// projected off what the model imitates.

#include <Eigen/Dense>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// A pre-declared direction of the data along which residuals may line up; one value per row, length 1.
struct ContrastDirection {
  std::string name;
  ContrastView view;
  Eigen::VectorXd values;
};

/// What a descriptor describes: the layout, or a condition of the test; one with a law that effects of the library
/// describe, or one without (temperature, humidity, age, machine).
enum class DescriptorKind { design, condition_with_law, condition_without_law };

/// A number that describes a group: its conditions, or its layout.
struct Descriptor {
  std::string name;
  DescriptorKind kind = DescriptorKind::design;
  std::function<double(const Observation&)> of;
};

inline constexpr std::string_view kStrainRate = "strain rate";

/// Rigid fraction, orientation, rate, thickness, print order, batch, temperature, humidity, age, machine; interface
/// length along and across the load, run length of either phase, corner contacts, percolation of the rigid phase.
std::vector<Descriptor> descriptors();

/// Whether a descriptor is a condition of the test, and not a property of the design.
bool is_condition(std::string_view descriptor);

/// Whether it is one that no effect of the library describes.
bool is_without_law(std::string_view descriptor);

/// All contrasts that vary over these specimens: each descriptor and the predicted level in log E, log T, slope and
/// peak stress; every feature as a whole; changes from batch to batch and with the print order; every batch of three
/// and more.
std::vector<ContrastDirection> contrast_directions(const Observations& observations, const Eigen::VectorXd& predicted);

/// One factor on every stress and stiffness of the turned specimens, and one that grows with 1 / thickness: signatures
/// of unmodelled causes that no known effect reproduces exactly (a bulk that is softer across its layers, calipers that
/// are off). None for a condition that does not vary.
std::vector<ContrastDirection> even_directions(const Observations& observations);

/// Smooth laws by which a machine may show moduli: log E' - log E along (E / E_max)^p of the predicted E, for these
/// powers (1 is a compliance to first order). Moduli of layouts and of homogeneous specimens alike.
std::vector<ContrastDirection> smooth_law_directions(const Observations& observations, const Eigen::VectorXd& predicted,
                                                     std::span<const double> powers);

}  // namespace nacre::diagnosis
