#include "diagnosis/table_trends.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::diagnosis {
namespace {

namespace fs = std::filesystem;

/// Measured values that grow with `age`, beside constant predictions; lines 2 to 7.
const std::string kGoodRows = "1.0,1,1,a\n1.1,1,2,b\n1.2,1,3,c\n1.3,1,4,d\n1.4,1,5,e\n1.5,1,6,f\n";

TableTrends trends_of(const std::string& rows, const std::string& heading = "y,f,age,name") {
  const fs::path file = fs::temp_directory_path() / ("nacre-trends-" + std::to_string(::getpid()) + ".csv");
  write_file_atomically(file, heading + "\n" + rows);
  TableTrends trends = table_trends(file, "y", "f", 1, 100);
  fs::remove(file);
  return trends;
}

TEST(TableTrends, RowsThatCannotBeUsedAreNamedAndChangeNothing) {
  const TableTrends good = trends_of(kGoodRows);
  ASSERT_EQ(good.trends.size(), 1u);
  EXPECT_NEAR(good.trends[0].spearman, 1.0, 1e-12);
  EXPECT_TRUE(good.rejected.empty());
  const TableTrends some = trends_of(kGoodRows +
                                     "1,5,1,0,7,g\n"     // decimal commas
                                     "nan,1,8,h\n"       // no number where one must be
                                     "1.7,-1,9,i\n"      // no logarithm
                                     "1.8,1,nan,j\n"     // elsewhere
                                     "1.9,1,2,\"open\n"  // a quote without an end
                                     "2.0,1\n");
  ASSERT_EQ(some.rejected.size(), 6u);
  const std::vector<std::pair<int, std::string>> places = {{8, ""},     {9, "y"},     {10, "f"},
                                                           {11, "age"}, {12, "name"}, {13, ""}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(some.rejected[i].line, places[i].first);
    EXPECT_EQ(some.rejected[i].column, places[i].second);
    EXPECT_FALSE(some.rejected[i].reason.empty());
  }
  ASSERT_EQ(some.trends.size(), 1u);
  EXPECT_EQ(some.trends[0].rows, good.trends[0].rows);
  EXPECT_EQ(some.trends[0].spearman, good.trends[0].spearman);
}

TEST(TableTrends, WordsAndEmptyCellsOfOtherColumnsAreNoFault) {
  EXPECT_TRUE(trends_of(kGoodRows + "1.6,1,,\n1.7,1,old,g\n").rejected.empty());
}

TEST(TableTrends, AColumnThatIsMissingOrStandsTwiceIsRefused) {
  EXPECT_THROW(trends_of(kGoodRows, "y,f,f,name"), InputError);
  EXPECT_THROW(trends_of(kGoodRows, "x,f,age,name"), InputError);
}

}  // namespace
}  // namespace nacre::diagnosis
