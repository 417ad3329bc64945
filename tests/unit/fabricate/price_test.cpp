#include "fabricate/price.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "fabricate/build_sheet.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;
using tester::TestKind;

/// Notched specimens of 3.2 mm, eight of which fill a tray, and as many bars.
JobRequest request_of(int specimens) {
  const pattern::Mixture half{0.5};
  return {.name = "priced",
          .wanted = {{.design = half, .replicates = specimens},
                     {.design = half, .test = TestKind::modulus, .replicates = specimens}}};
}

TEST(Price, OfNotchedSpecimensIsThatOfARuler) {
  JobRequest request = request_of(8);
  request.wanted.pop_back();
  request.rates = {.layers_per_minute = 2.0, .minutes_per_test = 15.0};
  const Price price = price_of(plan_job(request));
  EXPECT_EQ(price.specimens, 8);
  EXPECT_EQ(price.trays, 1);
  EXPECT_EQ(price.slices, 101) << "3.2 mm at 800 dpi";
  EXPECT_NEAR(price.printing_h, 101 / 2.0 / 60.0, 1e-12);
  EXPECT_NEAR(price.testing_h, 8 * 15.0 / 60.0, 1e-12);
  // 52 mm x 104 mm less a slit of 10.4 mm x 0.26 mm, 101 layers of 25.4/800 mm.
  const double one_ml = 1e-3 * (52.0 * 104.0 - 10.4 * 0.26) * 101 * 25.4 / 800;
  EXPECT_NEAR(price.resin_ml, 8 * one_ml, 1e-3 * price.resin_ml);
}

TEST(Price, OfABarIsThatOfItsOutline) {
  JobRequest request = request_of(1);
  request.wanted.erase(request.wanted.begin());
  // ASTM D638 type I: 57 mm x 13 mm, ends 19 mm wide, fillets of radius 76 mm between them: each 3 mm deep, so
  // sqrt(76^2 - 73^2) long; a fillet takes length * 3 mm less the area of the arc from the rectangle of the ends.
  const double length = std::sqrt(76.0 * 76.0 - 73.0 * 73.0);
  const double sector = 0.5 * 76.0 * 76.0 * std::asin(length / 76.0), triangle = 0.5 * 73.0 * length;
  const double left_out = 73.0 * length + 3.0 * length - triangle - sector;  // between arc and the narrow part's edge
  const double outline = 57.0 * 13.0 + 2 * (13.0 * length + 2 * left_out) + (165.0 - 57.0 - 2 * length) * 19.0;
  EXPECT_NEAR(price_of(plan_job(request)).resin_ml, 1e-3 * outline * 101 * 25.4 / 800, 2e-3);
}

TEST(Price, ATrayTakesTheLayersOfItsThickestSpecimen) {
  JobRequest request = request_of(1);
  request.wanted[0].thickness_mm = 1.6;
  EXPECT_EQ(price_of(plan_job(request)).slices, 101);
  request.wanted[1].thickness_mm = 1.6;
  EXPECT_EQ(price_of(plan_job(request)).slices, 50);
  EXPECT_EQ(price_of(plan_job(request_of(16))).slices, 4 * 101) << "16 notched specimens, 16 bars: four trays";
}

TEST(Price, IsSaidInOneLine) {
  EXPECT_EQ(
      in_words({.specimens = 32, .trays = 4, .slices = 404, .printing_h = 4.49, .testing_h = 5.33, .resin_ml = 408.4}),
      "32 specimens on 4 trays, 404 slices, about 4.5 h of printing, 5.3 h of testing, 408 ml of resin");
}

// The outline's price and the droplets in the files are independent ways to the same volume.
TEST(Price, TheSheetCarriesItAndTheResinCountedInItsSlices) {
  JobRequest request = request_of(2);
  request.printer.dpi_x = request.printer.dpi_y = request.printer.dpi_z = 200;
  const Job job = plan_job(request);
  const fs::path folder = fs::temp_directory_path() / ("nacre-priced-" + std::to_string(::getpid()));
  const auto written = write_job(job, folder);
  const auto sheet = nlohmann::json::parse(read_file(folder / "build_sheet.json"));
  EXPECT_THAT(read_file(folder / "build_sheet.html"), testing::HasSubstr(in_words(price_of(job))));
  fs::remove_all(folder);
  EXPECT_EQ(sheet["price"]["specimens"], 4);
  EXPECT_EQ(sheet["price"]["slices"], 25);
  const double soft_ml = sheet["resin_ml"]["soft"], rigid_ml = sheet["resin_ml"]["rigid"];
  EXPECT_NEAR(soft_ml + rigid_ml, sheet["price"]["resin_ml"], 0.005 * (soft_ml + rigid_ml));
  EXPECT_NEAR(soft_ml, rigid_ml, 0.01 * soft_ml) << "half and half";
}

}  // namespace
}  // namespace nacre::fabricate
