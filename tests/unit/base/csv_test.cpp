#include "base/csv.hpp"

#include <gtest/gtest.h>

namespace nacre {
namespace {

std::vector<CsvRow> rows_of(std::string_view text, const CsvLimits& limits = {}) {
  CsvReader reader(text, "table.csv", limits);
  std::vector<CsvRow> rows;
  CsvRow row;
  while (reader.next(row)) rows.push_back(row);
  return rows;
}

std::vector<std::string> texts(const CsvRow& row) {
  std::vector<std::string> result;
  for (const CsvCell& cell : row.cells) result.push_back(cell.text);
  return result;
}

using Texts = std::vector<std::string>;

TEST(Csv, LineEndingsAndByteOrderMarkDoNotChangeTheTable) {
  for (const char* text : {"a,b\n1,2\n", "a,b\r\n1,2\r\n",
                           "\xEF\xBB\xBF"
                           "a,b\n1,2",
                           "a,b\r\n1,2"}) {
    const auto rows = rows_of(text);
    ASSERT_EQ(rows.size(), 2u) << text;
    EXPECT_EQ(texts(rows[0]), (Texts{"a", "b"}));
    EXPECT_EQ(texts(rows[1]), (Texts{"1", "2"}));
  }
}

TEST(Csv, QuotedCellsHoldCommasLineBreaksAndQuotes) {
  const auto rows = rows_of("\"a,b\",\"say \"\"x\"\"\",\"two\r\nlines\"\n,last\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(texts(rows[0]), (Texts{"a,b", "say \"x\"", "two\r\nlines"}));
  EXPECT_EQ(texts(rows[1]), (Texts{"", "last"}));
  EXPECT_EQ(rows[1].line, 3);
}

TEST(Csv, CellsKnowTheirPlaceInCharacters) {
  const auto rows = rows_of("\xC2\xB5m,x\n\"y\nz\",w\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].cells[1].column, 4);
  EXPECT_EQ(rows[1].cells[1].line, 3);
  EXPECT_EQ(rows[1].cells[1].column, 4);
}

TEST(Csv, FaultyRowDoesNotLoseTheOthers) {
  for (const char* bad : {"x,b\"ad", "x,\"closed\" late", "x,\"never closed", "x,\xB5m", "x,\xED\xA0\x80"}) {
    const std::string text = std::string("h,k\n") + bad + "\n1,2\n";
    const auto rows = rows_of(text);
    ASSERT_EQ(rows.size(), 3u) << bad;
    EXPECT_FALSE(rows[1].fault.empty()) << bad;
    EXPECT_EQ(rows[1].fault_line, 2) << bad;
    EXPECT_GE(rows[1].fault_column, 3) << bad;
    EXPECT_EQ(texts(rows[2]), (Texts{"1", "2"})) << bad;
    EXPECT_EQ(rows[2].line, 3) << bad;
  }
}

TEST(Csv, LimitsAreEnforced) {
  CsvLimits limits;
  limits.rows = 2;
  EXPECT_THROW(rows_of("a\nb\nc\n", limits), InputError);
  EXPECT_NO_THROW(rows_of("a\nb\n", limits));
  limits = {};
  limits.cells_per_row = 3;
  EXPECT_TRUE(rows_of("1,2,3\n", limits)[0].fault.empty());
  EXPECT_FALSE(rows_of("1,2,3,4\n", limits)[0].fault.empty());
  limits = {};
  limits.bytes_per_cell = 4;
  EXPECT_TRUE(rows_of("1234\n", limits)[0].fault.empty());
  EXPECT_FALSE(rows_of("12345\n", limits)[0].fault.empty());
}

TEST(Csv, BlankRowsAreKnown) {
  const auto rows = rows_of("a\n\n,,\n b\n");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(rows[1].blank());
  EXPECT_TRUE(rows[2].blank());
  EXPECT_FALSE(rows[3].blank());
}

TEST(Csv, WhatIsWrittenIsReadBack) {
  for (const std::string text : {"plain", "a,b", "\"q\"", "two\nlines", " blank ", "", "\xC2\xB5"}) {
    const std::string line = csv_cell(text) + ",end\n";
    EXPECT_EQ(texts(rows_of(line)[0]), (Texts{text, "end"}));
  }
}

TEST(Csv, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(number_from_text(" 1.5e3 ").value(), 1500.0);
  EXPECT_EQ(number_from_text("+2").value(), 2.0);
  EXPECT_EQ(number_from_text("-0.25").value(), -0.25);
  for (const char* bad : {"", " ", "1,5", "nan", "inf", "1e999", "0x10", "1 2", "12mm", "+-1", "+"}) {
    EXPECT_FALSE(number_from_text(bad)) << bad;
  }
  EXPECT_EQ(integer_from_text("-7").value(), -7);
  for (const char* bad : {"1.5", "3000000000", "x", ""}) EXPECT_FALSE(integer_from_text(bad)) << bad;
}

}  // namespace
}  // namespace nacre
