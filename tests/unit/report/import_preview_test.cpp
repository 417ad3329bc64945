#include "report/import_preview.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre::report {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A specimen of the sheet's `line`, with a curve or without.
measurement::ImportedSpecimen specimen(const std::string& name, int line, const std::string& piece) {
  measurement::ImportedSpecimen one{
      .record = {}, .file = "a.csv", .line = line, .maker = "table", .extension_column = ""};
  one.record.specimen = name;
  one.test.modulus_pa = 1.2e9;
  if (piece.empty()) {
    one.test.peak_stress_pa = 2e7;
    one.test.curve = {.strain = {0.0, 0.01, 0.02}, .stress_pa = {0.0, 1e7, 2e7}};
  } else {
    one.record.other_columns = {{"sample", piece}, {"temperature_c", "40"}};
    one.provenance["frequency_column"] = "Frequency (Hz)";
  }
  return one;
}

int occurrences(const std::string& page, const std::string& words) {
  int count = 0;
  for (std::size_t at = page.find(words); at != std::string::npos; at = page.find(words, at + 1)) ++count;
  return count;
}

TEST(ImportPreview, ASweepIsOneTableAndTestsWithCurvesHaveFigures) {
  measurement::Import import;
  import.specimens = {specimen("p-1", 2, "p"), specimen("p-2", 2, "p"), specimen("q-1", 3, "q"),
                      specimen("bar", 4, "")};
  const std::string page = import_preview(import, "sheet.csv");
  EXPECT_EQ(occurrences(page, "<article>"), 3);
  EXPECT_THAT(page, HasSubstr("<svg"));
  for (const char* words :
       {"<h2>p</h2>", "<h2>q</h2>", "<h2>bar</h2>", "<td>p-2</td>", "<td>40</td>", "Frequency (Hz)"})
    EXPECT_THAT(page, HasSubstr(words));
  import.specimens.pop_back();
  EXPECT_THAT(import_preview(import, "sheet.csv"), Not(HasSubstr("<svg")));
}

}  // namespace
}  // namespace nacre::report
