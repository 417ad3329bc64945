#include "fabricate/preview.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <map>
#include <vector>

#include "pattern/phase_colours.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

/// Points of a PNG by colour, 0xRRGGBB.
std::map<std::uint32_t, int> colours_in(const fs::path& path) {
  png_image picture{};
  picture.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&picture, path.c_str()), 0) << picture.message;
  picture.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(picture));
  EXPECT_NE(png_image_finish_read(&picture, nullptr, bytes.data(), 0, nullptr), 0) << picture.message;
  std::map<std::uint32_t, int> counts;
  for (std::size_t i = 0; i < bytes.size(); i += 3) ++counts[bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2]];
  return counts;
}

std::map<std::uint32_t, int> colours_of(const SpecimenPlan& specimen) {
  const fs::path path = fs::path(testing::TempDir()) / "nacre_preview_test.png";
  write_preview(DropletPlan(specimen, {}), path);
  return colours_in(path);
}

// A pure specimen fills most of its pictures with its own colour; the other phases are in the legend alone.
TEST(Preview, HasTheColoursOfFilmsAndALegend) {
  constexpr int kLegendSwatch = 22 * 22;
  for (const auto kind : {SpecimenKind::toughness, SpecimenKind::tensile_bar}) {
    for (const double orientation_deg : {0.0, 90.0}) {
      SpecimenPlan specimen{.design = pattern::Mixture{0.0}, .kind = kind, .orientation_deg = orientation_deg};
      specimen.thickness_mm = 0.1;
      auto counts = colours_of(specimen);
      EXPECT_GT(counts[pattern::kSoftRgb], 100'000);
      EXPECT_EQ(counts[pattern::kRigidRgb], kLegendSwatch);
      EXPECT_GT(counts[pattern::kNotPrintedRgb], kLegendSwatch);
      specimen.design = pattern::Mixture{1.0};
      counts = colours_of(specimen);
      EXPECT_GT(counts[pattern::kRigidRgb], 100'000);
      EXPECT_EQ(counts[pattern::kSoftRgb], kLegendSwatch);
    }
  }
}

}  // namespace
}  // namespace nacre::fabricate
