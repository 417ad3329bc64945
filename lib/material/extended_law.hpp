#pragma once
// The law of Eq. 2.1 with extensions: eigenstrain, limited chain extension, flow, a Maxwell branch, softening
// and failure by tension alone. Symbols: C_e metric of the elastic deformation, G inverse of the plastic metric (det G
// = 1), I = tr(C_e G) - 2, l = ln J_e, S second Piola-Kirchhoff stress.
//
//   eigenstrain e      C_e = F^T F / (1 + e)^2
//   J_m (Gent)         W = -mu J_m / 2 ln(1 - K / J_m) + lambda / 2 l^2,  K = I - 2 l; the base law for J_m ->
//   infinity.
//                      K is I_1 - 2 at constant area; with I_1 - 2 itself a compressible law would start stiffer.
//                      Beyond K = 0.98 J_m, where a notched specimen has long separated, g stays at 50
//   stress             S = mu g (G - C_e^-1) + lambda l C_e^-1,  g = 1 / (1 - K / J_m),  P = F S
//   flow at Y          largest difference of principal Kirchhoff stresses <= Y: the in-plane deviator of C_e G is
//   scaled
//                      back at constant J_e (the closed-form radial return of J2 flow in two dimensions)
//   Maxwell branch     dQ/dt + Q / tau = r dS/dt, the whole stress is S + Q
//   failure            by w = W + work of flow + energy of the branch - c (compressive part of W), which principal
//                      stretches below 1 and J_e < 1 hold
//   softening v        beyond w = W_f stress falls linearly with s = sqrt(w / W_f) to zero at s = 1 + v, so that a
//   stretched
//                      element takes W_f (1 + v) to break; v = 0 breaks at once, as the base model does

#include <array>
#include <limits>

#include <Eigen/Core>

#include "material/neo_hookean.hpp"
#include "material/parameters.hpp"

namespace nacre::material {

/// The extensions of the law, as one specimen has them. Zeros are the base law.
struct LawExtensions {
  double yield_pa = 0.0;           ///< of the rigid phase; 0: it does not flow
  double inverse_limit = 0.0;      ///< 1 / J_m of the soft phase
  double overstress = 0.0;         ///< r, of all materials
  double relaxation_time_s = 0.0;  ///< tau
  double softening = 0.0;          ///< v
  double tension_only = 0.0;       ///< c, 0 to 1
  double shrinkage = 0.0;          ///< of the rigid phase
  bool any() const;
  bool operator==(const LawExtensions&) const = default;
};
/// Reads the extensions that change the law; a Maxwell branch without a relaxation time is none.
LawExtensions law_extensions(const Extensions& extensions);

/// Share of rigid phase in a mixture (0 up to the interface, 1 in rigid material), and of soft phase: an effect of one
/// phase alone is scaled by its share.
double rigid_share(double rigid_fraction);
double soft_share(double rigid_fraction);

/// E over its relaxed value in a tensile test at a constant rate: the chord between 0.05 and 0.25 % strain
/// (ISO 527), 1 + r tau (exp(-t1/tau) - exp(-t2/tau)) / (t2 - t1).
double rate_stiffening(const LawExtensions& extensions, double strain_rate_per_s);
/// The strains of that chord.
inline constexpr double kFirstChordStrain = 0.0005, kLastChordStrain = 0.0025;
/// The relaxation modulus over its relaxed value at `time_s` after a step of strain that is held, 1 + r exp(-t/tau).
double held_stiffening(const LawExtensions& extensions, double time_s);

/// The law of one material.
struct ExtendedLaw {
  Lame lame;
  double threshold_j_per_m3 = std::numeric_limits<double>::infinity();  ///< W_f; infinite: softens never
  double eigenstrain = 0.0;
  double inverse_limit = 0.0;
  double yield_pa = std::numeric_limits<double>::infinity();
  double overstress = 0.0, relaxation_time_s = 0.0;
  double softening = 0.0;
  double tension_only = 0.0;
  bool operator==(const ExtendedLaw&) const = default;
};

/// The law of a mixture of that rigid fraction.
ExtendedLaw extended_law(const LawExtensions& extensions, const Lame& lame, double threshold_j_per_m3,
                         double rigid_fraction);

/// The internal variables of a point, by components 11, 22, 12.
struct PointHistory {
  std::array<double, 3> plastic{};     ///< G - 1
  std::array<double, 3> overstress{};  ///< Q, Pa
  std::array<double, 3> stress{};      ///< S of the last step, Pa
  double plastic_work_j_per_m3 = 0.0;
  double integrity = 1.0;  ///< what softening has left of the stress
};

struct PointResponse {
  Eigen::Matrix2d stress_pa;             ///< P
  double failure_energy_j_per_m3 = 0.0;  ///< w
};

/// The point at displacement gradient `h` (J > 0), `dt_s` after the last call with this history, which it advances.
PointResponse respond(const Eigen::Matrix2d& h, double dt_s, const ExtendedLaw& law, PointHistory& history);

/// Largest stiffness of the law against any stretch, Pa, up to where the energy density reaches `energy`: it limits
/// the time step. lambda + 2 mu without extensions.
double stiffest_tangent_pa(const ExtendedLaw& law, double energy_j_per_m3);

}  // namespace nacre::material
