#include "fabricate/slices.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/files.hpp"
#include "base/result.hpp"
#include "fabricate/slice_png.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

class Slices : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-slices-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
  // Few layers: the stack is as tall as it is thick.
  const SpecimenPlan thin_{.design = *pattern::layout_from_key("3ffc9b4ad4d2d9"), .thickness_mm = 0.2};
};

TEST_F(Slices, HoldEveryDropletOfThePlan) {
  for (const pattern::Design& design : {thin_.design, pattern::Design(pattern::Mixture{0.65})}) {
    SpecimenPlan specimen = thin_;
    specimen.design = design;
    const DropletPlan plan(specimen, {});
    write_slices(plan, {}, folder_);
    for (int layer = 0; layer < plan.layers(); ++layer)
      EXPECT_EQ(read_slice(folder_ / slice_name(layer)), plan.slice(layer)) << layer;
    EXPECT_FALSE(fs::exists(folder_ / slice_name(plan.layers())));
  }
}

TEST_F(Slices, AreCountedBackLayerByLayer) {
  SpecimenPlan mixture = thin_;
  mixture.design = pattern::Mixture{0.8};
  const DropletPlan plan(mixture, {});
  write_slices(plan, {}, folder_);
  const StackCount stack = count_slices(folder_);
  EXPECT_EQ(stack.layers, plan.layers());
  DropletCount total{};
  for (int layer = 0; layer < plan.layers(); ++layer) {
    const DropletCount count = count_droplets(plan.slice(layer));
    EXPECT_EQ(stack.by_layer[layer], count);
    for (std::size_t i = 0; i < 3; ++i) total[i] += count[i];
  }
  EXPECT_EQ(stack.total, total);
}

TEST_F(Slices, OfAnEarlierStackDoNotStay) {
  SpecimenPlan thick = thin_;
  thick.thickness_mm = 0.4;
  write_slices(DropletPlan(thick, {}), {}, folder_);
  std::ofstream(folder_ / "notes.txt") << "kept";
  write_slices(DropletPlan(thin_, {}), {}, folder_);
  EXPECT_EQ(count_slices(folder_).layers, DropletPlan(thin_, {}).layers());
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
}

TEST_F(Slices, AreIndexedPicturesWithThePhysicalSizeOfDroplets) {
  const std::string png = to_png(DropletPlan(thin_, {}).slice(0), {}, false);
  const auto number_at = [&](std::size_t place) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[place + i]);
    return value;
  };
  EXPECT_EQ(number_at(16), 614U);
  EXPECT_EQ(number_at(20), 2457U);
  EXPECT_EQ(png[24], 8) << "bits per point";
  EXPECT_EQ(png[25], 3) << "palette";
  const std::size_t physical = png.find("pHYs");
  ASSERT_NE(physical, std::string::npos);
  EXPECT_EQ(number_at(physical + 4), 11811U);
  EXPECT_EQ(number_at(physical + 8), 23622U);
}

// What GrabCAD Voxel Print takes: 32 bits, a few opaque colours, names with a prefix, 600 x 300 dpi.
TEST_F(Slices, InColoursHoldTheSameDroplets) {
  const Printer printer = printer_of_name("voxel-print-27um").printer;
  for (const pattern::Design& design : {thin_.design, pattern::Design(pattern::Mixture{0.65})}) {
    SpecimenPlan specimen = thin_;
    specimen.design = design;
    const DropletPlan plan(specimen, printer);
    write_slices(plan, printer, folder_);
    EXPECT_FALSE(fs::exists(folder_ / "0000.png"));
    const std::string png = read_file(folder_ / "slice_0000.png");
    EXPECT_EQ(png[24], 8) << "bits per channel";
    EXPECT_EQ(png[25], 6) << "red, green, blue, alpha";
    for (int layer = 0; layer < plan.layers(); ++layer)
      EXPECT_EQ(read_slice(folder_ / slice_name(layer, printer.pixels)), plan.slice(layer)) << layer;
    EXPECT_EQ(count_slices(folder_, printer.pixels).layers, std::lround(thin_.thickness_mm / 0.027));
  }
  write_slices(DropletPlan(thin_, {}), {}, folder_);
  EXPECT_FALSE(fs::exists(folder_ / "slice_0000.png")) << "an earlier stack does not stay";
}

TEST_F(Slices, DamagedFilesAreNamed) {
  write_slices(DropletPlan(thin_, {}), {}, folder_);
  const std::string whole = read_file(folder_ / slice_name(1));
  for (const std::string& damaged : {std::string("no picture"), whole.substr(0, whole.size() / 2)}) {
    std::ofstream(folder_ / slice_name(1), std::ios::binary) << damaged;
    try {
      count_slices(folder_);
      ADD_FAILURE() << "a damaged slice was counted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("0001.png"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(count_slices(folder_ / "nothing"), InputError);
}

}  // namespace
}  // namespace nacre::fabricate
