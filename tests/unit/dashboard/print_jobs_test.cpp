#include "dashboard/print_jobs.hpp"

#include <chrono>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/temporary_folder.hpp"
#include "dashboard/dashboard.hpp"
#include "fake_desk.hpp"

namespace nacre::dashboard {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

game::Order order_of(const std::string& design, int replicates) {
  game::Order order;
  order.id = "r1/" + design;
  order.round = 1;
  order.design = *pattern::design_from_name(design);
  order.test = tester::TestKind::toughness;
  order.conditions.thickness_mm = 0.1;  // three layers
  order.replicates = replicates;
  return order;
}

game::LaboratoryFacts facts_of(std::vector<game::Order> orders) {
  game::LaboratoryFacts facts;
  facts.orders = std::move(orders);
  return facts;
}

game::PrintedSpecimen printed_of(const std::string& label, const game::Order& order) {
  return {label, order.design, order.test, 0.0, order.id};
}

class PrintJobsOfARun : public testing::Test {
 protected:
  PrintJobRow ready(const std::string& name) {
    for (int i = 0; i < 600; ++i) {
      const PrintJobsRow row = jobs_.row(facts_, {});
      const auto job = std::ranges::find(row.jobs, name, &PrintJobRow::job);
      if (job != row.jobs.end() && (job->state == "ready" || job->state == "failed")) return *job;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return {};
  }
  TemporaryFolder run_{"print-jobs"};
  fs::path folder_ = run_.path() / "laboratory" / "jobs";
  game::LaboratoryFacts facts_ = facts_of({order_of("soft", 2), order_of("rigid", 1)});
  PrintJobs jobs_{folder_};
};

TEST_F(PrintJobsOfARun, AreMadeOfWhatNobodyHasPrinted) {
  facts_.printed = {printed_of("old-01", facts_.orders[0])};
  EXPECT_EQ(jobs_.row(facts_, {}).unprinted, 2);
  const auto name = jobs_.make({.tray_stacks = true}, facts_, {});
  ASSERT_TRUE(name) << name.error().message;
  EXPECT_EQ(*name, "r1");
  const PrintJobRow job = ready("r1");
  EXPECT_EQ(job.state, "ready") << job.problem;
  EXPECT_TRUE(job.has_files);
  EXPECT_THAT(job.price, HasSubstr("2 specimens on 1 tray, 3 slices"));
  ASSERT_EQ(job.trays.size(), 1U);
  EXPECT_THAT(job.trays[0].labels, ElementsAre("r1-01", "r1-02"));
  EXPECT_TRUE(fs::exists(folder_ / "r1/trays/1/slices/0002.png"));
}

TEST_F(PrintJobsOfARun, HaveLabelsOfTheirOwn) {
  facts_.printed = {printed_of("r1-07", facts_.orders[0])};
  EXPECT_EQ(free_job_name("r1", facts_, folder_), "r1_2");
  EXPECT_EQ(free_job_name("r1-07", facts_, folder_), "r1-07");
  make_folder(folder_ / "r2" / "trays");
  EXPECT_EQ(free_job_name("r2", facts_, folder_), "r2_2");
  keep_build_sheet(folder_, "r3", "{}");
  EXPECT_EQ(free_job_name("r3", facts_, folder_), "r3") << "made again elsewhere";
}

TEST_F(PrintJobsOfARun, OfNothingOrUnderAFoulNameAreRefused) {
  EXPECT_THAT(jobs_.make({.name = "../escape"}, facts_, {}).error().message, HasSubstr("name: '../escape'"));
  EXPECT_THAT(jobs_.make({.printer = "toaster"}, facts_, {}).error().message, HasSubstr("printer `toaster`"));
  EXPECT_THAT(jobs_.make({.tray_mm = {{20.0, 20.0}}}, facts_, {}).error().message, HasSubstr("does not fit"));
  facts_.printed = {printed_of("a-01", facts_.orders[0]), printed_of("a-02", facts_.orders[0]),
                    printed_of("a-03", facts_.orders[1])};
  EXPECT_THAT(jobs_.make({}, facts_, {}).error().message, HasSubstr("nothing to print"));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(PrintJobsOfARun, AreDiscardedUntilATrayIsPrinted) {
  ASSERT_TRUE(jobs_.make({.tray_stacks = false}, facts_, {}));
  EXPECT_THAT(jobs_.make({}, facts_, {}).error().message, HasSubstr("r1 is being made"));
  ASSERT_EQ(ready("r1").state, "ready");
  facts_.printed = {printed_of("r1-01", facts_.orders[0])};
  EXPECT_THAT(jobs_.discard("r1", facts_).error().message, HasSubstr("undo that first"));
  facts_.printed.clear();
  EXPECT_TRUE(jobs_.discard("r1", facts_));
  EXPECT_FALSE(fs::exists(folder_ / "r1"));
  EXPECT_TRUE(jobs_.row(facts_, {}).jobs.empty());
  EXPECT_FALSE(jobs_.discard("..", facts_));
  ASSERT_TRUE(jobs_.make({.tray_stacks = false}, facts_, {})) << "again under the same name";
  EXPECT_EQ(ready("r1").state, "ready");
}

TEST_F(PrintJobsOfARun, WithADamagedSheetSayWhyAndHideNoOthers) {
  keep_build_sheet(folder_, "torn", "{\"price\":");
  const PrintJobsRow row = jobs_.row(facts_, {});
  ASSERT_EQ(row.jobs.size(), 1U);
  EXPECT_EQ(row.jobs[0].state, "failed");
  EXPECT_THAT(row.jobs[0].problem, HasSubstr("torn/build_sheet.json"));
}

TEST_F(PrintJobsOfARun, GoToThePageAsZipAndBackAsAWord) {
  FakeDesk desk;
  desk.picture = std::make_shared<const Laboratory>(Laboratory{facts_, {}, {}});
  DashboardSettings settings;
  settings.run_folder = run_.path();
  settings.run_id = "game";
  Dashboard dashboard(settings, desk);
  const auto get = [&](const std::string& path, const std::map<std::string, std::string>& query) {
    return dashboard.handle({.method = "GET", .path = path, .query = query, .headers = {}, .body = ""});
  };
  const auto post = [&](const std::string& path, const std::string& body) {
    return dashboard.handle({.method = "POST", .path = path, .query = {}, .headers = {}, .body = body});
  };
  EXPECT_EQ(get("/api/job", {{"job", "r1"}}).status, 404);
  EXPECT_EQ(get("/api/job", {{"job", "../laboratory"}}).status, 404);
  ASSERT_EQ(post("/api/job", R"({"tray_stacks":false,"tray_mm":[200,150]})").status, 200);
  EXPECT_EQ(post("/api/job", R"({"tray_mm":"large"})").status, 400);
  ASSERT_EQ(ready("r1").state, "ready");
  const Response zip = get("/api/job", {{"job", "r1"}});
  ASSERT_TRUE(zip.stream);
  std::string bytes;
  zip.stream([&](std::string_view block) { return bytes += block, true; });
  EXPECT_THAT(bytes, testing::StartsWith("PK"));
  EXPECT_THAT(bytes, HasSubstr("r1/trays/1/preview.png"));
  EXPECT_EQ(get("/api/tray", {{"job", "r1"}, {"tray", "1"}}).type, "image/png");
  EXPECT_EQ(get("/api/tray", {{"job", "r1"}, {"tray", "2"}}).status, 404);
  EXPECT_EQ(post("/api/printed", R"({"job":"r1","tray":1,"printed":true,"by":"Ada"})").status, 200);
  ASSERT_EQ(desk.printed.size(), 1U);
  EXPECT_EQ(desk.printed[0].tray, 1);
  EXPECT_EQ(desk.printed[0].by, "Ada");
  EXPECT_EQ(post("/api/printed", R"({"job":"r9","tray":1,"printed":true,"by":"Ada"})").status, 404);
  EXPECT_EQ(post("/api/printed", R"({"job":"r1","tray":0,"printed":true,"by":"Ada"})").status, 400);
  EXPECT_EQ(post("/api/discard", R"({"job":"r1"})").status, 200);
}

}  // namespace
}  // namespace nacre::dashboard
