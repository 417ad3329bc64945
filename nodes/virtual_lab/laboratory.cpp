#include "virtual_lab/laboratory.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "material/neo_hookean.hpp"
#include "tester/fidelity.hpp"
#include "thesis/constants.hpp"
#include "virtual_lab/fracture_bench.hpp"
#include "virtual_lab/modulus_bench.hpp"
#include "virtual_lab/specimen_raster.hpp"

namespace nacre::virtual_laboratory {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

constexpr int kCurvePoints = 200;
constexpr double kCouponStrain = 0.02;  // unnotched coupons are pulled to here, well before they break

Result<Response> respond_modulus(const Truth& truth, const Question& question) {
  if (const pattern::Mixture* mixture = question.design.mixture()) {
    return Response{.modulus_pa = homogeneous_modulus(truth, mixture->rigid_fraction), .curve = {}, .remark = {}};
  }
  const SpecimenSize size = specimen_size(TestKind::modulus, question.fidelity);
  const Result<double> modulus_pa =
      pull_elastically(modulus_raster(truth, question.design, question.conditions.orientation_deg, size));
  if (!modulus_pa) return tl::unexpected(modulus_pa.error());
  return Response{.modulus_pa = *modulus_pa, .curve = {}, .remark = {}};
}

Result<Response> respond_toughness(const Truth& truth, const Question& question) {
  const SpecimenSize size = specimen_size(TestKind::toughness, question.fidelity);
  const Raster raster = fracture_raster(truth, question.design, question.conditions.orientation_deg, size);
  const Result<PulledSpecimen> pulled = pull_to_separation(
      raster, {.gamma_per_s = truth.toughness.gamma_per_s,
               .strain_rate_per_s = thesis::kSimulatedStrainRate * tester::loading_rate_scale(question.fidelity),
               .strain_limit = raster.all_soft ? thesis::kSoftStrainLimit.value : thesis::kStrainLimit.value});
  if (!pulled) return fail("fracture bench: {}", pulled.error().message);
  return Response{
      .modulus_pa = 0.0,
      .curve = tester::resampled(pulled->curve, kCurvePoints),
      .remark = pulled->separated ? "" : fmt::format("not separated at strain {:.2f}", pulled->curve.strain.back())};
}

Result<Response> respond_tensile(const Truth& truth, const Question& question) {
  const pattern::Mixture* mixture = question.design.mixture();
  if (!mixture) return fail("an unnotched coupon is homogeneous, expected rigid, soft, interface or mix:F");
  const material::Lame lame = homogeneous_lame(truth, mixture->rigid_fraction);
  Response response;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double strain = kCouponStrain * i / (kCurvePoints - 1);
    response.curve.strain.push_back(strain);
    response.curve.stress_pa.push_back(material::uniaxial_stress(strain, lame).nominal_stress_pa);
  }
  return response;
}

/// exp(N(0, sd)): a factor with median 1.
double lognormal(RandomStream& stream, double sd) { return std::exp(sd * stream.normal()); }

/// How this specimen differs from the truth's average one.
struct Scatter {
  double modulus = 1.0, stress = 1.0, strain = 1.0;
};

Scatter scatter_of(const Truth& truth, const std::string& specimen) {
  const auto stream = [&](const char* what) {
    return RandomStream(truth.seed, fmt::format("specimen/{}/{}", specimen, what));
  };
  RandomStream modulus = stream("modulus"), stress = stream("stress"), strain = stream("strain");
  // T scatters as stress times strain: the stress carries what the strain leaves of the declared scatter of T.
  const double rest = truth.noise.toughness * truth.noise.toughness - truth.noise.strain * truth.noise.strain;
  return {.modulus = lognormal(modulus, truth.noise.modulus),
          .stress = lognormal(stress, std::sqrt(std::max(0.0, rest))),
          .strain = lognormal(strain, truth.noise.strain)};
}

/// A modulus as the machine shows it: load cell and load train.
double shown_modulus(const HiddenEffects& effects, double modulus_pa) {
  const double gain = 1.0 + effects.load_cell_gain;
  return effects.machine_compliance_per_pa == 0.0 ? gain * modulus_pa
                                                  : gain / (1.0 / modulus_pa + effects.machine_compliance_per_pa);
}

/// A specimen's curve as the machine shows it: slack, then the load train's stretch added to the specimen's, the load
/// cell's gain.
tester::Curve shown_curve(const HiddenEffects& effects, const tester::Curve& curve) {
  tester::Curve shown;
  if (effects.toe_slack > 0.0) {
    shown.strain.push_back(0.0);
    shown.stress_pa.push_back(0.0);
  }
  for (std::size_t i = 0; i < curve.size(); ++i) {
    shown.strain.push_back(curve.strain[i] + effects.toe_slack +
                           effects.machine_compliance_per_pa * curve.stress_pa[i]);
    shown.stress_pa.push_back((1.0 + effects.load_cell_gain) * curve.stress_pa[i]);
  }
  return shown;
}

void fill_in(SpecimenRecord& record, const Truth& truth, const Response& response) {
  const Scatter scatter = scatter_of(truth, record.specimen);
  if (record.test == TestKind::modulus) {
    record.modulus_pa = shown_modulus(truth.effects, scatter.modulus * response.modulus_pa);
    return;
  }
  const double stress = record.test == TestKind::tensile ? scatter.modulus : scatter.stress;
  tester::Curve curve = response.curve;
  for (double& value : curve.strain) value *= scatter.strain;
  for (double& value : curve.stress_pa) value *= stress;
  record.curve = shown_curve(truth.effects, curve);
  if (record.test == TestKind::toughness) record.toughness_pa = tester::area_under(record.curve);
}

}  // namespace

Result<Response> respond(const Truth& truth, const Question& question) {
  const double orientation = question.conditions.orientation_deg;
  if (orientation != 0.0 && orientation != 90.0) return fail("orientation {} degrees, expected 0 or 90", orientation);
  switch (question.test) {
    case TestKind::modulus:
      return respond_modulus(truth, question);
    case TestKind::toughness:
      return respond_toughness(truth, question);
    case TestKind::tensile:
      return respond_tensile(truth, question);
  }
  return fail("an unknown test");
}

SpecimenRecord record_specimen(const Truth& truth, const Question& question, const Result<Response>& response,
                               const Replicate& replicate) {
  SpecimenRecord record;
  record.specimen = replicate.specimen;
  record.design = question.design;
  record.test = question.test;
  record.conditions = question.conditions;
  record.batch = replicate.batch;
  record.print_order = replicate.print_order;
  record.valid = response.has_value();
  record.note = response ? response->remark : response.error().message;
  if (response) fill_in(record, truth, *response);
  return record;
}

}  // namespace nacre::virtual_laboratory
