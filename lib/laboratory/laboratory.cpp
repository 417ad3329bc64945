#include "laboratory/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "laboratory/fracture_bench.hpp"
#include "laboratory/hidden_coupon.hpp"
#include "laboratory/modulus_bench.hpp"
#include "laboratory/specimen_raster.hpp"
#include "laboratory/temperature.hpp"
#include "material/neo_hookean.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/rounded.hpp"
#include "measurement/specimen_checks.hpp"
#include "tester/fidelity.hpp"
#include "thesis/constants.hpp"

namespace nacre::laboratory {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

constexpr int kCurvePoints = 200;
/// Duration of the ramp before a strain is held, s.
constexpr double kRampS = 0.2;
/// Unnotched coupons are pulled until they have taken up this share of the energy W at which they begin to break: 0.85
/// of that strain in an elastic one, so that what flows before is seen.
constexpr double kCouponEnergy = 0.72;

Making making_of(const Experiment& experiment, int specimen = 0) {
  const double shift = rate_shift(experiment.temperature_c.value_or(kReferenceC));
  return {.orientation_deg = experiment.conditions.orientation_deg,
          .thickness_mm = experiment.conditions.thickness_mm,
          .strain_rate_per_s = experiment.conditions.strain_rate_per_s * shift,
          .held_s = experiment.hold_s.value_or(0.0) / shift,
          .ramp_s = experiment.hold_s ? kRampS / shift : 0.0,
          .pull_rate_per_s = thesis::kSimulatedStrainRate * tester::loading_rate_scale(experiment.fidelity),
          .specimen = specimen};
}

/// The truth as homogeneous specimens show it: with the constants of their own materials.
Truth as_coupons(Truth truth) {
  truth.modulus.e_tb_pa *= truth.coupons.soft;
  truth.modulus.e_vw_pa *= truth.coupons.rigid;
  truth.modulus.e_if_pa *= truth.coupons.interface;
  return truth;
}

Result<TrueResponse> respond_modulus(const Truth& truth, const Experiment& experiment) {
  if (const pattern::Mixture* mixture = experiment.design.mixture()) {
    return TrueResponse{
        .modulus_pa = homogeneous_modulus(as_coupons(truth), mixture->rigid_fraction, making_of(experiment)),
        .curve = {},
        .remark = {}};
  }
  const SpecimenSize size = specimen_size(TestKind::modulus, experiment.fidelity);
  const Result<double> modulus_pa =
      pull_elastically(modulus_raster(truth, experiment.design, making_of(experiment), size));
  if (!modulus_pa) return tl::unexpected(modulus_pa.error());
  return TrueResponse{.modulus_pa = *modulus_pa, .curve = {}, .remark = {}};
}

Result<PulledSpecimen> pulled(const Truth& truth, const Experiment& experiment, int specimen) {
  const SpecimenSize size = specimen_size(TestKind::toughness, experiment.fidelity, truth.effects);
  const Making making = making_of(experiment, specimen);
  const Raster raster = fracture_raster(truth, experiment.design, making, size);
  return pull_to_separation(
      raster, {.gamma_per_s = truth.toughness.gamma_per_s,
               .strain_rate_per_s = making.pull_rate_per_s,
               .strain_limit = raster.all_soft ? thesis::kSoftStrainLimit.value : thesis::kStrainLimit.value});
}

Result<TrueResponse> respond_toughness(const Truth& truth, const Experiment& experiment) {
  const int asked = experiment.specimens > 0 ? experiment.specimens : truth.replicates;
  const int count = variation_of_strength(truth) > 0.0 ? asked : 1;
  std::vector<Result<PulledSpecimen>> specimens(count);
  parallel_for(count, [&](int i) { specimens[i] = pulled(truth, experiment, i); });
  TrueResponse response;
  for (int i = 0; i < count; ++i) {
    const Result<PulledSpecimen>& one = specimens[i];
    if (!one) return fail("fracture bench: {}", one.error().message);
    const tester::Curve curve = tester::resampled(one->curve, kCurvePoints);
    if (i > 0) {
      response.other_curves.push_back(curve);
      continue;
    }
    response.curve = curve;
    if (!one->separated) response.remark = fmt::format("not separated at strain {:.2f}", one->curve.strain.back());
  }
  return response;
}

/// Whether a coupon's curve is more than the closed form of its elastic law.
bool hides_a_curve(const HiddenEffects& effects) {
  return effects.rigid_yield_pa > 0.0 || effects.soft_stiffening_limit > 0.0 || effects.rate_overstress > 0.0 ||
         effects.soft_overstress > 0.0 || effects.rate_exponent > 0.0 || effects.two_overstresses > 0.0 ||
         effects.progressive_damage > 0.0 || effects.drawn_out_damage > 0.0;
}

/// Strain between points of a curve along a programme.
double strain_step(const tester::Loading& loading) {
  double way = 0.0, last = 0.0;
  for (const double turn : loading.turns) way += std::abs(turn - std::exchange(last, turn));
  return way / (kCurvePoints - 1);
}

/// A warm material relaxes in less time.
tester::Loading at_temperature(tester::Loading loading, double temperature_c) {
  const double shift = rate_shift(temperature_c);
  for (double& hold_s : loading.holds_s) hold_s /= shift;
  if (loading.dwell_s) *loading.dwell_s /= shift;
  return loading;
}

/// Where a coupon's curve is read: up to most of what it bears, or along the way that was ordered.
std::vector<double> coupon_strains(const Truth& truth, const Experiment& experiment, double rigid_fraction) {
  tester::Loading loading = experiment.loading;
  if (loading.turns.empty()) loading = {{coupon_strain(truth, rigid_fraction, making_of(experiment), kCouponEnergy)}};
  return tester::strain_path(loading, strain_step(loading));
}

Result<TrueResponse> respond_tensile(const Truth& in_layouts, const Experiment& experiment) {
  const pattern::Mixture* mixture = experiment.design.mixture();
  if (!mixture) return fail("an unnotched coupon is homogeneous, expected rigid, soft, interface or mix:F");
  const Truth truth = as_coupons(in_layouts);
  TrueResponse response;
  if (experiment.loading.has_pauses()) {
    response.curve = paused_curve(truth, mixture->rigid_fraction, making_of(experiment),
                                  at_temperature(experiment.loading, experiment.temperature_c.value_or(kReferenceC)),
                                  strain_step(experiment.loading));
    return response;
  }
  const std::vector<double> strains = coupon_strains(truth, experiment, mixture->rigid_fraction);
  if (hides_a_curve(truth.effects)) {
    response.curve = coupon_curve(truth, mixture->rigid_fraction, making_of(experiment), strains);
    return response;
  }
  const material::Lame lame = homogeneous_lame(truth, mixture->rigid_fraction, making_of(experiment));
  for (const double strain : strains) {
    response.curve.strain.push_back(strain);
    response.curve.stress_pa.push_back(material::uniaxial_stress(strain, lame).nominal_stress_pa);
  }
  return response;
}

/// exp(N(0, sd)): a factor with median 1.
double lognormal(RandomStream& stream, double sd) { return std::exp(sd * stream.normal()); }

/// How this specimen differs from the average one.
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

/// What single readings of one piece scatter, of the scatter between pieces: its size is measured once.
constexpr double kReadingShare = 0.2;

double reading_scatter(const Truth& truth, const std::string& specimen) {
  RandomStream reading(truth.seed, fmt::format("specimen/{}/{}", specimen, "reading"));
  return lognormal(reading, kReadingShare * truth.noise.modulus);
}

/// Recorded stress over true stress: the load cell, and the cross-section by the calipers.
double stress_gain(const HiddenEffects& effects, double thickness_mm) {
  return (1.0 + effects.load_cell_gain) * (thickness_mm / (thickness_mm + effects.thickness_error_mm));
}

/// A modulus as it is recorded: load train and gain.
double recorded_modulus(const HiddenEffects& effects, double gain, double modulus_pa) {
  return effects.machine_compliance_per_pa == 0.0 ? gain * modulus_pa
                                                  : gain / (1.0 / modulus_pa + effects.machine_compliance_per_pa);
}

/// A specimen's curve as it is recorded: slack, then the load train's stretch added to the specimen's, the gain.
tester::Curve recorded_curve(const HiddenEffects& effects, double gain, const tester::Curve& curve) {
  tester::Curve recorded;
  if (effects.toe_slack > 0.0) {
    recorded.strain.push_back(0.0);
    recorded.stress_pa.push_back(0.0);
  }
  for (std::size_t i = 0; i < curve.size(); ++i) {
    recorded.strain.push_back(curve.strain[i] + effects.toe_slack +
                              effects.machine_compliance_per_pa * curve.stress_pa[i]);
    recorded.stress_pa.push_back(gain * curve.stress_pa[i]);
  }
  return recorded;
}

/// How many batches came before: the number at the end of its name, less that of the first one; 0 without a number.
/// Batches of a game are called by their rounds, which begin at 0; others are counted from 1.
int batch_step(const std::string& batch) {
  const std::size_t digits = batch.find_last_not_of("0123456789") + 1;
  const int first = batch.starts_with("round-") ? 0 : 1;
  const Result<int> number = integer_from_text(std::string_view(batch).substr(digits));
  return number ? std::max(0, *number - first) : 0;
}

/// How far stiffness and stress have drifted where a specimen was printed.
double drift_of(const HiddenEffects& effects, const SpecimenRecord& record) {
  double drift = 1.0;
  if (effects.batch_drift != 0.0) drift *= std::pow(1.0 + effects.batch_drift, batch_step(record.batch));
  if (effects.order_drift != 0.0) drift *= std::pow(1.0 + effects.order_drift, record.print_order / 100.0);
  return drift;
}

/// The effects on one of two machines, whose own differences are part of compliance and gain there.
HiddenEffects on_machine(HiddenEffects effects, bool is_second) {
  const double further = effects.compliance_of_one_machine_per_pa;
  if (is_second == (further > 0.0)) effects.machine_compliance_per_pa += std::abs(further);
  if (is_second) effects.load_cell_gain = (1.0 + effects.load_cell_gain) * (1.0 + effects.gain_of_one_machine) - 1.0;
  return effects;
}

/// What speaks against holding the strain of a specimen; or nothing.
std::string fault_of_hold(const Truth& truth, const Experiment& experiment) {
  if (!experiment.hold_s) return "";
  if (experiment.test != TestKind::modulus || !experiment.design.mixture())
    return "strain is held in modulus tests of homogeneous materials alone";
  if (!(*experiment.hold_s >= 2.0 * kRampS))
    return fmt::format("a hold of {} s, expected at least {}: the ramp takes {}", *experiment.hold_s, 2.0 * kRampS,
                       kRampS);
  const double soft = truth.effects.rate_exponent, rigid = soft * truth.effects.rate_exponent_ratio;
  if (!(std::max(soft, rigid) < 1.0)) return "a power law of the rate with an exponent of 1 or more does not relax";
  return "";
}

/// The curve of replicate `number` among those that were pulled.
const tester::Curve& curve_of(const TrueResponse& response, int number) {
  const auto which = static_cast<std::size_t>(std::max(0, number - 1)) % (response.other_curves.size() + 1);
  return which == 0 ? response.curve : response.other_curves[which - 1];
}

Scatter scatter_of_piece(const Truth& truth, const Replicate& replicate) {
  return scatter_of(truth, replicate.piece.empty() ? replicate.specimen : replicate.piece);
}

/// Of a coupon whose machine turns, holds and goes on at strains that it records: a piece whose record is longer than
/// its strain is pulled less far. Other tests respond alike for all replicates.
std::optional<Result<TrueResponse>> own_response(const Truth& truth, const Experiment& experiment,
                                                 const Replicate& replicate) {
  if (experiment.test != TestKind::tensile || experiment.loading.turns.empty()) return std::nullopt;
  Experiment own = experiment;
  const double recorded = scatter_of_piece(truth, replicate).strain;
  for (double& turn : own.loading.turns) turn /= recorded;
  return respond_tensile(truth, own);
}

void fill_in(SpecimenRecord& record, const Truth& truth, const TrueResponse& response, const Replicate& replicate) {
  Scatter scatter = scatter_of_piece(truth, replicate);
  if (!replicate.piece.empty()) scatter.modulus *= reading_scatter(truth, record.specimen);
  const HiddenEffects effects = on_machine(truth.effects, replicate.on_second_machine);
  const double drift = drift_of(effects, record);
  scatter.modulus *= drift;
  scatter.stress *= drift;
  const double gain = stress_gain(effects, record.conditions.thickness_mm);
  if (record.test == TestKind::modulus) {
    record.modulus_pa = recorded_modulus(effects, gain, scatter.modulus * response.modulus_pa);
    return;
  }
  const double stress = record.test == TestKind::tensile ? scatter.modulus : scatter.stress;
  tester::Curve curve = curve_of(response, replicate.number);
  for (double& value : curve.strain) value *= scatter.strain;
  for (double& value : curve.stress_pa) value *= stress;
  record.curve = recorded_curve(effects, gain, curve);
  if (record.test == TestKind::toughness) record.toughness_pa = tester::area_under(record.curve);
}

}  // namespace

