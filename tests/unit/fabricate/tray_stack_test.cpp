#include "fabricate/tray_stack.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "fabricate/build_sheet.hpp"
#include "fabricate/slices.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

/// A pattern, a mixture and a thinner bar, turned, in coarse droplets.
JobRequest mixed_request() {
  JobRequest request{
      .name = "mixed",
      .wanted = {{.design = *pattern::layout_from_key("577fffe9fffdef"), .thickness_mm = 0.5, .replicates = 3},
                 {.design = pattern::Mixture{0.65}, .thickness_mm = 0.5, .replicates = 2},
                 {.design = pattern::Mixture{1.0},
                  .test = tester::TestKind::modulus,
                  .orientation_deg = 90.0,
                  .thickness_mm = 0.3,
                  .replicates = 2}}};
  request.printer = {.dpi_x = 150, .dpi_y = 300, .dpi_z = 400};
  request.tray_stacks = true;
  return request;
}

std::vector<DropletPlan> plans_of(const Job& job) {
  std::vector<DropletPlan> plans;
  for (const PrintModel& model : job.models) plans.emplace_back(model.plan, job.request.printer);
  return plans;
}

TEST(TrayStack, HoldsEverySpecimenWhereTheJobHasPlacedIt) {
  const Job job = plan_job(mixed_request());
  ASSERT_EQ(job.trays, 1);
  const auto plans = plans_of(job);
  const TrayStack stack(job, 1, plans);
  const Printer& printer = job.request.printer;
  EXPECT_EQ(stack.layers(), layers_of(0.5, printer));
  for (const int layer : {0, stack.layers() - 1}) {
    const Slice tray = stack.slice(layer);
    std::int64_t held = 0;
    for (const PlacedSpecimen& specimen : job.specimens) {
      const DropletPlan& plan = plans[specimen.model];
      if (layer >= plan.layers()) continue;
      const Slice own = plan.slice(layer);
      const auto column = std::lround((specimen.x_mm - stack.corner_x_mm()) / pitch_mm(printer.dpi_x));
      const auto front = std::lround((specimen.y_mm - stack.corner_y_mm()) / pitch_mm(printer.dpi_y));
      const auto row = tray.rows - front - own.rows;
      for (int y = 0; y < own.rows; ++y)
        for (int x = 0; x < own.columns; ++x)
          ASSERT_EQ(tray.at(static_cast<int>(column) + x, static_cast<int>(row) + y), own.at(x, y)) << specimen.label;
      const DropletCount count = count_droplets(own);
      held += count[1] + count[2];
    }
    const DropletCount all = count_droplets(tray);
    EXPECT_EQ(all[1] + all[2], held) << "and nothing else";
  }
}

TEST(TrayStack, KnowsWhichLayersAreAlike) {
  JobRequest request = mixed_request();
  request.wanted.erase(request.wanted.begin() + 1);  // the mixture, of which no two layers are
  const Job job = plan_job(request);
  const auto plans = plans_of(job);
  const TrayStack stack(job, 1, plans);
  const int thin = layers_of(0.3, request.printer);
  for (int layer = 1; layer < stack.layers(); ++layer) {
    EXPECT_EQ(stack.is_like_before(layer), layer != thin) << layer;
    EXPECT_EQ(stack.slice(layer) == stack.slice(layer - 1), layer != thin) << layer;
  }
}

TEST(TrayStack, IsWrittenAndCountedBackWithItsModels) {
  const fs::path folder = fs::temp_directory_path() / ("nacre-tray-" + std::to_string(::getpid()));
  const Job job = plan_job(mixed_request());
  const WrittenJob written = write_job(job, folder);
  const auto sheet = nlohmann::json::parse(read_file(folder / "build_sheet.json"));
  const auto& tray = sheet["tray_stacks"][0];
  const StackCount count = count_slices(folder / tray["slices"].get<std::string>());
  DropletCount models{};
  for (std::size_t i = 0; i < job.models.size(); ++i)
    for (const std::size_t material : {1, 2})
      models[material] += job.models[i].wanted.replicates * written.models[i].count.total[material];
  EXPECT_EQ(count.total[1], models[1]);
  EXPECT_EQ(count.total[2], models[2]);
  EXPECT_EQ(tray["slice_count"], count.layers);
  EXPECT_NEAR(tray["size_mm"][0].get<double>(), count.columns * 25.4 / 150, 1e-9);
  EXPECT_TRUE(fs::exists(folder / "trays/1/preview.png"));
  EXPECT_NE(read_file(folder / "build_sheet.html").find("trays/1/preview.png"), std::string::npos);
  forget_job(folder);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace nacre::fabricate
