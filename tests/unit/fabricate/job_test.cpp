#include "fabricate/job.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "base/files.hpp"
#include "base/result.hpp"
#include "fabricate/build_sheet.hpp"
#include "pattern/coupons.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

JobRequest request_of(int designs, int replicates) {
  JobRequest request;
  request.name = "batch-7";
  for (int i = 0; i < designs; ++i) {
    const pattern::Mixture mixture{0.5 + 0.01 * i};
    request.wanted.push_back({.design = mixture, .replicates = replicates});
    request.wanted.push_back({.design = mixture, .test = tester::TestKind::modulus, .replicates = replicates});
  }
  return request;
}

TEST(Job, EverySpecimenLiesOnItsTrayApartFromTheOthers) {
  const JobRequest request = request_of(3, 4);
  const Job job = plan_job(request);
  ASSERT_EQ(job.specimens.size(), 24U);
  EXPECT_GT(job.trays, 1);
  for (const PlacedSpecimen& a : job.specimens) {
    const PrintModel& model = job.models[a.model];
    EXPECT_GE(a.x_mm, request.gap_mm);
    EXPECT_GE(a.y_mm, request.gap_mm);
    EXPECT_LE(a.x_mm + model.size_x_mm, request.printer.tray_x_mm - request.gap_mm);
    EXPECT_LE(a.y_mm + model.size_y_mm, request.printer.tray_y_mm - request.gap_mm);
    for (const PlacedSpecimen& b : job.specimens) {
      if (a.label == b.label || a.tray != b.tray) continue;
      const PrintModel& other = job.models[b.model];
      const double gap = request.gap_mm - 1e-9;
      const bool apart = a.x_mm + model.size_x_mm + gap <= b.x_mm || b.x_mm + other.size_x_mm + gap <= a.x_mm ||
                         a.y_mm + model.size_y_mm + gap <= b.y_mm || b.y_mm + other.size_y_mm + gap <= a.y_mm;
      EXPECT_TRUE(apart) << a.label << " and " << b.label;
    }
  }
}

TEST(Job, TraysAreFilledBeforeAnotherIsTaken) {
  // A column 52 mm wide takes two notched specimens, one 19 mm wide a bar, with 5 mm between them: of 255 mm, 250 are
  // for columns and gaps. Eight pairs and 16 bars are 8 x 57 + 16 x 24 = 840 mm: four trays at least.
  EXPECT_EQ(plan_job(request_of(4, 4)).trays, 4);
  // 9 x 57 + 18 x 24 = 945 mm, too.
  EXPECT_EQ(plan_job(request_of(3, 6)).trays, 4);
}

TEST(Job, ThePackingDoesNotHangOnTheSeed) {
  using Tray = std::multiset<std::tuple<double, double, double>>;
  const auto trays = [](std::uint64_t seed) {
    JobRequest request = request_of(3, 5);
    request.seed = seed;
    std::map<int, Tray> by_number;
    const Job job = plan_job(request);
    for (const PlacedSpecimen& each : job.specimens)
      by_number[each.tray].insert({each.x_mm, each.y_mm, job.models[each.model].size_x_mm});
    std::multiset<Tray> all;  // a tray's number is that of its first specimen
    for (const auto& [number, tray] : by_number) all.insert(tray);
    return all;
  };
  EXPECT_EQ(trays(1), trays(2));
}

TEST(Job, OfFewLayersIsNoneForVoxelPrint) {
  JobRequest request{.name = "thin",
                     .wanted = {{.design = pattern::Mixture{0.5}, .thickness_mm = 0.8}},
                     .printer = printer_of_name("voxel-print-27um").printer};
  EXPECT_EQ(plan_job(request).trays, 1) << "30 layers of 27 um";
  request.wanted[0].thickness_mm = 0.78;
  EXPECT_THROW(plan_job(request), InputError) << "29 layers";
  request.printer = {};
  EXPECT_EQ(plan_job(request).trays, 1);
  EXPECT_THROW(printer_of_name("nonsense"), InputError);
}

