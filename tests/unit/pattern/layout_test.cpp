#include "pattern/pattern_key.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/random.hpp"

namespace nacre::pattern {
namespace {

using ::testing::HasSubstr;

Layout random_layout(RandomStream& random) {
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) layout.set(r, c, random.uniform() < 0.5);
  }
  return layout;
}

Pattern random_bits(RandomStream& random) { return Pattern(random.bits() >> (64 - kFreePixels)); }

TEST(Pattern, PublishedPatternsHaveTheirKeys) {
  const std::pair<const char*, const char*> published[] = {{"published_a", "577fffe9fffdef"},
                                                           {"published_b", "3ffc9b4ad4d2d9"}};
  for (const auto& [file, key] : published) {
    const std::string path = std::string(NACRE_SOURCE_DIR) + "/data/patterns/" + file + ".txt";
    const Result<Layout> layout = layout_from_text(read_file(path), path);
    ASSERT_TRUE(layout) << layout.error().message;
    EXPECT_TRUE(layout->has_eightfold_symmetry());
    EXPECT_EQ(key_of(*layout), key);
    EXPECT_EQ(layout_from_key(key).value(), *layout);
  }
}

TEST(Pattern, EveryPatternIsInvariantUnderTheEightSymmetries) {
  RandomStream random(1, "test");
  for (int i = 0; i < 200; ++i) {
    const Layout layout = random_bits(random).layout();
    EXPECT_EQ(layout, layout.rotated());
    EXPECT_EQ(layout, layout.transposed());
    EXPECT_TRUE(layout.has_eightfold_symmetry());
  }
}

TEST(Pattern, BitsKeyAndLayoutTellTheSame) {
  RandomStream random(2, "test");
  for (int i = 0; i < 200; ++i) {
    const Pattern pattern = random_bits(random);
    EXPECT_EQ(Pattern::from_layout(pattern.layout()), pattern);
    EXPECT_EQ(layout_from_key(pattern.key()).value(), pattern.layout());
    EXPECT_EQ(key_of(pattern.layout()), pattern.key());
    EXPECT_EQ(pattern.rigid_count(), pattern.layout().rigid_count());
  }
}

TEST(Pattern, OrbitsCoverAllPixelsOnce) {
  std::array<int, kFreePixels> images{};
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) ++images[Pattern::free_index(r, c)];
  }
  for (int i = 0; i < kFreePixels; ++i) EXPECT_EQ(images[i], Pattern::orbit_size(i));
  EXPECT_EQ(Pattern::free_index(0, 0), 0);
  EXPECT_EQ(Pattern::free_index(0, 9), 9);
  EXPECT_EQ(Pattern::free_index(1, 1), 10);
  EXPECT_EQ(Pattern::free_index(9, 9), 54);
}

TEST(Pattern, SettingAPixelSetsItsImagesAndNothingElse) {
  Pattern pattern;
  pattern.set(17, 3, true);
  EXPECT_EQ(pattern.rigid_count(), 8);
  Layout layout = pattern.layout();
  for (const auto& [r, c] : {std::pair{2, 3}, {2, 16}, {17, 3}, {17, 16}, {3, 2}, {16, 2}, {3, 17}, {16, 17}}) {
    EXPECT_TRUE(layout.rigid(r, c));
  }
  pattern.set(3, 2, false);
  EXPECT_EQ(pattern, Pattern());
}

TEST(Pattern, PixelDifferenceCountsDifferingPixelsOfTheWholeUnit) {
  RandomStream random(3, "test");
  for (int i = 0; i < 50; ++i) {
    const Pattern a = random_bits(random), b = random_bits(random);
    int differing = 0;
    for (int r = 0; r < kSide; ++r) {
      for (int c = 0; c < kSide; ++c) differing += a.layout().rigid(r, c) != b.layout().rigid(r, c);
    }
    EXPECT_EQ(pixel_difference(a, b), differing);
    EXPECT_EQ(pixel_difference(a, a), 0);
  }
}

TEST(Layout, RotationIsCounterClockwiseAndFourTimesNothing) {
  Layout layout;
  layout.set(0, 0, true);  // upper left goes to lower left
  EXPECT_TRUE(layout.rotated().rigid(kSide - 1, 0));
  RandomStream random(4, "test");
  const Layout any = random_layout(random);
  EXPECT_NE(any.rotated(), any);
  EXPECT_EQ(any.rotated().rotated().rotated().rotated(), any);
  EXPECT_EQ(any.transposed().transposed(), any);
}

