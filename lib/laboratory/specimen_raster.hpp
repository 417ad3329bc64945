#pragma once
// The laboratory's own specimen: where each of its elements (half the size of the testers') lies in the printed
// geometry, from distances to pixel boundaries, and which material constants it gets there.

#include <cstdint>
#include <vector>

#include "laboratory/truth.hpp"
#include "material/neo_hookean.hpp"
#include "pattern/design.hpp"
#include "tester/names.hpp"
#include "thesis/constants.hpp"

namespace nacre::laboratory {

/// Edge of the testers' elements and of the laboratory's, and of a pixel.
inline constexpr double kTesterElementM = thesis::kElementSize;
inline constexpr double kElementM = kTesterElementM / 2.0;
inline constexpr double kPixelM = thesis::kElementsPerPixel * kTesterElementM;

/// Where a point of the specimen lies: inside a pixel's material, or within a quarter pixel of a boundary at which
/// pixels differ.
enum class Site : std::uint8_t { soft, rigid, interface_x, interface_y, corner, diagonal };

/// The site of the point (x, y), metres from the lower left of a specimen made of `layout` repeated without end.
/// interface_x: between neighbours along x; corner: within a quarter pixel of a vertical and of a horizontal boundary,
/// pixels around differ; diagonal: such a corner where like pixels touch only across it.
Site site_at(const pattern::Layout& layout, double x_m, double y_m);

/// Outer measures of a specimen and its cuts, in tester elements.
struct SpecimenSize {
  int columns = 0, rows = 0;
  bool notched = false;
  int notch_row = 0;                 ///< lowest row of the notch, which is one tester element high
  int notch_columns = 0;             ///< length from the left edge
  double cut_columns = 0.0;          ///< depth of the triangular cut
  double root_radius_columns = 0.0;  ///< of a hole whose front stays where the notch ends
};
/// The specimen of the testers' geometry at this fidelity.
SpecimenSize specimen_size(tester::TestKind test, tester::Fidelity fidelity);
/// The same with what hidden effects do to its notch.
SpecimenSize specimen_size(tester::TestKind test, tester::Fidelity fidelity, const HiddenEffects& effects);

/// Whether the point was cut away: in the notch, in the triangle of 60 degrees on its axis, or in the hole at its root.
bool is_cut_away(const SpecimenSize& size, double x_m, double y_m);

/// What hidden effects make of the law of the elements; empty vectors and zeros change nothing.
struct HiddenLaw {
  std::vector<double> yield_pa;       ///< per element, infinity where nothing flows
  std::vector<double> inverse_limit;  ///< 1 / J_m per element
  std::vector<double> eigenstrain;    ///< per element
  std::vector<double> overstress;     ///< of the Maxwell branch, per element
  double relaxation_s = 0.0;          ///< in the time of the pull
  double linear_softening = 0.0, drawn_out_softening = 0.0;
  double tension_only = 0.0;
  bool softens() const { return linear_softening > 0.0 || drawn_out_softening > 0.0; }
  bool remembers() const {
    return !yield_pa.empty() || !inverse_limit.empty() || !eigenstrain.empty() || !overstress.empty() ||
           tension_only > 0.0;
  }
  bool any() const { return softens() || remembers(); }
  bool only_softens() const { return softens() && !remembers(); }
};

/// How the grips hold a specimen.
struct Grips {
  double side_stiffness_pa = 0.0;  ///< of every node of a grip against sideways motion, force over displacement
  double tilt = 0.0;  ///< displacement at the right end of the upper grip less that at the left, over the mean
};

/// Constants of one element; a void one has lambda = mu = 0.
struct Raster {
  int columns = 0, rows = 0;
  std::vector<double> mu_pa, lambda_pa;  ///< Eq. 2.2 and 2.3; columns * rows, row 0 at the bottom
  /// W; by the criterion `element` times h_tester / h_laboratory = 2
  std::vector<double> threshold_j_per_m3;
  double neighbourhood_m = 0.0;  ///< R of the criterion `neighbourhood`; 0: another one
  HiddenLaw law = {};
  Grips grips = {};
  bool all_soft = false;  ///< pure soft material: it may stretch without limit
};

/// Which specimen of a design is made, and how it will be pulled.
struct Making {
  double orientation_deg = 0.0;
  double thickness_mm = 3.2;
  double strain_rate_per_s = 6.17e-4;
  double held_s = 0.0;            ///< since the middle of a ramp after which strain is held; 0: it is pulled
  double ramp_s = 0.0;            ///< of that ramp
  double pull_rate_per_s = 20.0;  ///< of the fracture bench
  int specimen = 0;               ///< names the strength of its voxels where that scatters
};

/// The specimen for the modulus bench (theta, no thresholds) or the fracture bench (eta).
Raster modulus_raster(const Truth& truth, const pattern::Design& design, const Making& making,
                      const SpecimenSize& size);
Raster fracture_raster(const Truth& truth, const pattern::Design& design, const Making& making,
                       const SpecimenSize& size);

/// A homogeneous mixture without notch: its Young's modulus (Pa) as a tensile test at that rate gives it, and Lame
/// constants, from theta.
double homogeneous_modulus(const Truth& truth, double rigid_fraction, const Making& making = {});
material::Lame homogeneous_lame(const Truth& truth, double rigid_fraction, const Making& making = {});

}  // namespace nacre::laboratory
