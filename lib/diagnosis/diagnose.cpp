#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/result.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/experiments.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {
namespace {

constexpr int kLeastGroups = 8;
constexpr int kNextExperiments = 4;
/// Size of an effect, as a share of its range, at which it is asked whether these data could show it.
constexpr int kTypicalSize = 2;  // index of 0.3 among the sizes of a signature
/// Signal-to-noise below which one effect cannot be told from none with 5 % error.
constexpr double kVisibleSignal = 3.8;
constexpr double kInvisibleAbsorption = 0.95;

bool holds(const std::vector<Fit>& fits, const std::string& effect) {
  return std::any_of(fits.begin(), fits.end(), [&](const Fit& f) { return std::find(f.effects.begin(), f.effects.end(), effect) != f.effects.end(); });
}

Candidate candidate_of(const Evidence& evidence, const Decision& decision, std::size_t k) {
  const Fit& single = evidence.singles[k];
  const SignatureSize typical = signature_size(evidence.base.fit, evidence.base.signatures[k].changes[kTypicalSize], Whitener(evidence.observations.covariance()));
  Candidate candidate;
  candidate.name = evidence.effects[k];
  candidate.statistic = evidence.base.fit.chi2 - single.chi2;
  candidate.p_family_wise = decision.p_family_wise[k];
  candidate.p_fit = decision.p_fit[k];
  candidate.absorption = typical.absorption();
  candidate.signal_to_noise = typical.projected;
  candidate.parameter = single.parameters.extensions.at(candidate.name).front();
  const bool visible = typical.projected >= kVisibleSignal && typical.absorption() <= kInvisibleAbsorption;
  const bool noticed = candidate.p_family_wise <= evidence.settings.name_level;
  candidate.status = holds(decision.possible, candidate.name) ? "in_set" : visible || noticed ? "excluded" : "invisible";
  return candidate;
}

/// 90 % interval from the local covariance; Student's factor for the degrees of freedom of the replicate scatter.
std::vector<NamedEffect> named_effects(const Evidence& evidence, const Fit& fit) {
  const CoordinateMap map(fit.effects);
  const Whitener whitener(evidence.observations.covariance());
  const int dof = evidence.observations.replicate_dof;
  const double student = dof > 0 ? 1.645 * (1.0 + 0.93 / dof) : 2.0;  // Cornish-Fisher, within 1 % from 4 degrees of freedom on
  std::vector<NamedEffect> named;
  int coordinate = kBaseCount;
  for (const std::string& name : fit.effects) {
    const material::Effect& effect = *material::find_effect(name);
    const double scale = map.scale(coordinate - kBaseCount);
    const double value = map.value(coordinate, fit.u[coordinate]);
    const double half = student * std::sqrt(fit.variance(coordinate, whitener)) * scale;
    named.push_back({name, std::string(effect.family), value, value - half, value + half, std::string(effect.parameters.front().unit)});
    coordinate += static_cast<int>(effect.parameters.size());
  }
  return named;
}

std::string names_of(const std::vector<Fit>& fits) {
  std::string text;
  for (const Fit& fit : fits) {
    if (!text.empty()) text += ", or ";
    text += fmt::format("{}", fmt::join(fit.effects, " with "));
  }
  return text;
}

std::string summary_of(const Diagnosis& d, const Decision& decision) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return fmt::format("Nothing is wrong beyond noise: {} (chance of a misfit as large: {:.3f}).", decision.reason, d.p_misfit);
    case Verdict::named: {
      std::string text = "The simulation lacks ";
      for (std::size_t i = 0; i < d.effects.size(); ++i) {
        const NamedEffect& e = d.effects[i];
        text += fmt::format("{}{} = {:.3g} {} (90 % interval {:.3g} to {:.3g})", i ? " and " : "", e.name, e.parameter, e.unit, e.interval_low, e.interval_high);
      }
      text += fmt::format(": {}.", decision.reason);
      if (d.gain) {
        text += fmt::format(" On held-out patterns the error of log E falls from {:.3f} to {:.3f} ({:.0f} % less, 90 % interval {:.0f} to {:.0f} %).", d.gain->held_out_error_before,
                            d.gain->held_out_error_after, 100 * d.gain->relative_reduction, 100 * d.gain->interval_low, 100 * d.gain->interval_high);
      }
      return text;
    }
    case Verdict::ambiguous:
      return fmt::format("Something is wrong, and these data cannot tell which: {}. The next experiments would separate them.", names_of(decision.possible));
    case Verdict::unexplained: break;
  }
  std::string text = fmt::format("Something is wrong that no effect of the library explains: {}.", decision.reason);
  if (!d.contrasts.empty()) {
    text += fmt::format(" The residuals line up most with: {} ({:.1f} standard deviations).", d.contrasts.front().name, d.contrasts.front().statistic);
  }
  return text;
}

