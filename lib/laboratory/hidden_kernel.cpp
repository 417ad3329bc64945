#include "laboratory/hidden_kernel.hpp"

#include <cmath>

#include "laboratory/softening.hpp"
#include "laboratory/vector_loops.hpp"

#define NACRE_ALWAYS_INLINE [[gnu::always_inline]] inline

namespace nacre::laboratory {
namespace {

constexpr float kMostFilled = 0.98f;

NACRE_ALWAYS_INLINE float larger(float a, float b) { return a > b ? a : b; }
NACRE_ALWAYS_INLINE float smaller(float a, float b) { return a < b ? a : b; }

/// ln(1 + x) for x from -0.98 to 3: two square roots first, then 2 artanh.
NACRE_ALWAYS_INLINE float log_of_one_plus(float x) {
  const float root = std::sqrt(1.0f + x), first = x / (1.0f + root);  // sqrt(1 + x) - 1 without cancellation
  const float second_root = std::sqrt(1.0f + first), y = first / (1.0f + second_root);
  const float z = y / (2.0f + y), s = z * z;
  return 8.0f * z * (1.0f + s * (1.0f / 3 + s * (1.0f / 5 + s * (1.0f / 7 + s * (1.0f / 9)))));
}

/// Constants of an element and what its point remembers.
struct HiddenMaterial {
  float mu, lambda, flow_limit, inverse_limit, eigenstrain, overstress;
};
struct Memory {
  float p_difference, p_shear, work, v11, v22, v12;
};
struct Stress {
  float p11, p12, p21, p22, energy, jacobian;
};

/// The part of x - ln(1 + x) of a shortened principal stretch.
NACRE_ALWAYS_INLINE float shortened(float x) {
  const float held = larger(smaller(x, 0.0f), -0.97f);
  return held - log_of_one_plus(held);
}

struct Symmetric {
  float xx, yy, xy;
};

/// exp(-h) - 1 for the traceless h = (d, s; s, -d), by its series: det exp(-h) = 1 up to |h|^6 / 400.
NACRE_ALWAYS_INLINE Symmetric inverse_stretch_less_one(float d, float s) {
  const float q = d * d + s * s;
  const float even = q * (0.5f + q * (1.0f / 24)), odd = 1.0f + q * (1.0f / 6 + q * (1.0f / 120));
  return {even - odd * d, even + odd * d, -odd * s};
}

/// (1 + b) m (1 + b) - m + start, for symmetric b and m.
NACRE_ALWAYS_INLINE Symmetric on_both_sides(const Symmetric& b, const Symmetric& m, const Symmetric& start) {
  const float t11 = m.xx * b.xx + m.xy * b.xy, t12 = m.xx * b.xy + m.xy * b.yy;
  const float t21 = m.xy * b.xx + m.yy * b.xy, t22 = m.xy * b.xy + m.yy * b.yy;
  return {start.xx + 2.0f * t11 + b.xx * t11 + b.xy * t21, start.yy + 2.0f * t22 + b.xy * t12 + b.yy * t22,
          start.xy + t12 + t21 + b.xx * t12 + b.xy * t22};
}

template <HiddenParts kParts>
NACRE_ALWAYS_INLINE Stress respond(float h11, float h12, float h21, float h22, const HiddenMaterial& m,
                                   const HiddenStep& step, Memory& memory) {
  float a = h11, b = h12, c = h21, d = h22;
  if constexpr (kParts.shrinks) {
    const float scale = 1.0f / (1.0f + m.eigenstrain);
    a = (h11 - m.eigenstrain) * scale, b = h12 * scale, c = h21 * scale, d = (h22 - m.eigenstrain) * scale;
  }
  Symmetric strain{2.0f * a + a * a + c * c, 2.0f * d + d * d + b * b, b + c + a * b + c * d};
  Symmetric unstretch{};
  if constexpr (kParts.flows) {
    // Plastic stretch exp(h): C_e = exp(-h) C exp(-h). Flow holds the deviator of C_e at its limit.
    unstretch = inverse_stretch_less_one(memory.p_difference, memory.p_shear);
    strain = on_both_sides(unstretch, {1.0f + strain.xx, 1.0f + strain.yy, strain.xy}, strain);
  }
  float c11 = strain.xx, c22 = strain.yy, c12 = strain.xy;
  if constexpr (kParts.flows) {
    const float half = 0.5f * (c11 - c22), size = std::sqrt(half * half + c12 * c12);
    const bool flows = size > m.flow_limit;
    const float cut = flows ? 1.0f - m.flow_limit / size : 0.0f, per_stretch = 1.0f / (2.0f + c11 + c22);
    memory.p_difference += cut * half * per_stretch;
    memory.p_shear += cut * c12 * per_stretch;
    memory.work += flows ? m.mu * m.flow_limit * cut * size : 0.0f;
    c11 -= cut * half;
    c22 += cut * half;
    c12 -= cut * c12;
  }

  const float area = larger(c11 + c22 + (c11 * c22 - c12 * c12), -0.98f);  // J^2 - 1
  const float log_j = 0.5f * log_of_one_plus(area), inverse = 1.0f / (1.0f + area);
  const float k = c11 + c22 - 2.0f * log_j;
  float shear = m.mu, chains = k;
  if constexpr (kParts.fills) {
    const float filled = smaller(m.inverse_limit * k, kMostFilled);
    shear = m.mu / (1.0f - filled);
    chains = m.inverse_limit > 0.0f ? -log_of_one_plus(-filled) / m.inverse_limit : k;
  }
  const float pressure = m.lambda * log_j, minor = c11 * c22 - c12 * c12;
  float s11 = shear * (c11 + minor) * inverse + pressure * (1.0f + c22) * inverse;
  float s22 = shear * (c22 + minor) * inverse + pressure * (1.0f + c11) * inverse;
  float s12 = (shear - pressure) * c12 * inverse;
  float energy = 0.5f * (m.mu * chains + pressure * log_j);
  if constexpr (kParts.flows) energy += memory.work;

  if constexpr (kParts.spares_crush) {
    const float middle = 0.5f * (c11 + c22), spread = std::sqrt(0.25f * (c11 - c22) * (c11 - c22) + c12 * c12);
    const float compressive =
        m.mu * (shortened(middle - spread) + shortened(middle + spread)) + (log_j < 0.0f ? pressure * log_j : 0.0f);
    energy -= 0.5f * step.tension_only * compressive;
  }

  if constexpr (kParts.relaxes) {
    // Maxwell branch: linear in Green's strain.
    const float kept = 1.0f - step.relaxed;
    const float e11 = 0.5f * c11 - memory.v11, e22 = 0.5f * c22 - memory.v22, e12 = 0.5f * c12 - memory.v12;
    memory.v11 += step.relaxed * e11;
    memory.v22 += step.relaxed * e22;
    memory.v12 += step.relaxed * e12;
    const float f11 = kept * e11, f22 = kept * e22, f12 = kept * e12, sum = f11 + f22;
    s11 += m.overstress * (2.0f * m.mu * f11 + m.lambda * sum);
    s22 += m.overstress * (2.0f * m.mu * f22 + m.lambda * sum);
    s12 += m.overstress * 2.0f * m.mu * f12;
    energy += m.overstress * (m.mu * (f11 * f11 + f22 * f22 + 2.0f * f12 * f12) + 0.5f * m.lambda * sum * sum);
  }

  if constexpr (kParts.flows) {
    const Symmetric stress = on_both_sides(unstretch, {s11, s22, s12}, {s11, s22, s12});
    s11 = stress.xx, s22 = stress.yy, s12 = stress.xy;
  }
  const float f1 = 1.0f + h11, f2 = 1.0f + h22;
  return {.p11 = f1 * s11 + h12 * s12,
          .p12 = f1 * s12 + h12 * s22,
          .p21 = h21 * s11 + f2 * s12,
          .p22 = h21 * s12 + f2 * s22,
          .energy = energy,
          .jacobian = f1 * f2 - h12 * h21};
}

template <HiddenParts kParts>
NACRE_ALWAYS_INLINE int advance(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden,
                                const HiddenStep& hidden_step) {
  const float *wx0 = row.wx_lower, *wy0 = row.wy_lower, *wx1 = row.wx_upper, *wy1 = row.wy_upper;
  const float *vx0 = row.vx_lower, *vy0 = row.vy_lower, *vx1 = row.vx_upper, *vy1 = row.vy_upper;
  const float k = step.half_inverse_edge, e = step.grip_strain;
  float *mu_row = row.mu, *lambda_row = row.lambda;
  const float* threshold = row.threshold;
  float* mean_energy = row.energy;
  float *x_lower = row.x_lower + 1, *x_upper = row.x_upper + 1, *x_axial = row.x_axial + 1;
  float *y_lower = row.y_lower + 1, *y_upper = row.y_upper + 1, *y_axial = row.y_axial + 1;
  const int columns = row.columns;
  const HiddenStep law = hidden_step;
  const SofteningShape softening(hidden_step.softening);
  const HiddenRow past = hidden;  // its pointers stay where they are
  int failures = 0, broken = 0;
  NACRE_INDEPENDENT_ITERATIONS
  for (int c = 0; c < columns; ++c) {
    const float mu = mu_row[c], lambda = lambda_row[c];
    const bool live = mu > 0.0f;
    const float kk = live ? k : 0.0f, ee = live ? e : 0.0f;
    const float rising_x = wx1[c + 1] - wx0[c], falling_x = wx0[c + 1] - wx1[c];
    const float rising_y = wy1[c + 1] - wy0[c], falling_y = wy0[c + 1] - wy1[c];
    const float ax = kk * (rising_x + falling_x), bx = kk * (rising_x - falling_x);
    const float ay = kk * (rising_y + falling_y), by = kk * (rising_y - falling_y) + ee;
    const float cx = kGauss * kk * ((wx1[c + 1] - wx1[c]) - (wx0[c + 1] - wx0[c]));
    const float cy = kGauss * kk * ((wy1[c + 1] - wy1[c]) - (wy0[c + 1] - wy0[c]));
    const HiddenMaterial material{mu,
                                  lambda,
                                  past.flow_limit[c],
                                  past.inverse_limit[c],
                                  live ? law.eigen_scale * past.eigenstrain[c] : 0.0f,
                                  past.overstress[c]};
    // Written out point by point: the loop over elements is the one that becomes vector code.
    const auto at_point = [&](int point, float xi, float eta) __attribute__((always_inline)) {
      Memory memory{};
      if constexpr (kParts.flows)
        memory.p_difference = past.plastic[point][0][c], memory.p_shear = past.plastic[point][1][c],
        memory.work = past.work[point][c];
      if constexpr (kParts.relaxes)
        memory.v11 = past.viscous[point][0][c], memory.v22 = past.viscous[point][1][c],
        memory.v12 = past.viscous[point][2][c];
      const Stress stress =
          respond<kParts>(ax + eta * cx, bx + xi * cx, ay + eta * cy, by + xi * cy, material, law, memory);
      if constexpr (kParts.flows)
        past.plastic[point][0][c] = memory.p_difference, past.plastic[point][1][c] = memory.p_shear,
        past.work[point][c] = memory.work;
      if constexpr (kParts.relaxes)
        past.viscous[point][0][c] = memory.v11, past.viscous[point][1][c] = memory.v22,
        past.viscous[point][2][c] = memory.v12;
      return stress;
    };
    const Stress q[4] = {at_point(0, -1.0f, -1.0f), at_point(1, 1.0f, -1.0f), at_point(2, -1.0f, 1.0f),
                         at_point(3, 1.0f, 1.0f)};
    const float energy = larger(larger(q[0].energy, q[1].energy), larger(q[2].energy, q[3].energy));
    const float integrity = soften(past.integrity[c], energy, past.onset[c], softening);
    past.integrity[c] = integrity;
    const float jacobian = smaller(smaller(q[0].jacobian, q[1].jacobian), smaller(q[2].jacobian, q[3].jacobian));
    const bool fails = energy > failure_energy(threshold[c], integrity, jacobian);
    const bool stands = jacobian > 0.0f;
    mean_energy[c] = live ? 0.25f * ((q[0].energy + q[1].energy) + (q[2].energy + q[3].energy)) : 0.0f;
    mu_row[c] = fails ? 0.0f : mu;
    lambda_row[c] = fails ? 0.0f : lambda;
    failures += fails ? 1 : 0;
    broken += stands ? 0 : 1;
    const float keep = fails ? 0.0f : integrity;

    const float vrx = vx1[c + 1] - vx0[c], vfx = vx0[c + 1] - vx1[c];
    const float vry = vy1[c + 1] - vy0[c], vfy = vy0[c + 1] - vy1[c];
    const float viscous = 4.0f * step.viscosity * kk;
    const float vcx = (vx1[c + 1] - vx1[c]) - (vx0[c + 1] - vx0[c]);
    const float vcy = (vy1[c + 1] - vy1[c]) - (vy0[c + 1] - vy0[c]);
    const float fax = q[0].p11 + q[1].p11 + q[2].p11 + q[3].p11 + viscous * (vrx + vfx);
    const float fay = q[0].p21 + q[1].p21 + q[2].p21 + q[3].p21 + viscous * (vry + vfy);
    const float fbx = q[0].p12 + q[1].p12 + q[2].p12 + q[3].p12 + viscous * (vrx - vfx);
    const float fby = q[0].p22 + q[1].p22 + q[2].p22 + q[3].p22 + viscous * (vry - vfy);
    const float fcx =
        kGauss * ((q[2].p11 + q[3].p11 - q[0].p11 - q[1].p11) + (q[1].p12 + q[3].p12 - q[0].p12 - q[2].p12)) +
        (2.0f / 3.0f) * viscous * vcx;
    const float fcy =
        kGauss * ((q[2].p21 + q[3].p21 - q[0].p21 - q[1].p21) + (q[1].p22 + q[3].p22 - q[0].p22 - q[2].p22)) +
        (2.0f / 3.0f) * viscous * vcy;
    x_lower[c] = keep * (fax - fcx);
    x_upper[c] = keep * (fax + fcx);
    x_axial[c] = keep * fbx;
    y_lower[c] = keep * (fay - fcy);
    y_upper[c] = keep * (fay + fcy);
    y_axial[c] = keep * fby;
  }
  return broken > 0 ? -1 - broken : failures;
}

// One function per part and instruction set: what a specimen does not have is not computed.
constexpr HiddenParts kFlowing{.flows = true}, kFilling{.fills = true}, kShrinking{.shrinks = true},
    kRelaxing{.relaxes = true}, kSparing{.spares_crush = true};
constexpr HiddenParts kAll{.flows = true, .fills = true, .shrinks = true, .relaxes = true, .spares_crush = true};

NACRE_VECTOR_CLONES
int advance_flowing(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kFlowing>(row, step, hidden, law);
}

NACRE_VECTOR_CLONES
int advance_filling(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kFilling>(row, step, hidden, law);
}

NACRE_VECTOR_CLONES
int advance_shrinking(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kShrinking>(row, step, hidden, law);
}

NACRE_VECTOR_CLONES
int advance_relaxing(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kRelaxing>(row, step, hidden, law);
}

NACRE_VECTOR_CLONES
int advance_sparing(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kSparing>(row, step, hidden, law);
}

NACRE_VECTOR_CLONES
int advance_any(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden, const HiddenStep& law) {
  return advance<kAll>(row, step, hidden, law);
}

}  // namespace

int advance_hidden_elements(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden,
                            const HiddenStep& law, const HiddenParts& parts) {
  if (parts == kFlowing) return advance_flowing(row, step, hidden, law);
  if (parts == kFilling) return advance_filling(row, step, hidden, law);
  if (parts == kShrinking) return advance_shrinking(row, step, hidden, law);
  if (parts == kRelaxing) return advance_relaxing(row, step, hidden, law);
  if (parts == kSparing) return advance_sparing(row, step, hidden, law);
  return advance_any(row, step, hidden, law);
}

}  // namespace nacre::laboratory
