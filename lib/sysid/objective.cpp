#include "sysid/objective.hpp"

#include <cmath>

namespace nacre::sysid {
namespace {

/// Weighted mean of misfit(i) over the designs for which counted(i) holds; 0 when there is none.
template <class Counted, class Misfit>
double weighted_mean(const std::vector<double>& weights, std::size_t count, Counted counted, Misfit misfit) {
  double sum = 0.0, weight_sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!counted(i)) continue;
    sum += weights[i] * misfit(i);
    weight_sum += weights[i];
  }
  return weight_sum > 0.0 ? sum / weight_sum : 0.0;
}

}  // namespace

Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::PrintContext& context) {
  Prediction shown = prediction;
  if (shown.modulus_pa) shown.modulus_pa = measurement::observe_modulus(*shown.modulus_pa, extensions, context);
  if (shown.curve.empty()) return shown;
  shown.curve = measurement::observe_curve(prediction.curve, extensions, context);
  // As a difference, so that a toughness that was not computed from these very points keeps its value without
  // extensions.
  if (shown.toughness_pa && shown.curve != prediction.curve) {
    *shown.toughness_pa += tester::area_under(shown.curve) - tester::area_under(prediction.curve);
  }
  return shown;
}

Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::Replicates& measured) {
  Prediction shown =
      observed(prediction, extensions, measurement::PrintContext{.batch_step = measured.toughness_batch_step});
  if (prediction.modulus_pa)
    shown.modulus_pa =
        measurement::observe_modulus(*prediction.modulus_pa, extensions, {.batch_step = measured.modulus_batch_step});
  return shown;
}

double relative_error(const std::optional<double>& simulated, double measured) {
  return simulated ? std::abs(*simulated - measured) / measured : 1.0;
}

double toughness_misfit(const measurement::Replicates& measured, const Prediction& prediction) {
  const double error = relative_error(prediction.toughness_pa, measured.toughness_pa);
  if (measured.representative_curve.empty()) return error;
  const tester::Curve curve = forward_part(measured.representative_curve);
  if (!prediction.toughness_pa) return error + tester::area_under(curve) / measured.toughness_pa;
  if (prediction.curve.empty()) return error;
  return error + tester::area_between(forward_part(prediction.curve), curve) / measured.toughness_pa;
}

double modulus_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                         const std::vector<Prediction>& predictions) {
  return weighted_mean(
      weights, measured.size(), [&](std::size_t i) { return measured[i].modulus_count > 0; },
      [&](std::size_t i) { return relative_error(predictions[i].modulus_pa, measured[i].modulus_pa); });
}

double toughness_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                           const std::vector<Prediction>& predictions) {
  return weighted_mean(
      weights, measured.size(), [&](std::size_t i) { return measured[i].toughness_count > 0; },
      [&](std::size_t i) { return toughness_misfit(measured[i], predictions[i]); });
}

}  // namespace nacre::sysid
