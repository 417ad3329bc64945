#include "pattern/png.hpp"

#include <png.h>

#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::pattern {
namespace {

using ::testing::HasSubstr;

class Png : public ::testing::Test {
 protected:
  std::filesystem::path path_ = ::testing::TempDir() + "/nacre_png_test.png";
  ~Png() override { std::filesystem::remove(path_); }

  /// A picture of any format, points in rows from the top.
  void write(int width, int height, png_uint_32 format, const std::vector<unsigned char>& points) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    ASSERT_EQ(points.size(), PNG_IMAGE_SIZE(image));
    ASSERT_TRUE(png_image_write_to_file(&image, path_.c_str(), 0, points.data(), 0, nullptr));
  }
  std::string reading_error() {
    try {
      read_png(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(Png, LayoutsSurviveAnyScale) {
  RandomStream random(1, "test");
  for (const int scale : {1, 2, 7, 30}) {
    const Layout layout = random_pattern(random).layout();
    write_png(layout, path_, scale);
    EXPECT_EQ(read_png(path_), layout);
  }
  write_png(laminate(LayerDirection::along_x, 4, 1), path_, 3);
  EXPECT_EQ(read_png(path_), laminate(LayerDirection::along_x, 4, 1));
}

TEST_F(Png, ColoursAreReadByTheirGreyAndTheMeanOfAPixelDecides) {
  // 40 x 40 points; pixel (0, 0) three quarters white, pixel (0, 1) one quarter white, the rest light yellow.
  std::vector<unsigned char> points(40 * 40 * 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = i % 3 == 2 ? 120 : 240;
  const auto set = [&](int row, int column, unsigned char value) {
    for (int k = 0; k < 3; ++k) points[static_cast<std::size_t>((row * 40 + column) * 3 + k)] = value;
  };
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 4; ++c) set(r, c, 255);
  }
  set(1, 1, 0);
  set(0, 2, 0), set(1, 2, 0), set(1, 3, 0);
  write(40, 40, PNG_FORMAT_RGB, points);
  const Layout layout = read_png(path_);
  EXPECT_TRUE(layout.rigid(0, 0));
  EXPECT_FALSE(layout.rigid(0, 1));
  EXPECT_TRUE(layout.rigid(7, 7));
  EXPECT_EQ(layout.rigid_count(), 399);
}

TEST_F(Png, ThresholdLiesAtMidGrey) {
  std::vector<unsigned char> points(400, 127);
  points[5] = 128;
  write(20, 20, PNG_FORMAT_GRAY, points);
  const Layout layout = read_png(path_);
  EXPECT_EQ(layout.rigid_count(), 1);
  EXPECT_TRUE(layout.rigid(0, 5));
}

TEST_F(Png, TransparencyCountsAsBlack) {
  std::vector<unsigned char> points(400 * 2, 255);
  points[1] = 0;
  write(20, 20, PNG_FORMAT_GA, points);
  EXPECT_EQ(read_png(path_).rigid_count(), 399);
}

TEST_F(Png, ErrorsNameTheFileAndWhatWasExpected) {
  EXPECT_THAT(reading_error(), HasSubstr(path_.string() + ": cannot be read"));
  write_file_atomically(path_, "no picture at all, but long enough to be looked at");
  EXPECT_THAT(reading_error(), HasSubstr(path_.string() + ": no readable PNG picture"));
  write(30, 30, PNG_FORMAT_GRAY, std::vector<unsigned char>(900, 0));
  EXPECT_THAT(reading_error(), HasSubstr("30 x 30 points, expected 20 k x 20 k"));
  write(20, 40, PNG_FORMAT_GRAY, std::vector<unsigned char>(800, 0));
  EXPECT_THAT(reading_error(), HasSubstr("20 x 40 points"));
  write_png(Layout(), path_, 10);
  const std::string whole = read_file(path_);
  write_file_atomically(path_, whole.substr(0, whole.size() / 2));
  EXPECT_THAT(reading_error(), HasSubstr(path_.string() + ": no readable PNG picture"));
  EXPECT_THROW(write_png(Layout(), path_, 0), InputError);
  EXPECT_THROW(write_png(Layout(), path_, 513), InputError);
  EXPECT_THROW(write_png(Layout(), "no/such/folder/picture.png"), InputError);
}

}  // namespace
}  // namespace nacre::pattern
