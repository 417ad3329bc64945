#pragma once
// The inner loop of the laboratory's fracture bench, single precision, one row of elements or of nodes at a time.
//
// Symbols. w: displacement relative to the affine stretch u = e(t) Y of the whole specimen (e: grip strain), so that
// small differences of large numbers never appear and both grips rest. v = dw/dt. H = grad w + diag(0, e), F = I + H, d
// = J - 1. On a square bilinear element of edge h, dw/dx = a + c eta and dw/dy = b + c xi with
//   a = (w10 + w11 - w00 - w01) / 2h,  b = (w01 + w11 - w00 - w10) / 2h,  c = (w00 - w10 - w01 + w11) / 2h.

namespace nacre::laboratory {

/// Distance of a quadrature point from the middle of its element, in half sides: 1 / sqrt(3).
inline constexpr float kGauss = 0.57735027f;

/// A row of elements: its lower and upper row of nodes (columns + 1 entries), its constants (columns entries), and what
/// it returns.
struct ElementRow {
  int columns = 0;
  const float *wx_lower, *wy_lower, *wx_upper, *wy_upper;
  const float *vx_lower, *vy_lower, *vx_upper, *vy_upper;
  float *mu, *lambda;      ///< Pa; set to zero where an element fails
  const float* threshold;  ///< J/m^3
  float* energy;           ///< out: mean energy density of the four points, J/m^3
  /// Forces in units of h/8: the lower nodes of element c get -+(a - c) - b, the upper ones -+(a + c) + b. Entry c + 1
  /// is element c; entries 0 and columns + 1 stay zero.
  float *x_lower, *x_upper, *x_axial, *y_lower, *y_upper, *y_axial;
};

struct ElementStep {
  float grip_strain = 0.0f;
  float half_inverse_edge = 0.0f;  ///< 1 / 2h
  float viscosity = 0.0f;          ///< Pa s, of the stress viscosity * grad v
};

/// Forces and failures of one row of elements. Returns the number of failed elements, or -1 - n when n > 0 live
/// elements have J <= 0 or not a number.
int advance_elements(const ElementRow& row, const ElementStep& step);

/// How stress falls behind the onset of failure; 0: not by that law.
struct SofteningLaw {
  float linear = 0.0f, drawn_out = 0.0f;
};

/// What a row of softening elements remembers.
struct SofteningRow {
  const float* onset;  ///< energy density at which an element starts to break, J/m^3
  float* integrity;    ///< share of its stress that is left
};

/// As advance_elements(), of elements that soften from their onset to their threshold; advances the history.
int advance_softening_elements(const ElementRow& row, const ElementStep& step, const SofteningRow& softening,
                               const SofteningLaw& law);

/// One row of nodes between the elements below (their forces stand in `carry`) and above it.
struct NodeRow {
  int columns = 0;
  const float *x_lower, *x_upper, *x_axial, *y_lower, *y_upper, *y_axial;  ///< of the elements above
  float *carry_x, *carry_y;  ///< in: forces from below; out: forces on the next row of nodes
  float *wx, *wy, *vx, *vy;
  const float* inverse_mass;  ///< relative to an inner node, columns + 1
};

/// Adds up forces, then v -= scale * force / mass and w += dt * v; vertical motion times `free_y` (0 at a grip).
/// `force_y` receives the internal vertical forces in units of h/8.
void advance_nodes(const NodeRow& row, float scale_x, float scale_y, float dt, float* force_y);

}  // namespace nacre::laboratory