Result<TrueResponse> respond(const Truth& truth, const Experiment& experiment) {
  if (experiment.test != TestKind::tensile && !experiment.loading.turns.empty())
    return fail("loading \"{}\": only unnotched coupons are unloaded here", tester::to_string(experiment.loading));
  const double temperature_c = experiment.temperature_c.value_or(kReferenceC);
  if (!(temperature_c >= kColdestC && temperature_c <= kHottestC))
    return fail("temperature {} C, expected {} to {}", temperature_c, kColdestC, kHottestC);
  if (experiment.test == TestKind::toughness && temperature_c != kReferenceC)
    return fail("a fracture test at {} C, expected {}: how materials break there is not modelled", temperature_c,
                kReferenceC);
  if (const std::string fault = fault_of_hold(truth, experiment); !fault.empty()) return fail("{}", fault);
  const double orientation = experiment.conditions.orientation_deg;
  if (orientation != 0.0 && orientation != 90.0) return fail("orientation {} degrees, expected 0 or 90", orientation);
  switch (experiment.test) {
    case TestKind::modulus:
      return respond_modulus(truth, experiment);
    case TestKind::toughness:
      return respond_toughness(truth, experiment);
    case TestKind::tensile:
      return respond_tensile(truth, experiment);
  }
  return fail("an unknown test");
}