TEST(Job, EveryModelIsPrintedOnceBeforeAnyIsPrintedAgain) {
  const Job job = plan_job(request_of(4, 3));
  for (const tester::TestKind test : {tester::TestKind::toughness, tester::TestKind::modulus}) {
    std::vector<std::size_t> order;
    for (const PlacedSpecimen& specimen : job.specimens) {
      if (job.models[specimen.model].wanted.test == test) order.push_back(specimen.model);
    }
    ASSERT_EQ(order.size(), 12U);
    for (std::size_t block = 0; block < 3; ++block) {
      const std::set<std::size_t> models(order.begin() + 4 * block, order.begin() + 4 * block + 4);
      EXPECT_EQ(models.size(), 4U) << "block " << block;
    }
  }
}

TEST(Job, TheOrderIsRandomInTheSeedAlone) {
  const auto order_of = [](std::uint64_t seed) {
    JobRequest request = request_of(5, 2);
    request.seed = seed;
    std::vector<std::size_t> models;
    for (const PlacedSpecimen& specimen : plan_job(request).specimens) models.push_back(specimen.model);
    return models;
  };
  EXPECT_EQ(order_of(1), order_of(1));
  EXPECT_NE(order_of(1), order_of(2));
  EXPECT_FALSE(std::is_sorted(order_of(1).begin(), order_of(1).begin() + 10));
}

TEST(Job, LabelsAreUniqueAndPrintOrderCountsThrough) {
  const Job job = plan_job(request_of(3, 4));
  std::set<std::string> labels;
  for (std::size_t i = 0; i < job.specimens.size(); ++i) {
    labels.insert(job.specimens[i].label);
    EXPECT_EQ(job.specimens[i].print_order, static_cast<int>(i) + 1);
  }
  EXPECT_EQ(labels.size(), job.specimens.size());
  EXPECT_EQ(job.specimens.front().label, "batch-7-01");
}

TEST(Job, ATwinTurnedByAQuarterTakesTheOtherSidesOfTheTray) {
  JobRequest request;
  request.name = "twins";
  const pattern::Layout layout = pattern::checkerboard(5);
  request.wanted = {{.design = layout}, {.design = layout, .orientation_deg = 90.0}};
  const Job job = plan_job(request);
  EXPECT_EQ(job.models[0].size_x_mm, job.models[1].size_y_mm);
  EXPECT_EQ(job.models[0].size_y_mm, job.models[1].size_x_mm);
  EXPECT_NE(job.models[0].name, job.models[1].name);
}

TEST(Job, RefusesWhatCannotBePrinted) {
  JobRequest request = request_of(1, 1);
  request.name = "no/slash";
  EXPECT_THROW(plan_job(request), InputError);
  request.name = "small";
  request.printer.tray_y_mm = 90.0;
  EXPECT_THROW(plan_job(request), InputError);
  EXPECT_THROW(plan_job({.name = "empty"}), InputError);
  EXPECT_THROW(plan_job(request_of(1, 0)), InputError);
}

TEST(TestSpeed, StrainsTheGaugeAtTheRate) {
  EXPECT_NEAR(test_speed_mm_per_min({.design = pattern::Mixture{1.0}}), 2.0, 1e-9);
  const double bar = test_speed_mm_per_min({.design = pattern::Mixture{1.0}, .test = tester::TestKind::modulus});
  // ASTM D638 allows 5 mm/min within a quarter for a type I bar.
  EXPECT_GE(bar, 3.75);
  EXPECT_LE(bar, 6.25);
}

TEST(Pull, IsSaidInWordsAlongItsProgramme) {
  EXPECT_EQ(pull_in_words({}), "monotonic");
  EXPECT_EQ(pull_in_words({{0.02, 0.005, 0.022}}), "to 2 % strain, back to 0.5 %, on to 2.2 %");
}

