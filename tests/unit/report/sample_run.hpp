#pragma once
// A run's record as a game would leave it after `last_round` rounds, made up but plausible: E grows with the rigid
// fraction, T falls, the model is wrong in round 0 and less so in every later round.

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "run/run_record.hpp"

namespace nacre::report::sample {

inline optimize::Performance true_performance(const pattern::Pattern& pattern) {
  RandomStream own(pattern.bits(), "truth");
  const double f = pattern.rigid_fraction();
  return {(0.35 + 4.2 * (f - 0.5)) * (1.0 + 0.12 * own.normal()) * 1e9,
          (0.52 - 0.75 * (f - 0.5)) * std::exp(0.3 * own.normal()) * 1e6};
}

inline optimize::Performance predicted(const pattern::Pattern& pattern, int model) {
  RandomStream own(pattern.bits(), "model " + std::to_string(model));
  const double error = 0.5 / (model + 1.0);
  const optimize::Performance truth = true_performance(pattern);
  return {truth.modulus_pa * (1.0 + 0.3 * error * own.normal()),
          truth.toughness_pa * (1.0 + error * (0.5 + own.uniform()))};
}

/// Rises, yields, breaks at `failure`, with the area T.
inline tester::Curve curve(const optimize::Performance& p, double failure) {
  tester::Curve curve;
  for (int i = 0; i <= 60; ++i) {
    const double x = i / 60.0;
    curve.strain.push_back(failure * x);
    curve.stress_pa.push_back(x < 0.85 ? 1.0 - std::exp(-5.0 * x) : (1.0 - x) / 0.15);
  }
  const double area = tester::area_under(curve);
  for (double& stress : curve.stress_pa) stress *= p.toughness_pa / area;
  return curve;
}

inline run::MeasuredSpecimen specimen(const pattern::Design& design, const optimize::Performance& truth,
                                      tester::TestKind test, int round, int replicate) {
  RandomStream own(static_cast<std::uint64_t>(replicate), design.name() + std::string(tester::to_string(test)));
  run::MeasuredSpecimen m;
  m.round = m.measured_in = round;
  m.record.specimen =
      fmt::format("r{}-{}-{}-{}", round, design.name().substr(0, 14), tester::to_string(test), replicate);
  m.record.design = design;
  m.record.test = test;
  m.record.batch = fmt::format("round-{}", round);
  m.record.print_order = replicate;
  const optimize::Performance shown = {truth.modulus_pa * (1.0 + 0.03 * own.normal()),
                                       truth.toughness_pa * std::exp(0.12 * own.normal())};
  if (test == tester::TestKind::modulus) {
    m.record.modulus_pa = shown.modulus_pa;
  } else {
    m.record.toughness_pa = shown.toughness_pa;
    m.record.curve = curve(shown, 0.035 + 0.02 * own.uniform());
  }
  return m;
}

inline void measure(run::RunRecord& run, const pattern::Pattern& pattern, int round) {
  for (int replicate = 1; replicate <= 3; ++replicate) {
    for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
      run.specimens.push_back(specimen(pattern, true_performance(pattern), test, round, replicate));
    }
  }
}

inline wire::DiagnosedCandidate candidate(const char* name, const char* status, double statistic, double p,
                                          double absorption) {
  wire::DiagnosedCandidate c;
  c.name = name;
  c.status = status;
  c.statistic = statistic;
  c.p_family_wise = p;
  c.absorption = absorption;
  return c;
}

inline wire::Diagnosis diagnosis(int round) {
  wire::Diagnosis d;
  d.verdict = round < 2 ? "ambiguous" : "named";
  d.summary = round < 2 ? "Something is wrong that droplet_mixing and machine_compliance explain equally well."
                        : "The testing machine gives way: machine_compliance explains the misfit.";
  d.candidates = {candidate("machine_compliance", "in_set", 41.3, 0.0005, 0.31),
                  candidate("droplet_mixing", round < 2 ? "in_set" : "excluded", 22.0, 0.012, 0.62),
                  candidate("interface_anisotropy", "invisible", 0.4, 0.91, 0.97)};
  if (round >= 2) {
    wire::DiagnosedEffect& effect = d.effects.emplace_back();
    effect.name = "machine_compliance";
    effect.unit = "1/Pa";
    effect.parameter = 4.2e-11;
    effect.interval_low = 3.1e-11;
    effect.interval_high = 5.6e-11;
    d.gain = wire::DiagnosedGain{.held_out_error_before = 0.083, .held_out_error_after = 0.034};
  }
  return d;
}