TEST(Layout, AsymmetricLayoutsSurviveKeyAndText) {
  RandomStream random(5, "test");
  for (int i = 0; i < 50; ++i) {
    const Layout layout = random_layout(random);
    const std::string key = key_of(layout);
    ASSERT_EQ(key.size(), 101u);
    EXPECT_EQ(layout_from_key(key).value(), layout);
    EXPECT_EQ(layout_from_text(to_text(layout), "text").value(), layout);
    EXPECT_FALSE(Pattern::from_layout(layout));
  }
}

TEST(Layout, FirstDigitOfALayoutKeyIsTheUpperLeftCorner) {
  Layout layout;
  layout.set(0, 0, true);
  EXPECT_EQ(key_of(layout), "L8" + std::string(99, '0'));
}

TEST(LayoutText, AByteOrderMarkIsPassedOver) {
  const std::string text = to_text(Layout{});
  EXPECT_EQ(layout_from_text("\xEF\xBB\xBF" + text, "text").value(), Layout{});
  EXPECT_FALSE(layout_from_text("\xEF\xBB\xBF\xEF\xBB\xBF" + text, "text"));
}

TEST(LayoutText, AcceptsCarriageReturnsMissingLastNewlineAndTrailingBlankLines) {
  Layout layout;
  layout.set(3, 4, true);
  std::string crlf;
  for (const char c : to_text(layout)) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(layout_from_text(crlf, "text").value(), layout);
  EXPECT_EQ(layout_from_text(crlf + "\r\n \n\n", "text").value(), layout);
  std::string open = to_text(layout);
  open.pop_back();
  EXPECT_EQ(layout_from_text(open, "text").value(), layout);
}

TEST(LayoutText, ErrorsNameFileLineColumnAndWhatWasExpected) {
  const std::string good = to_text(Layout());
  const auto error = [](const std::string& text) { return layout_from_text(text, "p.txt").error().message; };
  std::string wrong = good;
  wrong[21 * 2 + 6] = '2';
  EXPECT_THAT(error(wrong),
              HasSubstr("p.txt: line 3, column 7: '2', expected 20 lines of 20 characters 0 (soft) or 1 (rigid)"));
  wrong[21 * 2 + 6] = '\xff';
  EXPECT_THAT(error(wrong), HasSubstr("byte 0xff"));
  EXPECT_THAT(error(good + "00000000000000000000\n"), HasSubstr("line 21, column 1: more than 20 lines"));
  EXPECT_THAT(error(good.substr(21)), HasSubstr("line 20, column 1: the text ends after 19 lines"));
  EXPECT_THAT(error(""), HasSubstr("line 1, column 1: the text ends after 0 lines"));
  EXPECT_THAT(error(good.substr(1)), HasSubstr("line 1, column 20: the line has 19 characters"));
  EXPECT_THAT(error("0" + good), HasSubstr("line 1, column 21: the line has 21 characters"));
  EXPECT_THAT(error("\n" + good), HasSubstr("line 1, column 1: the line has 0 characters"));
}

TEST(LayoutKey, ErrorsSayWhatWasExpected) {
  const auto error = [](const std::string& key) { return layout_from_key(key).error().message; };
  EXPECT_THAT(error("577fffe9fffdeF"), HasSubstr("character 14: expected a lower-case hex digit"));
  EXPECT_THAT(error("ffffffffffffff"), HasSubstr("expected at most 7fffffffffffff"));
  EXPECT_THAT(error("577"), HasSubstr("expected 14 lower-case hex digits"));
  EXPECT_THAT(error(""), HasSubstr("expected 14"));
  EXPECT_THAT(error("L" + std::string(99, '0') + "g"), HasSubstr("character 101"));
}

TEST(LayoutKey, OfAPatternHasTheSymmetry) {
  EXPECT_EQ(pattern_from_key("577fffe9fffdef").value().key(), "577fffe9fffdef");
  EXPECT_THAT(pattern_from_key("577").error().message, HasSubstr("expected 14 lower-case hex digits"));
  EXPECT_THAT(pattern_from_key("L8" + std::string(99, '0')).error().message, HasSubstr("eightfold symmetry"));
}

}  // namespace
}  // namespace nacre::pattern
