#include "runtime/round_history.hpp"

#include <map>

#include <fmt/format.h>

#include "base/counted.hpp"
#include "runtime/journal.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {
namespace {

/// "6.3 %", "25 %": two digits of an error.
std::string percent(double share) {
  const double percent = 100.0 * share;
  if (percent >= 9.95) return fmt::format("{:.0f} %", percent);
  std::string text = fmt::format("{:.1f}", percent);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text + " %";
}

/// "E 6.3 %, T 25 %"; empty without designs.
std::string in_words(const sysid::PredictionErrors& errors) {
  std::string words;
  if (errors.modulus_count > 0) words += "E " + percent(errors.modulus_mean);
  if (errors.toughness_count > 0) words += (words.empty() ? "T " : ", T ") + percent(errors.toughness_mean);
  return words;
}

/// "model fitted to 3 base materials (errors E 0 %, T 2 %)".
std::string fit_in_words(const wire::RoundSummary& round) {
  if (round.calibration_count == 0) return "model not fitted";
  const std::string errors = in_words(round.after);
  return fmt::format("model fitted to {}{}",
                     counted(round.calibration_count, round.round == 0 ? "base material" : "design"),
                     errors.empty() ? "" : fmt::format(" (errors {})", errors));
}

}  // namespace

std::vector<wire::RoundSummary> read_rounds(const std::filesystem::path& run_folder) {
  const auto journal = run_folder / "nodes" / "validation_agent" / "journal.lcm";
  if (!std::filesystem::exists(journal)) return {};
  const std::string channel = std::string(kOutPrefix) + "ROUND";
  std::map<int, wire::RoundSummary> rounds;
  LogReader reader(journal);
  while (const auto record = reader.next()) {
    if (record->channel != channel) continue;
    const auto round = wire::read<wire::RoundSummary>(record->data);
    if (round) rounds[round->round] = *round;
  }
  std::vector<wire::RoundSummary> in_order;
  for (auto& [number, round] : rounds) in_order.push_back(std::move(round));
  return in_order;
}

std::string in_words(const wire::RoundSummary& round) {
  if (round.round == 0) return fmt::format("round 0: nothing measured yet; {}", fit_in_words(round));
  const std::string errors = in_words(round.held_out);
  return fmt::format(
      "round {}: gap {:.4f} GPa MPa between measured front ({:.4f}) and simulated front ({:.4f}); prediction errors of "
      "new designs: {}; {}{}",
      round.round, round.gap, round.measured_hypervolume_staircase, round.gamut_hypervolume_staircase,
      errors.empty() ? "none measured" : errors, fit_in_words(round), round.equilibrium ? "; equilibrium" : "");
}

}  // namespace nacre::runtime
