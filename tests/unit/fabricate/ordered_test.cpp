// What a game orders is what the sheets of the print job ask for, and what comes back from the testing machine.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/files.hpp"
#include "fabricate/build_sheet.hpp"
#include "fabricate/build_sheet_html.hpp"
#include "measurement/conditions.hpp"
#include "measurement/import.hpp"
#include "measurement/read_set.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/specimen_sheet.hpp"
#include "measurement/write_set.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;
using tester::TestKind;
using testing::HasSubstr;
using testing::IsEmpty;

/// A homogeneous coupon as a diagnosis orders it: ten times as fast, unloaded on the way.
WantedSpecimens coupon(const std::string& order_id) {
  return {.design = pattern::Mixture{0.5},
          .test = TestKind::tensile,
          .strain_rate_per_s = 6.17e-3,
          .loading = {{0.02, 0.005, 0.022}},
          .replicates = 2,
          .order_id = order_id};
}

Job job_of(std::vector<WantedSpecimens> wanted) { return plan_job({.name = "job", .wanted = std::move(wanted)}); }

class OrderedTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-ordered-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write_table(const Job& job) const {
    write_file_atomically(folder_ / "specimens.csv", specimen_table(job));
    return folder_ / "specimens.csv";
  }
  fs::path folder_;
};

/// What an extensometer of 50 mm and the load cell record of a bar of 2 GPa, without a clock.
/// Of a coupon of that modulus.
std::string export_without_time(const tester::Loading& loading, double modulus_mpa) {
  std::string text = "extension_mm,force_n\n";
  for (const double strain : tester::strain_path(loading, 2e-4))
    text += fmt::format("{},{}\n", 50.0 * strain, modulus_mpa * strain * 13.0 * 3.2);
  return text;
}

TEST_F(OrderedTest, StandsInBothSheets) {
  const Job job = job_of({coupon("r2/interface/tensile/discrimination-1")});
  const auto sheet = nlohmann::json::parse(build_sheet_json(job, {.models = {{}}, .trays = {{}}}));
  EXPECT_EQ(sheet["models"][0]["name"], "interface-tensile");
  EXPECT_EQ(sheet["models"][0]["test"], "tensile");
  EXPECT_EQ(sheet["models"][0]["order_id"], "r2/interface/tensile/discrimination-1");
  EXPECT_EQ(sheet["models"][0]["testing"]["strain_rate_per_s"], 6.17e-3);
  EXPECT_EQ(sheet["models"][0]["testing"]["loading"], "strain 0.02 0.005 0.022");
  EXPECT_TRUE(sheet["models"][0]["testing"].contains("gauge_without_extensometer_mm")) << "it is a bar";
  for (const auto& specimen : sheet["specimens"]) EXPECT_EQ(specimen["test"], "tensile");
  const std::string html = build_sheet_html(job, {.models = {{}}, .trays = {{}}});
  EXPECT_THAT(html, HasSubstr("<td>tensile</td>"));
  EXPECT_THAT(html, HasSubstr("<td>to 2 % strain, back to 0.5 %, on to 2.2 %</td>"));
  EXPECT_EQ(specimen_table(job),
            "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,orientation_deg,planned_strain_rate_per_s,"
            "loading,batch,print_order,order_id,tray,date,operator,machine,path,note\n"
            "job-01.csv,job-01,interface,tensile,13,3.2,50,0,0.00617,\"to 2 % strain, back to 0.5 %, on to 2.2 %\",job,"
            "1,r2/interface/tensile/discrimination-1,1,,,,,\n"
            "job-02.csv,job-02,interface,tensile,13,3.2,50,0,0.00617,\"to 2 % strain, back to 0.5 %, on to 2.2 %\",job,"
            "2,r2/interface/tensile/discrimination-1,1,,,,,\n");
}

