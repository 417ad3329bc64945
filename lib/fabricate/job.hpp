#pragma once
// A print job: the specimens, their number, their places on trays and their random order.

#include <cstdint>
#include <string>
#include <vector>

#include "fabricate/droplet_plan.hpp"
#include "tester/loading.hpp"
#include "tester/names.hpp"
#include "thesis/constants.hpp"

namespace nacre::fabricate {

/// Specimens to be printed for one kind of test.
struct WantedSpecimens {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::toughness;
  double orientation_deg = 0.0;
  double thickness_mm = 3.2;
  double strain_rate_per_s = thesis::kTestStrainRate;
  tester::Loading loading = {};                ///< how a coupon is pulled
  int replicates = thesis::kModulusSpecimens;  ///< at least four are tested, three consistent ones count (2.2.2)
  std::string order_id = {};                   ///< of the game; empty when they were not ordered
  std::string reason = {};
};

struct JobRequest {
  std::string name;  ///< of the batch; labels begin with it. 1 to 40 of A-Z, a-z, 0-9, . _ -
  std::vector<WantedSpecimens> wanted = {};
  Printer printer = {};
  Rates rates = {};
  Interface interface = Interface::engineered;
  GripMaterial grips = GripMaterial::pattern;
  NotchOptions notch = {};
  double gap_mm = 5.0;       ///< between specimens, and to the edge of the tray
  bool tray_stacks = false;  ///< also one stack of slices for all of a tray
  std::uint64_t seed = 1;
};

/// One stack of slices, printed as often as there are replicates.
struct PrintModel {
  WantedSpecimens wanted;
  SpecimenPlan plan;
  std::string name;  ///< unique in the job, usable as a folder
  double size_x_mm = 0.0, size_y_mm = 0.0, size_z_mm = 0.0;
};

/// One specimen on a tray; x to the right, y away from the front left corner, as the printer counts.
struct PlacedSpecimen {
  std::string label;  ///< `BATCH-NN`, on the specimen and as the name of its measurement
  std::size_t model = 0;
  int replicate = 1;
  int print_order = 0;  ///< from 1, over all trays
  int tray = 1;
  double x_mm = 0.0, y_mm = 0.0;
};

struct Job {
  JobRequest request;
  std::vector<PrintModel> models;
  std::vector<PlacedSpecimen> specimens;  ///< in print order
  int trays = 0;
  /// Batch of a tray: the job's name, numbered when there are several trays.
  std::string batch(int tray) const;
};

/// Plans a job. The order is random in blocks, from the seed: every model takes a place once before any takes one
/// again, so that drift of the printer falls on all designs alike. Specimens are packed on few trays (packing.hpp),
/// which are printed one after another. Throws InputError for an empty job, a bad name, replicates outside 1 to 100, a
/// specimen larger than the tray, or too few layers.
Job plan_job(const JobRequest& request);

/// The loading programme in words: `monotonic`, `to 2 % strain, back to 0.5 %, on to 2.2 %`.
std::string pull_in_words(const tester::Loading& loading);

/// Speed of the grips in mm/min that strains the specimen at its rate.
double test_speed_mm_per_min(const WantedSpecimens& wanted);

}  // namespace nacre::fabricate
