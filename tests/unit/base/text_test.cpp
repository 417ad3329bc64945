#include <gtest/gtest.h>

#include "base/big_endian.hpp"
#include "base/lines.hpp"
#include "base/names.hpp"

namespace nacre {
namespace {

using Lines = std::vector<std::string_view>;

TEST(Lines, EndWithLfOrCrlfOrTheText) {
  EXPECT_EQ(lines_in("a\r\n\nb"), (Lines{"a", "", "b"}));
  EXPECT_EQ(lines_in("a\n"), Lines{"a"});
  EXPECT_EQ(lines_in("a\rb"), Lines{"a\rb"});
  EXPECT_EQ(lines_in(""), Lines{});
}

TEST(LowerCase, LeavesWhatIsNoAsciiCapital) { EXPECT_EQ(lower_case("Az[@\u00c9 9"), "az[@\u00c9 9"); }

TEST(BigEndian, ReadsWhatItWrote) {
  std::string bytes;
  append_big_endian(bytes, 0x0102ff, 4);
  EXPECT_EQ(bytes, std::string("\x00\x01\x02\xff", 4));
  EXPECT_EQ(read_big_endian(bytes), 0x0102ffu);
}

}  // namespace
}  // namespace nacre
