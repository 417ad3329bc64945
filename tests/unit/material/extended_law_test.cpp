#include "material/pulled_bar.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre::material {
namespace {

using Eigen::Matrix2d;

constexpr Lame kLame{.mu_pa = 0.6e9, .lambda_pa = 0.8e9};
/// mu = E/2, lambda = 0: nothing couples sideways, so that closed forms are short.
constexpr double kYoungPa = 1e9;
constexpr Lame kUncoupled{.mu_pa = 0.5e9, .lambda_pa = 0.0};

Matrix2d some_gradient(double size) {
  Matrix2d h;
  h << 0.4, -0.7, 0.3, 0.9;
  return size * h;
}

Matrix2d rotation(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

PointResponse once(const Matrix2d& h, const ExtendedLaw& law, double dt_s = 1.0) {
  PointHistory history;
  return respond(h, dt_s, law, history);
}

TEST(ExtendedLaw, WithoutExtensionsIsTheBaseLaw) {
  for (const double size : {1e-4, 1e-2, 0.3}) {
    const Matrix2d h = some_gradient(size);
    const PointResponse response = once(h, {.lame = kLame});
    EXPECT_LT((response.stress_pa - first_piola(h, kLame)).norm(), 1e-11 * kLame.mu_pa);
    EXPECT_NEAR(response.failure_energy_j_per_m3 / energy_density(h, kLame), 1.0, 1e-6);
  }
}

// P = dW/dF, W per unit of the unstrained area: (1 + e)^2 times what the elastic part holds.
TEST(ExtendedLaw, StressOfGentAndEigenstrainIsTheDerivativeOfTheEnergy) {
  const ExtendedLaw law{.lame = kLame, .eigenstrain = -0.02, .inverse_limit = 1.0 / 0.8};
  const Matrix2d h = some_gradient(0.2);
  const double scale = (1.0 + law.eigenstrain) * (1.0 + law.eigenstrain), step = 1e-5;
  const Matrix2d stress = once(h, law).stress_pa;
  for (int i = 0; i < 4; ++i) {
    Matrix2d more = h, less = h;
    more(i / 2, i % 2) += step;
    less(i / 2, i % 2) -= step;
    const double slope =
        scale * (once(more, law).failure_energy_j_per_m3 - once(less, law).failure_energy_j_per_m3) / (2.0 * step);
    EXPECT_NEAR(stress(i / 2, i % 2), slope, 1e-6 * kLame.mu_pa);
  }
}

TEST(ExtendedLaw, RotationTurnsStressAndChangesNoEnergy) {
  const ExtendedLaw law{.lame = kLame,
                        .eigenstrain = 0.01,
                        .inverse_limit = 1.0,
                        .yield_pa = 2e7,
                        .overstress = 0.7,
                        .relaxation_time_s = 2.0,
                        .tension_only = 0.6};
  const Matrix2d h = some_gradient(0.1), turn = rotation(1.1);
  const PointResponse straight = once(h, law),
                      turned = once(turn * (Matrix2d::Identity() + h) - Matrix2d::Identity(), law);
  EXPECT_LT((turned.stress_pa - turn * straight.stress_pa).norm(), 1e-6 * straight.stress_pa.norm());
  EXPECT_NEAR(turned.failure_energy_j_per_m3 / straight.failure_energy_j_per_m3, 1.0, 1e-9);
}

// lambda = 0: F11 = 1 and P22 = mu g (F22 - 1/F22) with g = 1 / (1 - (F22^2 - 1 - 2 ln F22) / J_m).
TEST(Gent, FollowsTheUniaxialClosedForm) {
  const double limit = 0.9;
  PulledBar bar({.lame = kUncoupled, .inverse_limit = 1.0 / limit});
  for (const double strain : {0.01, 0.1, 0.3, 0.6}) {
    const double stress = bar.pull(strain, 1.0), stretch = 1.0 + strain;
    const double g = 1.0 / (1.0 - (stretch * stretch - 1.0 - 2.0 * std::log(stretch)) / limit);
    EXPECT_NEAR(bar.sideways(), 0.0, 1e-9);
    EXPECT_NEAR(stress, kUncoupled.mu_pa * g * (stretch - 1.0 / stretch), 1e-3);
  }
}

// Steps of any size, turns, and strains that hardly differ from the last.
TEST(PulledBar, FollowsTheWidthOfTheClosedFormWhateverItsSteps) {
  PulledBar bar({.lame = kLame});
  for (const double strain : {1e-9, 1e-4, 2e-4, 2e-4 + 1e-15, 0.01, 0.02, 0.015, 0.015 - 1e-12, 0.014, 0.3, 0.9, 0.2}) {
    const UniaxialState closed = uniaxial_stress(strain, kLame);
    EXPECT_NEAR(bar.pull(strain, 1.0), closed.nominal_stress_pa, 1e-12 * kLame.mu_pa) << strain;
    EXPECT_NEAR(bar.sideways(), closed.lateral_stretch - 1.0, 1e-12) << strain;
  }
}

TEST(Gent, RisesLateAndStartsAlike) {
  PulledBar base({.lame = kLame}), gent({.lame = kLame, .inverse_limit = 1.0 / 0.8});
  EXPECT_NEAR(gent.pull(1e-4, 1.0) / base.pull(1e-4, 1.0), 1.0, 3e-4);
  EXPECT_GT(gent.pull(0.4, 1.0) / base.pull(0.4, 1.0), 1.2);
}

// A coupon may have been pulled farther than the limit that a fit tries: it has a stress there all the same, and the
// work done on it is its energy.
TEST(Gent, HasAStateBeyondItsChains) {
  PulledBar bar({.lame = kLame, .inverse_limit = 1.0 / 0.2});
  double work = 0.0, last = 0.0;
  constexpr double kStep = 1e-4;
  for (double strain = kStep; strain < 1.0; strain += kStep) {
    const double stress = bar.pull(strain, 1.0);
    ASSERT_GT(stress, last) << strain;
    work += 0.5 * (stress + last) * kStep;
    last = stress;
  }
  EXPECT_NEAR(bar.failure_energy_j_per_m3() / work, 1.0, 1e-4);
}

TEST(Flow, KeepsTheUniaxialKirchhoffStressAtTheYieldStress) {
  PulledBar bar({.lame = kLame, .yield_pa = 3e7});
  for (double strain = 0.0; strain < 0.1; strain += 1e-3) {
    const double kirchhoff = bar.pull(strain, 1.0) * (1.0 + strain);
    EXPECT_LE(kirchhoff, 3e7 * (1.0 + 1e-9));
    if (strain < 0.05) continue;
    EXPECT_NEAR(kirchhoff / 3e7, 1.0, 1e-9);
  }
}

TEST(Flow, LeavesAPermanentSetAndTheElasticSlope) {
  PulledBar bar({.lame = kLame, .yield_pa = 3e7});
  double strain = 0.0, loading = bar.pull(1e-4, 1.0) / 1e-4;
  for (; strain < 0.06; strain += 5e-4) bar.pull(strain, 1.0);
  double stress = bar.pull(strain, 1.0);
  const double top = stress, top_strain = strain;
  while (stress > 0.0) stress = bar.pull(strain -= 1e-4, 1.0);
  // The elastic part is stretched beyond the set, which takes the nominal slope down.
  const double elastic = top / loading * (1.0 + top_strain) * (1.0 + strain);
  EXPECT_NEAR(strain, top_strain - elastic, 0.03 * elastic);
  EXPECT_GT(strain, 0.02);
}

TEST(Flow, HappensAtConstantArea) {
  PulledBar bar({.lame = kLame, .yield_pa = 3e7});
  for (double strain = 0.0; strain < 0.2; strain += 1e-3) bar.pull(strain, 1.0);
  const auto& g = bar.history().plastic;
  EXPECT_NEAR((1.0 + g[0]) * (1.0 + g[1]) - g[2] * g[2], 1.0, 1e-9);
}

// The grips' work is the energy stored and the work of flow.
TEST(Flow, FailureEnergyIsTheWorkDone) {
  const auto error = [](double step) {
    PulledBar bar({.lame = kLame, .yield_pa = 3e7});
    double work = 0.0, last = 0.0;
    for (double strain = step; strain < 0.08; strain += step) {
      const double stress = bar.pull(strain, 1.0);
      work += 0.5 * step * (stress + last);
      last = stress;
    }
    return std::abs(bar.failure_energy_j_per_m3() / work - 1.0);
  };
  EXPECT_LT(error(1e-4), 5e-3);
  EXPECT_LT(error(5e-5), 0.6 * error(1e-4)) << "the return is of first order";
}

TEST(MaxwellBranch, IsStifferByItsOverstressWhenPulledAtOnceAndRelaxedAfterwards) {
  const ExtendedLaw law{.lame = kLame, .overstress = 0.5, .relaxation_time_s = 10.0};
  PulledBar base({.lame = kLame}), bar(law);
  const double relaxed = base.pull(0.01, 1.0), unrelaxed = bar.pull(0.01, 1e-6);
  EXPECT_NEAR(unrelaxed / relaxed, 1.5, 1e-5);
  EXPECT_NEAR((bar.pull(0.01, 10.0) - relaxed) / (0.5 * relaxed), std::exp(-1.0), 1e-2);
  EXPECT_NEAR(bar.pull(0.01, 1e4) / relaxed, 1.0, 1e-9);
}

TEST(MaxwellBranch, EnergyOfASuddenPullIsThatOfTheStifferMaterial) {
  PulledBar base({.lame = kLame}), bar({.lame = kLame, .overstress = 0.5, .relaxation_time_s = 10.0});
  base.pull(1e-3, 1.0);
  bar.pull(1e-3, 1e-9);
  EXPECT_NEAR(bar.failure_energy_j_per_m3() / base.failure_energy_j_per_m3(), 1.5, 5e-3);
}

// Small strain at a constant rate: stress = E rate (t + r tau (1 - exp(-t/tau))), whatever the steps.
TEST(MaxwellBranch, FollowsTheRampInClosedForm) {
  const double tau = 3.0, overstress = 0.8, rate = 1e-5;
  for (const int steps : {1, 7, 50}) {
    PulledBar bar({.lame = kUncoupled, .overstress = overstress, .relaxation_time_s = tau});
    const double end = 6.0;
    double stress = 0.0;
    for (int i = 1; i <= steps; ++i) stress = bar.pull(rate * end * i / steps, end / steps);
    const double exact = kYoungPa * rate * (end + overstress * tau * (1.0 - std::exp(-end / tau)));
    EXPECT_NEAR(stress / exact, 1.0, 2e-4) << steps;
  }
}

TEST(MaxwellBranch, StiffensTheChordOfAModulusTestAsTheRampDoes) {
  const LawExtensions extensions{.overstress = 0.8, .relaxation_time_s = 2.0};
  const double rate = 6.17e-4;
  PulledBar bar({.lame = kUncoupled, .overstress = 0.8, .relaxation_time_s = 2.0});
  const double first = bar.pull(0.0005, 0.0005 / rate), last = bar.pull(0.0025, 0.002 / rate);
  EXPECT_NEAR((last - first) / 0.002 / kYoungPa, rate_stiffening(extensions, rate), 3e-3);
  EXPECT_NEAR(rate_stiffening(extensions, 1e6), 1.8, 1e-6);
  EXPECT_NEAR(rate_stiffening(extensions, 1e-12), 1.0, 1e-6);
  EXPECT_EQ(rate_stiffening({}, rate), 1.0);
}

// The declared energy breaks it: the area under the curve of a stretched bar is W_f (1 + v).
TEST(Softening, SpendsTheDeclaredEnergy) {
  const double threshold = 2e4;  // small strains, where stress is linear
  for (const double softening : {0.25, 1.0, 3.0}) {
    PulledBar bar({.lame = kUncoupled, .threshold_j_per_m3 = threshold, .softening = softening});
    double work = 0.0, last = 0.0, strain = 0.0;
    const double first = std::sqrt(2.0 * threshold / kYoungPa), step = 1e-3 * first;
    do {
      const double stress = bar.pull(strain += step, 1.0);
      work += 0.5 * step * (stress + last);
      last = stress;
    } while (last > 0.0);
    EXPECT_NEAR(work / (threshold * (1.0 + softening)), 1.0, 0.02);
    EXPECT_NEAR(strain / (first * (1.0 + softening)), 1.0, 0.02);
  }
}

TEST(Softening, NeverHeals) {
  PulledBar bar({.lame = kUncoupled, .threshold_j_per_m3 = 2e4, .softening = 1.0});
  bar.pull(1.5 * std::sqrt(4e4 / kYoungPa), 1.0);
  const double left = bar.history().integrity;
  EXPECT_LT(left, 0.5);
  EXPECT_NEAR(bar.pull(1e-4, 1.0) / (kYoungPa * 1e-4), left, 1e-3);
  EXPECT_EQ(bar.history().integrity, left);
}

TEST(TensionOnly, ForgetsWhatCompressionHoldsAndNothingElse) {
  const Lame lame = lame_from_engineering(1e9, 0.3);
  PulledBar all({.lame = lame}), tension({.lame = lame, .tension_only = 1.0}),
      half({.lame = lame, .tension_only = 0.5});
  const double stress = all.pull(-0.05, 1.0);
  EXPECT_EQ(tension.pull(-0.05, 1.0), stress) << "only failure changes";
  half.pull(-0.05, 1.0);
  EXPECT_LT(tension.failure_energy_j_per_m3(), 0.2 * all.failure_energy_j_per_m3());
  EXPECT_GT(tension.failure_energy_j_per_m3(), 0.0);
  EXPECT_NEAR(half.failure_energy_j_per_m3(), 0.5 * (all.failure_energy_j_per_m3() + tension.failure_energy_j_per_m3()),
              1e-6 * all.failure_energy_j_per_m3());
  all.pull(0.05, 1.0);
  tension.pull(0.05, 1.0);
  EXPECT_GT(tension.failure_energy_j_per_m3(), 0.8 * all.failure_energy_j_per_m3());
  EXPECT_LE(tension.failure_energy_j_per_m3(), all.failure_energy_j_per_m3());
}

TEST(Eigenstrain, OfAFreePointStressesNothing) {
  for (const double eigenstrain : {-0.02, 0.01}) {
    const PointResponse response =
        once(eigenstrain * Matrix2d::Identity(), {.lame = kLame, .eigenstrain = eigenstrain});
    EXPECT_LT(response.stress_pa.norm(), 1e-6);
    EXPECT_NEAR(response.failure_energy_j_per_m3, 0.0, 1e-6);
  }
}

TEST(Shares, FadeFromTheirPhaseToTheInterface) {
  EXPECT_EQ(rigid_share(1.0), 1.0);
  EXPECT_EQ(rigid_share(0.5), 0.0);
  EXPECT_EQ(soft_share(0.0), 1.0);
  EXPECT_EQ(soft_share(0.5), 0.0);
  const LawExtensions extensions{.yield_pa = 2e7, .inverse_limit = 2.0, .shrinkage = 0.01};
  const ExtendedLaw interface = extended_law(extensions, kLame, 1e6, 0.5),
                    rigid = extended_law(extensions, kLame, 1e6, 1.0);
  EXPECT_TRUE(std::isinf(interface.yield_pa));
  EXPECT_EQ(interface.inverse_limit, 0.0);
  EXPECT_EQ(rigid.yield_pa, 2e7);
  EXPECT_EQ(rigid.eigenstrain, -0.01);
  EXPECT_EQ(interface.eigenstrain, -0.005);
}

TEST(StiffestTangent, IsThatOfTheBaseLawWithoutExtensionsAndBoundsTheGentLaw) {
  ExtendedLaw law{.lame = lame_from_engineering(16e6, 0.45)};
  EXPECT_EQ(stiffest_tangent_pa(law, 1e6), law.lame.lambda_pa + 2.0 * law.lame.mu_pa);
  law.inverse_limit = 2.0;
  const double threshold = 4e5, bound = stiffest_tangent_pa(law, threshold);
  PulledBar bar(law);
  double last = 0.0;
  for (double strain = 1e-3; bar.failure_energy_j_per_m3() < threshold; strain += 1e-3) {
    const double stress = bar.pull(strain, 1.0);
    EXPECT_LT((stress - last) / 1e-3, bound);
    last = stress;
  }
  EXPECT_LT(bound, 400.0 * law.lame.mu_pa);
}

}  // namespace
}  // namespace nacre::material
