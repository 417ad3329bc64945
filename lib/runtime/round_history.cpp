#include "runtime/round_history.hpp"

#include <map>

#include <fmt/format.h>

#include "runtime/journal.hpp"
#include "wire/codec.hpp"

namespace nacre::runtime {
namespace {

/// "E 6.3 %, T 25 %"; "nothing to compare" without designs.
std::string in_words(const prediction_error_t& errors) {
  std::string words;
  if (errors.n_modulus > 0) words += fmt::format("E {:.1f} %", 100.0 * errors.modulus_mean);
  if (errors.n_toughness > 0) {
    words += fmt::format("{}T {:.1f} %", words.empty() ? "" : ", ", 100.0 * errors.toughness_mean);
  }
  return words.empty() ? "nothing to compare" : words;
}

}  // namespace

std::vector<round_summary_t> read_rounds(const std::filesystem::path& run_folder) {
  const auto journal = run_folder / "nodes" / "validation_agent" / "journal.lcm";
  if (!std::filesystem::exists(journal)) return {};
  const std::string channel = std::string(kOutPrefix) + "ROUND";
  std::map<int, round_summary_t> rounds;
  LogReader reader(journal);
  while (const auto record = reader.next()) {
    if (record->channel != channel) continue;
    const auto round = wire::decode_safe<round_summary_t>(record->data);
    if (round) rounds[round->round] = *round;
  }
  std::vector<round_summary_t> in_order;
  for (auto& [number, round] : rounds) in_order.push_back(std::move(round));
  return in_order;
}

std::string in_words(const round_summary_t& round) {
  return fmt::format(
      "round {}: gap {:.4f} GPa MPa (measured {:.4f}, gamut {:.4f}); held out: {}; calibrated on {}: {}{}", round.round,
      round.gap, round.measured_hypervolume_staircase, round.gamut_hypervolume_staircase, in_words(round.held_out),
      round.n_calibration, in_words(round.after), round.equilibrium ? "; equilibrium" : "");
}

}  // namespace nacre::runtime