std::vector<ResidualRow> residual_rows(const Observations& observations, const Fit& base, const Fit& extended) {
  const Eigen::VectorXd variances = observations.covariance().diagonal();
  const auto with_numerics = [&](const Fit& fit) -> Eigen::VectorXd {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(observations.size()));
    std::iota(all.begin(), all.end(), 0);
    return fit.predicted + observations.shared_numerics(observations.log_moduli() - fit.predicted, all);
  };
  const Eigen::VectorXd base_log = with_numerics(base), extended_log = with_numerics(extended);
  std::vector<ResidualRow> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const Observation& g = observations.groups[static_cast<std::size_t>(i)];
    rows.push_back({g.design.name(), g.conditions.orientation_deg, std::exp(g.log_modulus), std::exp(base_log[i]), std::exp(extended_log[i]), std::sqrt(variances[i])});
  }
  return rows;
}

/// Models that the next test should separate: the rivals left, or what an unexplained misfit comes nearest to.
std::vector<Fit> models_to_separate(const Evidence& evidence, const Decision& decision) {
  if (decision.verdict == Verdict::ambiguous) return decision.possible;
  if (decision.verdict != Verdict::unexplained) return {};
  std::vector<Fit> models = evidence.singles;
  models.push_back(evidence.base.fit);
  return models;
}

/// Drop of chi2 that chance alone exceeds with the level of a name.
double needed_drop(const Evidence& evidence) {
  std::vector<double> drops;
  for (const DrawStatistics& draw : evidence.base_draws) drops.push_back(draw.largest_drop());
  std::sort(drops.begin(), drops.end());
  return drops[static_cast<std::size_t>((1.0 - evidence.settings.name_level) * static_cast<double>(drops.size() - 1))];
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::base_sufficient: return "base_sufficient";
    case Verdict::named: return "named";
    case Verdict::ambiguous: return "ambiguous";
    case Verdict::unexplained: break;
  }
  return "unexplained";
}

Diagnosis diagnose_modulus(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  const Observations measured = observe_moduli(specimens, settings.floor.log_modulus_sd);
  if (measured.size() < kLeastGroups) {
    throw InputError::format("a diagnosis of the modulus needs at least {} designs with a valid modulus, there are {}", kLeastGroups, measured.size());
  }
  if (settings.bootstraps * settings.name_level < 2.0) {
    throw InputError::format("{} bootstraps cannot reach the level {} of a name, expected at least {:.0f}", settings.bootstraps, settings.name_level,
                             std::ceil(2.0 / settings.name_level));
  }
  const ModulusModel model(measured.groups, settings.fidelity);
  const Evidence evidence = gather_evidence(model, measured, settings);
  const Observations& observations = evidence.observations;
  const Decision decision = decide(evidence);

  Diagnosis diagnosis;
  diagnosis.verdict = decision.verdict;
  diagnosis.p_misfit = decision.p_misfit;
  diagnosis.contrasts = decision.contrasts;
  diagnosis.replicate_sd = observations.replicate_sd;
  diagnosis.numerics_sd = observations.numerics_sd;
  diagnosis.numerics_shared_sd = observations.numerics_shared.norm() / std::sqrt(observations.size());
  diagnosis.noise_known = observations.replicate_dof > 0;
  diagnosis.base_fit = evidence.base.fit.parameters.modulus;
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) diagnosis.candidates.push_back(candidate_of(evidence, decision, k));
  const Fit& extended = !decision.possible.empty() ? decision.possible.front() : decision.partial ? *decision.partial : evidence.base.fit;
  diagnosis.extended_fit = extended.parameters;
  diagnosis.residuals = residual_rows(observations, evidence.base.fit, extended);
  if (decision.verdict == Verdict::named) {
    diagnosis.effects = named_effects(evidence, extended);
    std::vector<Fit> models = evidence.singles;
    if (extended.effects.size() > 1) models.push_back(extended);
    diagnosis.gain = held_out_gain(observations, evidence.base.fit, models, needed_drop(evidence), settings.seed);
  }
  if (settings.progress) settings.progress(0.95, "choosing the next experiments");
  diagnosis.next_experiments = next_experiments(models_to_separate(evidence, decision), observations, settings.fidelity, kNextExperiments);
  diagnosis.summary = summary_of(diagnosis, decision);
  if (!diagnosis.noise_known) diagnosis.summary += " There are no replicates: a scatter of 2 % was assumed, and every statement is relative to it.";
  if (settings.progress) settings.progress(1.0, "done");
  return diagnosis;
}

}  // namespace nacre::diagnosis