TEST_F(OrderedTest, OfASpecimenThatNobodyOrderedHasNoOrder) {
  const auto sheet = measurement::read_specimen_sheet(write_table(job_of({{.design = pattern::Mixture{0.5}}})));
  EXPECT_THAT(sheet.warnings, IsEmpty());
  ASSERT_EQ(sheet.rows.size(), 4U);
  for (const auto& row : sheet.rows) {
    EXPECT_EQ(row.record.test, TestKind::toughness);
    EXPECT_FALSE(row.record.other_columns.contains("order_id"));
    EXPECT_EQ(row.record.other_columns.at("tray"), "1");
  }
}

TEST_F(OrderedTest, OrdersOfOneDesignTestAndOrientationStayApart) {
  WantedSpecimens slow = coupon("r2/slow"), thin = coupon("r2/thin");
  slow.strain_rate_per_s = 6.17e-4;
  thin.thickness_mm = 1.6;
  const Job job = job_of({coupon("r2/fast"), slow, thin, coupon("r3/again")});
  std::set<std::string> names;
  for (const PrintModel& model : job.models) names.insert(model.name);
  EXPECT_EQ(names.size(), 4U) << "a folder for each";
  std::map<std::string, std::set<std::pair<double, double>>> conditions;
  std::map<std::string, int> specimens;
  for (const auto& row : measurement::read_specimen_sheet(write_table(job)).rows) {
    const std::string order = row.record.other_columns.at("order_id");
    conditions[order].emplace(row.record.conditions.strain_rate_per_s, row.record.conditions.thickness_mm);
    ++specimens[order];
  }
  using Conditions = std::set<std::pair<double, double>>;
  EXPECT_EQ(conditions["r2/fast"], (Conditions{{6.17e-3, 3.2}}));
  EXPECT_EQ(conditions["r2/slow"], (Conditions{{6.17e-4, 3.2}}));
  EXPECT_EQ(conditions["r2/thin"], (Conditions{{6.17e-3, 1.6}}));
  EXPECT_EQ(conditions["r3/again"], (Conditions{{6.17e-3, 3.2}}));
  for (const auto& [order, count] : specimens) EXPECT_EQ(count, 2) << order;
}

TEST_F(OrderedTest, ComesBackThroughTheImportAsItWasOrdered) {
  const WantedSpecimens ordered = coupon("r2/interface/tensile/discrimination-1");
  const Job job = job_of({ordered});
  double modulus_mpa = 2000.0;
  for (const PlacedSpecimen& specimen : job.specimens)
    write_file_atomically(folder_ / (specimen.label + ".csv"), export_without_time(ordered.loading, modulus_mpa++));
  const auto import = measurement::import_exports({}, write_table(job));
  for (const auto& fault : import.rejected) ADD_FAILURE() << to_string(fault);
  EXPECT_THAT(import.warnings, IsEmpty());
  ASSERT_EQ(import.specimens.size(), 2U);
  std::vector<measurement::SpecimenRecord> records;
  for (const auto& one : import.specimens) {
    const measurement::SpecimenRecord& record = records.emplace_back(one.record);
    EXPECT_TRUE(record.valid);
    EXPECT_EQ(record.test, TestKind::tensile);
    EXPECT_EQ(record.conditions, (tester::TestConditions{.strain_rate_per_s = 6.17e-3})) << "as ordered";
    EXPECT_TRUE(record.design == ordered.design);
    EXPECT_EQ(record.other_columns.at("order_id"), ordered.order_id);
    EXPECT_EQ(record.other_columns.at("tray"), "1");
    EXPECT_FALSE(measurement::missing_result(record));
  }
  measurement::write_measurement_set(folder_ / "set", records);
  const auto set = measurement::read_measurement_set(folder_ / "set");
  EXPECT_THAT(set.warnings, IsEmpty());
  EXPECT_EQ(set.specimens, records) << "the order among the columns that are kept";
}

}  // namespace
}  // namespace nacre::fabricate