std::vector<Result<TrueResponse>> responses_to(const Truth& truth, const std::vector<Experiment>& experiments,
                                               const std::function<void(std::size_t)>& done) {
  std::vector<Result<TrueResponse>> responses(experiments.size());
  std::mutex mutex;
  parallel_for(static_cast<int>(experiments.size()), [&](int i) {
    responses[i] = respond(truth, experiments[i]);
    const std::lock_guard lock(mutex);
    if (done) done(static_cast<std::size_t>(i));
  });
  return responses;
}

SpecimenRecord record_specimen(const Truth& truth, const Experiment& experiment, const Result<TrueResponse>& response,
                               const Replicate& replicate) {
  SpecimenRecord record;
  record.specimen = replicate.specimen;
  record.design = experiment.design;
  record.test = experiment.test;
  record.conditions = experiment.conditions;
  record.batch = replicate.batch;
  record.print_order = replicate.print_order;
  if (experiment.temperature_c) record.other_columns["temperature_c"] = fmt::format("{:g}", *experiment.temperature_c);
  if (experiment.hold_s) {
    record.conditions.strain_rate_per_s = measurement::rounded(measurement::rate_of_hold(*experiment.hold_s), 6);
    record.other_columns["hold_s"] = fmt::format("{:g}", *experiment.hold_s);
  }
  if (experiment.loading.has_pauses()) record.other_columns["loading"] = tester::to_string(experiment.loading);
  if (!replicate.piece.empty()) record.other_columns["sample"] = replicate.piece;
  if (!replicate.machine.empty()) record.other_columns["machine"] = replicate.machine;
  std::optional<Result<TrueResponse>> own;
  if (response) own = own_response(truth, experiment, replicate);
  const Result<TrueResponse>& shown = own ? *own : response;
  record.valid = shown.has_value();
  record.note = shown ? shown->remark : shown.error().message;
  if (!shown) return record;
  fill_in(record, truth, *shown, replicate);
  // A laboratory reports no value that no game can use: the specimen failed.
  if (const auto fault = measurement::why_unusable(record)) {
    record.valid = false;
    record.note = fmt::format("{} {}", fault->column, fault->reason);
  }
  return record;
}

}  // namespace nacre::laboratory
