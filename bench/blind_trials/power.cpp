#include "power.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

#include "base/statistics.hpp"
#include "report/standalone.hpp"
#include "report/svg.hpp"

namespace nacre::blind_trials {
namespace {

/// Edges of the bins: those of kind `power` lie about their middles.
constexpr std::array kEdges = {2.25, 3.75, 5.5, 7.25, 10.0, 15.0};
constexpr std::size_t kBins = kEdges.size() - 1;
const std::string kAll = "all effects";

struct Bin {
  int trials = 0, named = 0, noticed = 0;
  double snr = 0.0;  ///< sum
  void add(const Score& score, double of) {
    ++trials, snr += of;
    named += score.right_name ? 1 : 0;
    noticed += score.diagnosis.verdict == "base_sufficient" ? 0 : 1;
  }
};

using Bins = std::array<Bin, kBins>;

/// By effect; `kAll` among them.
std::map<std::string, Bins> binned(const std::vector<Score>& scores) {
  std::map<std::string, Bins> bins;
  for (const Score& score : scores) {
    if (score.trial.kind != "effect" && score.trial.kind != "power") continue;
    const double snr = score.diagnosis.hidden.front().snr;
    for (std::size_t b = 0; b < kBins; ++b) {
      if (snr < kEdges[b] || snr >= kEdges[b + 1]) continue;
      bins[score.trial.hidden.front()][b].add(score, snr);
      bins[kAll][b].add(score, snr);
    }
  }
  return bins;
}

/// Shares over the mean signal of each bin that holds trials.
std::vector<report::PlotPoint> points_of(const Bins& bins, int Bin::*reached) {
  std::vector<report::PlotPoint> points;
  for (const Bin& bin : bins)
    if (bin.trials > 0) points.push_back({bin.snr / bin.trials, static_cast<double>(bin.*reached) / bin.trials});
  return points;
}

/// 0.3 % by chance, of either sign.
std::vector<report::PlotPoint> limit() {
  constexpr double kLevel = 2.97;  // standard deviations
  std::vector<report::PlotPoint> points;
  for (double snr = 0.0; snr <= kEdges.back(); snr += 0.1) points.push_back({snr, normal_cdf(snr - kLevel)});
  return points;
}

constexpr std::array kInks = {report::Ink::measured, report::Ink::simulated, report::Ink::homogeneous,
                              report::Ink::thesis,   report::Ink::family_1,  report::Ink::family_2,
                              report::Ink::family_3, report::Ink::family_4,  report::Ink::family_5,
                              report::Ink::family_6};

}  // namespace

std::string power_figure(const std::vector<Score>& scores) {
  report::Plot plot({.title = "Power of the diagnosis",
                     .x_label = "signal-to-noise ratio",
                     .y_label = "share of trials",
                     .x = {0.0, kEdges.back()},
                     .y = {0.0, 1.05},
                     .width = 640,
                     .height = 380});
  const std::map<std::string, Bins> bins = binned(scores);
  std::size_t count = 0;
  for (const auto& [effect, of] : bins) {
    if (effect == kAll) continue;
    const auto named = points_of(of, &Bin::named);
    const report::Ink ink = kInks[count++ % kInks.size()];
    plot.line(named, ink, report::Stroke::thin, "");
    plot.dots(named, ink, effect);
  }
  if (const auto all = bins.find(kAll); all != bins.end()) {
    plot.line(points_of(all->second, &Bin::named), report::Ink::earlier, report::Stroke::solid, "all, named");
    plot.rings(points_of(all->second, &Bin::noticed), report::Ink::earlier, "all, noticed");
  }
  plot.line(limit(), report::Ink::earlier, report::Stroke::dashed, "likelihood-ratio test, noticed");
  return report::standalone(plot.svg());
}

std::string power_table(const std::vector<Score>& scores) {
  std::string text = "| named, noticed, trials: SNR of |", rule = "\n| --- |";
  for (std::size_t b = 0; b < kBins; ++b) {
    text += fmt::format(" {:g} to {:g} |", kEdges[b], kEdges[b + 1]);
    rule += " --- |";
  }
  text += rule;
  for (const auto& [effect, bins] : binned(scores)) {
    text += fmt::format("\n| {} |", effect);
    for (const Bin& bin : bins)
      text += bin.trials > 0 ? fmt::format(" {}, {}, {} |", bin.named, bin.noticed, bin.trials) : " |";
  }
  return text + "\n";
}

}  // namespace nacre::blind_trials
