#pragma once
// The laboratory's own specimen: where each of its elements (half the size of the testers') lies in the printed
// geometry, from distances to pixel boundaries, and which material constants it gets there.

#include <cstdint>
#include <vector>

#include "material/neo_hookean.hpp"
#include "pattern/design.hpp"
#include "tester/tester.hpp"
#include "thesis/constants.hpp"
#include "virtual_lab/truth.hpp"

namespace nacre::virtual_laboratory {

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
  int notch_row = 0;         ///< lowest row of the notch, which is one tester element high
  int notch_columns = 0;     ///< length from the left edge
  double cut_columns = 0.0;  ///< depth of the triangular cut
};
/// The specimen of the testers' geometry at this fidelity.
SpecimenSize specimen_size(tester::TestKind test, tester::Fidelity fidelity);

/// Whether the point was cut away: in the notch, or in the triangle of 60 degrees on its axis.
bool is_cut_away(const SpecimenSize& size, double x_m, double y_m);

/// Constants of one element; a void one has lambda = mu = 0.
struct Raster {
  int columns = 0, rows = 0;
  std::vector<double> mu_pa, lambda_pa;    ///< Eq. 2.2 and 2.3; columns * rows, row 0 at the bottom
  std::vector<double> threshold_j_per_m3;  ///< scaled by h_tester / h_laboratory = 2
  bool all_soft = false;                   ///< pure soft material: it may stretch without limit
};

/// The specimen for the modulus bench (theta, no thresholds) or the fracture bench (eta).
Raster modulus_raster(const Truth& truth, const pattern::Design& design, double orientation_deg,
                      const SpecimenSize& size);
Raster fracture_raster(const Truth& truth, const pattern::Design& design, double orientation_deg,
                       const SpecimenSize& size);

/// A homogeneous mixture without notch: its Young's modulus (Pa) and Lame constants, from theta.
double homogeneous_modulus(const Truth& truth, double rigid_fraction);
material::Lame homogeneous_lame(const Truth& truth, double rigid_fraction);

}  // namespace nacre::virtual_laboratory