inline run::RunRecord run(int last_round = 3) {
  run::RunRecord run;
  RandomStream random(7, "sample run");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(340, random);
  std::vector<pattern::Pattern> measured(patterns.begin(), patterns.begin() + 6);
  for (const pattern::Pattern& p : measured) {
    if (last_round >= 1) measure(run, p, 1);
  }
  for (int n = 0; n <= last_round; ++n) {
    run::RoundRecord& round = run.rounds[n];
    run::Gamut gamut;
    for (const pattern::Pattern& p : patterns) {
      gamut.patterns.push_back(p.bits());
      gamut.performances.push_back(predicted(p, n));
    }
    round.gamut_count = static_cast<int>(gamut.patterns.size());
    round.gamut = std::make_shared<const run::Gamut>(std::move(gamut));
    wire::AdoptedModel& model = round.model.emplace();
    for (double f = 0.0; n > 0 && f <= 1.01; f += 0.1) {
      model.benchmark.push_back(
          {1e6 * std::pow(10.0, 3.4 * std::min(1.0, f * 1.2)), (0.08 + 1.1 * f * (1.0 - f)) * 1e6});
    }
    for (int i = 0; i < 4; ++i) {
      const pattern::Pattern& p = patterns[40 + 70 * i + 11 * n];
      const optimize::Performance expected = predicted(p, n);
      round.proposals.push_back(
          {.design = p,
           .modulus_pa = expected.modulus_pa,
           .toughness_pa = expected.toughness_pa,
           .reason = fmt::format("radial bin {} of 4, on the second front; 84 pixels from its neighbours", i + 1)});
      if (n < last_round) {
        measure(run, p, n + 1);
        measured.push_back(p);
      }
    }
    if (n >= 1) {
      for (const pattern::Pattern& p : measured) {
        const optimize::Performance expected = predicted(p, n);
        round.simulated[p.key()] = {.design = p,
                                    .failure = "",
                                    .modulus_pa = expected.modulus_pa,
                                    .toughness_pa = expected.toughness_pa,
                                    .curve = curve(expected, 0.045)};
      }
      round.diagnosis = diagnosis(n);
    }
    if (n >= 2) model.parameters.extensions["machine_compliance"] = {4.2e-11};
    wire::RoundSummary s;
    s.round = n;
    s.fidelity = tester::Fidelity::full;
    s.calibration_count = n == 0 ? 3 : 6 + 4 * n;
    s.gamut_hypervolume_staircase = 1.21 - 0.08 * n;
    s.measured_hypervolume_staircase = n == 0 ? 0.0 : 0.78 + 0.04 * n;
    s.hypervolume_error = n == 0 ? 0.0 : 0.03;
    s.signed_gap = s.gamut_hypervolume_staircase - s.measured_hypervolume_staircase;
    s.gap = s.signed_gap + 0.02;
    s.before = {s.calibration_count, 0.31 - 0.04 * n, 0.93, s.calibration_count, 1.2 - 0.2 * n, 7.4, 0.2};
    s.after = {s.calibration_count, 0.065, 0.23, s.calibration_count, 0.24, 0.81, 0.41};
    if (n >= 1) s.held_out = {4, 0.131 - 0.02 * n, 0.2, 4, 0.81 - 0.14 * n, 1.3, 0.2 + 0.1 * n};
    s.last = n == last_round;
    s.decided_by = "the signed gap 0.150 GPa MPa is more than twice the error 0.030 GPa MPa";
    round.summary = s;
  }
  return run;
}

}  // namespace nacre::report::sample
