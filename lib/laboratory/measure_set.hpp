#pragma once
// The laboratory as a batch tool: a campaign in, a measurement set out.

#include <filesystem>
#include <functional>
#include <vector>

#include "laboratory/laboratory.hpp"

namespace nacre::laboratory {

/// What is measured in one go.
struct Campaign {
  std::vector<pattern::Design> designs;
  std::vector<tester::TestKind> tests = {tester::TestKind::modulus, tester::TestKind::toughness};
  /// 0 and 90, each at most once: {0, 90} prints a turned twin of every design. Homogeneous coupons look the same from
  /// everywhere and are measured once.
  std::vector<double> orientations_deg = {0.0};
  std::vector<double> rates_per_s = {tester::TestConditions{}.strain_rate_per_s};
  std::vector<double> temperatures_c = {};  ///< of moduli and coupons; fracture tests are done at kReferenceC
  std::vector<double> holds_s =
      {};                        ///< of homogeneous moduli: one piece's strain is held, read at these times, not pulled
  tester::Loading loading = {};  ///< of coupons
  /// At most two; specimens of each batch are tested on each of them. Empty: the only one, which is not noted.
  std::vector<std::string> machines = {};
};

/// Told while a campaign is simulated, from any thread: share 0..1 of the expected time, simulations done, of how many.
using CampaignProgress = std::function<void(double share, int done, int all)>;

/// Measures designs one by one: modulus and toughness specimens (of `mix:0.5` and its like too), coupons of homogeneous
/// designs alone, at every rate and temperature on every machine, all replicates, replicate k of everything in batch k,
/// in an order of printing drawn from the seed. Simulations run on all allowed cores.
std::vector<measurement::SpecimenRecord> measure(const Truth& truth, const Campaign& campaign,
                                                 const CampaignProgress& progress = {});

/// `nacre measure`: measures as LAB.toml says, writes the measurement set `folder` and, sealed, `folder`.truth.toml
/// next to it. Returns the records. Throws InputError for a bad laboratory file, a folder that holds a set already or
/// has a truth next to it (before anything is simulated) or one that cannot be written.
std::vector<measurement::SpecimenRecord> measure_set(const std::filesystem::path& laboratory_file,
                                                     const std::filesystem::path& folder, const Campaign& campaign,
                                                     const CampaignProgress& progress = {});

}  // namespace nacre::laboratory
