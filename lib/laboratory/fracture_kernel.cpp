#include "laboratory/fracture_kernel.hpp"

#include "laboratory/softening.hpp"
#include "laboratory/vector_loops.hpp"

namespace nacre::laboratory {
namespace {

/// ln(1 + d) = 2 artanh(z), z = d / (2 + d); absolute error below 1e-7 for J from 1/2 to 2.
[[gnu::always_inline]] inline float logarithm(float z) {
  const float s = z * z;
  return 2.0f * z *
         (1.0f + s * (1.0f / 3 + s * (1.0f / 5 + s * (1.0f / 7 + s * (1.0f / 9 + s * (1.0f / 11 + s * (1.0f / 13)))))));
}

/// First Piola-Kirchhoff stress and energy density of the neo-Hookean law (Eq. 2.1 as corrected) at one point.
struct PointResponse {
  float p11, p12, p21, p22, energy, jacobian;
};

[[gnu::always_inline]] inline PointResponse respond(float h11, float h12, float h21, float h22, float mu,
                                                    float lambda) {
  const float trace = h11 + h22;
  const float d = trace + (h11 * h22 - h12 * h21);
  const float j = 1.0f + d;
  const float shared = 1.0f / (j * (1.0f + j));
  const float inverse_j = shared * (1.0f + j);
  const float log_j = logarithm(d * j * shared);
  const float a = mu * inverse_j, b = lambda * log_j * inverse_j;
  const float sum = h12 + h21, difference = h11 - h22;
  const float square = h11 * h11 + h12 * h12 + h21 * h21 + h22 * h22;
  return {.p11 = a * (difference + d * (1.0f + h11)) + b * (1.0f + h22),
          .p12 = a * (sum + d * h12) - b * h21,
          .p21 = a * (sum + d * h21) - b * h12,
          .p22 = a * (d * (1.0f + h22) - difference) + b * (1.0f + h11),
          .energy = 0.5f * (mu * (2.0f * (trace - log_j) + square) + lambda * log_j * log_j),
          .jacobian = j};
}

/// Softening elements keep a share of their forces; the others all or nothing.
template <bool kSoftens>
[[gnu::always_inline]] inline int advance(const ElementRow& row, const ElementStep& step, const SofteningRow& softening,
                                          const SofteningLaw& law) {
  const int columns = row.columns;
  const float* wx0 = row.wx_lower;
  const float* wy0 = row.wy_lower;
  const float* wx1 = row.wx_upper;
  const float* wy1 = row.wy_upper;
  const float* vx0 = row.vx_lower;
  const float* vy0 = row.vy_lower;
  const float* vx1 = row.vx_upper;
  const float* vy1 = row.vy_upper;
  float* mu_row = row.mu;
  float* lambda_row = row.lambda;
  const float* threshold = row.threshold;
  const float* onset = softening.onset;
  float* integrity = softening.integrity;
  const SofteningShape shape(law);
  float* mean_energy = row.energy;
  float* x_lower = row.x_lower + 1;
  float* x_upper = row.x_upper + 1;
  float* x_axial = row.x_axial + 1;
  float* y_lower = row.y_lower + 1;
  float* y_upper = row.y_upper + 1;
  float* y_axial = row.y_axial + 1;
  const float k = step.half_inverse_edge, e = step.grip_strain, viscosity = step.viscosity;
  int failures = 0, broken = 0;
  NACRE_INDEPENDENT_ITERATIONS
  for (int c = 0; c < columns; ++c) {
    const float mu = mu_row[c], lambda = lambda_row[c];
    const bool live = mu > 0.0f;
    const float kk = live ? k : 0.0f;  // a void element sees no deformation: its nodes may fly apart
    const float ee = live ? e : 0.0f;
    const float rising_x = wx1[c + 1] - wx0[c], falling_x = wx0[c + 1] - wx1[c];
    const float rising_y = wy1[c + 1] - wy0[c], falling_y = wy0[c + 1] - wy1[c];
    const float ax = kk * (rising_x + falling_x), bx = kk * (rising_x - falling_x);
    const float ay = kk * (rising_y + falling_y), by = kk * (rising_y - falling_y) + ee;
    const float cx = kGauss * kk * ((wx1[c + 1] - wx1[c]) - (wx0[c + 1] - wx0[c]));
    const float cy = kGauss * kk * ((wy1[c + 1] - wy1[c]) - (wy0[c + 1] - wy0[c]));
    const PointResponse q00 = respond(ax - cx, bx - cx, ay - cy, by - cy, mu, lambda);
    const PointResponse q10 = respond(ax - cx, bx + cx, ay - cy, by + cy, mu, lambda);
    const PointResponse q01 = respond(ax + cx, bx - cx, ay + cy, by - cy, mu, lambda);
    const PointResponse q11 = respond(ax + cx, bx + cx, ay + cy, by + cy, mu, lambda);

    const float vrx = vx1[c + 1] - vx0[c], vfx = vx0[c + 1] - vx1[c];
    const float vry = vy1[c + 1] - vy0[c], vfy = vy0[c + 1] - vy1[c];
    const float viscous = 4.0f * viscosity * kk;
    const float vcx = (vx1[c + 1] - vx1[c]) - (vx0[c + 1] - vx0[c]);
    const float vcy = (vy1[c + 1] - vy1[c]) - (vy0[c + 1] - vy0[c]);

    const float fax = q00.p11 + q10.p11 + q01.p11 + q11.p11 + viscous * (vrx + vfx);
    const float fay = q00.p21 + q10.p21 + q01.p21 + q11.p21 + viscous * (vry + vfy);
    const float fbx = q00.p12 + q10.p12 + q01.p12 + q11.p12 + viscous * (vrx - vfx);
    const float fby = q00.p22 + q10.p22 + q01.p22 + q11.p22 + viscous * (vry - vfy);
    const float fcx = kGauss * ((q01.p11 + q11.p11 - q00.p11 - q10.p11) + (q10.p12 + q11.p12 - q00.p12 - q01.p12)) +
                      (2.0f / 3.0f) * viscous * vcx;
    const float fcy = kGauss * ((q01.p21 + q11.p21 - q00.p21 - q10.p21) + (q10.p22 + q11.p22 - q00.p22 - q01.p22)) +
                      (2.0f / 3.0f) * viscous * vcy;

    const float energy0 = q00.energy > q10.energy ? q00.energy : q10.energy;
    const float energy1 = q01.energy > q11.energy ? q01.energy : q11.energy;
    const float energy = energy0 > energy1 ? energy0 : energy1;
    bool fails = energy > threshold[c];
    float kept = 1.0f;
    if constexpr (kSoftens) {
      const float jacobian0 = q00.jacobian < q10.jacobian ? q00.jacobian : q10.jacobian;
      const float jacobian1 = q01.jacobian < q11.jacobian ? q01.jacobian : q11.jacobian;
      kept = soften(integrity[c], energy, onset[c], shape);
      integrity[c] = kept;
      fails = fails | is_spent(kept, jacobian0 < jacobian1 ? jacobian0 : jacobian1);
    }
    const float keep = fails ? 0.0f : kept;
    const bool stands = (q00.jacobian > 0.0f) & (q10.jacobian > 0.0f) & (q01.jacobian > 0.0f) & (q11.jacobian > 0.0f);
    mean_energy[c] = 0.25f * ((q00.energy + q10.energy) + (q01.energy + q11.energy));
    mu_row[c] = fails ? 0.0f : mu;
    lambda_row[c] = fails ? 0.0f : lambda;
    failures += fails ? 1 : 0;
    broken += stands ? 0 : 1;
    x_lower[c] = keep * (fax - fcx);
    x_upper[c] = keep * (fax + fcx);
    x_axial[c] = keep * fbx;
    y_lower[c] = keep * (fay - fcy);
    y_upper[c] = keep * (fay + fcy);
    y_axial[c] = keep * fby;
  }
  return broken > 0 ? -1 - broken : failures;
}

}  // namespace

NACRE_VECTOR_CLONES
int advance_elements(const ElementRow& row, const ElementStep& step) { return advance<false>(row, step, {}, {}); }

NACRE_VECTOR_CLONES
int advance_softening_elements(const ElementRow& row, const ElementStep& step, const SofteningRow& softening,
                               const SofteningLaw& law) {
  return advance<true>(row, step, softening, law);
}

NACRE_VECTOR_CLONES
void advance_nodes(const NodeRow& row, float scale_x, float scale_y, float dt, float* force_y) {
  const float* xl = row.x_lower;
  const float* xu = row.x_upper;
  const float* xa = row.x_axial;
  const float* yl = row.y_lower;
  const float* yu = row.y_upper;
  const float* ya = row.y_axial;
  float* carry_x = row.carry_x;
  float* carry_y = row.carry_y;
  float* wx = row.wx;
  float* wy = row.wy;
  float* vx = row.vx;
  float* vy = row.vy;
  const float* inverse_mass = row.inverse_mass;
  float* total_y = force_y;
  const int nodes = row.columns + 1;
  NACRE_INDEPENDENT_ITERATIONS
  for (int n = 0; n < nodes; ++n) {  // node n lies between elements n - 1 (entry n) and n (entry n + 1)
    const float axial_x = xa[n] + xa[n + 1], axial_y = ya[n] + ya[n + 1];
    const float fx = carry_x[n] + ((xl[n] - xl[n + 1]) - axial_x);
    const float fy = carry_y[n] + ((yl[n] - yl[n + 1]) - axial_y);
    carry_x[n] = (xu[n] - xu[n + 1]) + axial_x;
    carry_y[n] = (yu[n] - yu[n + 1]) + axial_y;
    total_y[n] = fy;
    vx[n] -= scale_x * inverse_mass[n] * fx;
    vy[n] -= scale_y * inverse_mass[n] * fy;
    wx[n] += dt * vx[n];
    wy[n] += dt * vy[n];
  }
}

}  // namespace nacre::laboratory