TEST(BuildSheet, SaysWhatIsInTheSlices) {
  const fs::path folder = fs::temp_directory_path() / ("nacre-job-" + std::to_string(::getpid()));
  JobRequest request;
  request.name = "sheet";
  request.wanted = {{.design = *pattern::layout_from_key("577fffe9fffdef"), .thickness_mm = 0.1, .replicates = 2},
                    {.design = pattern::Mixture{0.65}, .test = tester::TestKind::modulus, .thickness_mm = 0.1}};
  const Job job = plan_job(request);
  write_job(job, folder);
  const auto sheet = nlohmann::json::parse(read_file(folder / "build_sheet.json"));
  ASSERT_EQ(sheet["models"].size(), 2U);
  EXPECT_EQ(sheet["specimens"].size(), 6U);
  for (const auto& model : sheet["models"]) {
    const StackCount count = count_slices(folder / model["slices"].get<std::string>());
    EXPECT_EQ(model["slice_count"], count.layers);
    EXPECT_EQ(model["droplets"]["rigid"], count.total[2]);
    EXPECT_NEAR(model["rigid_fraction"].get<double>(), model["rigid_fraction_designed"].get<double>(), 0.03);
    EXPECT_TRUE(fs::exists(folder / model["name"].get<std::string>() / "preview.png"));
  }
  const std::string html = read_file(folder / "build_sheet.html"), table = read_file(folder / "specimens.csv");
  EXPECT_NE(html.find("background:#22262c\"></span>soft"), std::string::npos) << "a legend of the colours";
  for (const PlacedSpecimen& specimen : job.specimens) {
    EXPECT_NE(html.find(specimen.label), std::string::npos);
    EXPECT_NE(table.find("," + specimen.label + ","), std::string::npos);
  }
  fs::remove_all(folder);
}

TEST(BuildSheet, OfAnotherJobIsNoticedAndTheTableThatPeopleFillInIsKept) {
  const fs::path folder = fs::temp_directory_path() / ("nacre-known-job-" + std::to_string(::getpid()));
  JobRequest request{.name = "known", .wanted = {{.design = pattern::Mixture{0.65}, .thickness_mm = 0.1}}};
  const Job job = plan_job(request);
  EXPECT_FALSE(holds_another_job(folder, job));
  write_job(job, folder);
  const fs::path table = folder / "specimens.csv";
  write_file_atomically(table, "filled in\n");
  EXPECT_FALSE(holds_another_job(folder, job));
  write_job(job, folder);
  EXPECT_EQ(read_file(table), "filled in\n");
  request.wanted[0].replicates = 3;
  const Job fewer = plan_job(request);
  EXPECT_TRUE(holds_another_job(folder, fewer));
  fs::remove(folder / "build_sheet.json");
  EXPECT_TRUE(holds_another_job(folder, job)) << "a table that is not this job's";
  forget_job(folder);
  EXPECT_FALSE(holds_another_job(folder, fewer));
  EXPECT_FALSE(fs::exists(table));
  fs::remove_all(folder);
}

TEST(BuildSheet, OfAForgottenJobLeavesNothingButWhatPeoplePutThere) {
  const fs::path folder = fs::temp_directory_path() / ("nacre-forgotten-job-" + std::to_string(::getpid()));
  JobRequest request{.name = "old",
                     .wanted = {{.design = pattern::Mixture{0.65}, .thickness_mm = 0.1},
                                {.design = pattern::Mixture{0.5}, .thickness_mm = 0.1}}};
  const Job job = plan_job(request);
  write_job(job, folder);
  const fs::path kept = folder / job.models[0].name, emptied = folder / job.models[1].name;
  write_file_atomically(kept / "slices/photo.png", "a person's");
  write_file_atomically(folder / "notes.txt", "a person's");
  forget_job(folder);
  EXPECT_FALSE(fs::exists(kept / "slices/0000.png"));
  EXPECT_FALSE(fs::exists(kept / "preview.png"));
  EXPECT_TRUE(fs::exists(kept / "slices/photo.png"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
  EXPECT_FALSE(fs::exists(emptied));
  fs::remove_all(folder);
}

TEST(BuildSheet, ThatIsDamagedTakesNothingAwayOutsideItsJob) {
  const fs::path folder = fs::temp_directory_path() / ("nacre-damaged-job-" + std::to_string(::getpid()));
  const fs::path job = folder / "job", neighbour = folder / "other/slices/0000.png";
  fs::create_directories(job);
  fs::create_directories(neighbour.parent_path());
  for (const char* name : {"../other", "..", "link"}) {
    write_file_atomically(neighbour, "another job's");
    write_file_atomically(
        job / "build_sheet.json",
        nlohmann::json{{"models", {{{"name", name}, {"slices", std::string(name) + "/slices"}, {"slice_count", 1}}}}}
            .dump());
    if (!fs::exists(job / "link")) fs::create_directory_symlink(folder / "other", job / "link");
    forget_job(job);
    EXPECT_TRUE(fs::exists(neighbour)) << name;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace nacre::fabricate
