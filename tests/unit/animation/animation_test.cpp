#include <gif_lib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "animation/canvas.hpp"
#include "animation/colour.hpp"
#include "animation/gif.hpp"
#include "animation/panels.hpp"
#include "animation/scene.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "pattern/phase_colours.hpp"

namespace nacre::animation {
namespace {

namespace fs = std::filesystem;

/// A specimen of 40 x 40 elements that tears at half height from the left, one element per frame.
film::Film tearing() {
  film::Film film;
  film.design = "577fffe9fffdef";
  film.columns = film.rows = 40;
  film.element_size_m = 260e-6;
  film.toughness_pa = 2e5;
  film.peak_stress_pa = 4e6;
  film.failure_strain = 0.05;
  film.curve = {{0.0, 0.04, 0.05}, {0.0, 4e6, 1e5}};
  film.material.assign(1600, 1);
  film.largest_energy_j_per_m3 = 1e7;
  film.displacement_step_m = 30e-6;
  for (int i = 0; i < 6; ++i) {
    if (i > 0) film.crack.order.push_back({20 * 40 + i, 0.01 * i});
    film.frames.push_back({.strain = 0.01 * i,
                           .stress_pa = 1e6 * i,
                           .broken = i,
                           .energy_level = std::vector<std::uint8_t>(1600, static_cast<std::uint8_t>(8 * i)),
                           .displacement_step = std::vector<std::int16_t>(2 * 41 * 41, 0)});
  }
  return film;
}

double luminance(std::uint32_t rgb) {
  return 0.2126 * (rgb >> 16 & 0xff) + 0.7152 * (rgb >> 8 & 0xff) + 0.0722 * (rgb & 0xff);
}

TEST(Colour, TheGlowRisesEvenlyInLightness) {
  for (int i = 1; i <= 40; ++i) EXPECT_GT(luminance(glow(i / 40.0)), luminance(glow((i - 1) / 40.0))) << i;
}

TEST(Colour, BlendsReachBothEnds) {
  EXPECT_EQ(blend(0x123456, 0xfedcba, 0.0), 0x123456u);
  EXPECT_EQ(blend(0x123456, 0xfedcba, 1.0), 0xfedcbau);
}

TEST(Colour, UnstrainedElementsHaveTheColoursOfTheirPhases) {
  EXPECT_EQ(element_colour(0, 0.0), pattern::kSoftRgb);
  EXPECT_EQ(element_colour(1, 0.0), pattern::kRigidRgb);
  EXPECT_EQ(element_colour(2, 0.0), pattern::kInterfaceRgb);
}

TEST(Colour, MaterialsDifferAtRestAndAgreeUnderTheGlow) {
  EXPECT_LT(luminance(element_colour(0, 0.0)) + 30.0, luminance(element_colour(2, 0.0)));
  EXPECT_LT(luminance(element_colour(2, 0.0)) + 30.0, luminance(element_colour(1, 0.0)));
  EXPECT_EQ(element_colour(0, 1.0), element_colour(1, 1.0));
}

TEST(Canvas, QuadsThatMeetLeaveNoSeam) {
  Canvas canvas(10.0, 10.0, 73);
  canvas.fill(0xffffff);
  std::vector<std::array<CanvasPoint, 4>> quads;
  for (double y = 0.0; y < 10.0; ++y)
    for (double x = 0.0; x < 10.0; ++x) quads.push_back({{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
  canvas.quads(quads, 0x336699);
  const Picture picture = canvas.picture();
  EXPECT_TRUE(std::all_of(picture.rgb.begin(), picture.rgb.end(), [](auto rgb) { return rgb == 0x336699u; }));
}

TEST(Scene, ShowsTheTearWhereElementsFailed) {
  const film::Film film = tearing();
  const Scene scene(film, 960);
  const auto count = [&](int frame, std::uint32_t rgb) {
    const Picture picture = scene.draw(frame);
    // The specimen's half: the marker of the curve has the same colour.
    long points = 0;
    for (int y = 0; y < picture.height * 9 / 10; ++y)
      for (int x = 0; x < picture.width / 2; ++x) points += picture.rgb[y * picture.width + x] == rgb;
    return points;
  };
  EXPECT_EQ(count(0, kAccent), 0);
  EXPECT_GT(count(3, kAccent), 20) << "the element that just failed";
  EXPECT_GT(count(0, element_colour(1, 0.0)), 50'000);
  EXPECT_EQ(count(5, element_colour(1, 0.0)), 0) << "all of it is under energy";
}

TEST(Scene, PicturesKeepTheirSizeAndShape) {
  const film::Film film = tearing();
  for (const int width : {320, 960, 1920}) {
    const Picture picture = Scene(film, width).draw(2);
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, width * 9 / 16);
  }
}

TEST(Gif, HoldsAllFramesWithTheirTimesAndColours) {
  const fs::path path = fs::path(testing::TempDir()) / "nacre_animation_test.gif";
  const auto draw = [](int frame) {
    Picture picture{.width = 7, .height = 5, .rgb = std::vector<std::uint32_t>(35, 0x102030)};
    picture.rgb[frame] = 0xff0000;
    return picture;
  };
  write_gif(path, {.frame_count = 4, .draw = draw, .hundredths_of_seconds = [](int frame) { return 10 + frame; }});
  int error = 0;
  GifFileType* gif = DGifOpenFileName(path.c_str(), &error);
  ASSERT_NE(gif, nullptr);
  ASSERT_EQ(DGifSlurp(gif), GIF_OK);
  EXPECT_EQ(gif->SWidth, 7);
  EXPECT_EQ(gif->SHeight, 5);
  ASSERT_EQ(gif->ImageCount, 4);
  std::vector<std::uint32_t> shown(35, 1);
  for (int i = 0; i < 4; ++i) {
    GraphicsControlBlock control;
    ASSERT_EQ(DGifSavedExtensionToGCB(gif, i, &control), GIF_OK);
    EXPECT_EQ(control.DelayTime, 10 + i);
    const SavedImage& image = gif->SavedImages[i];
    for (int y = 0; y < image.ImageDesc.Height; ++y)
      for (int x = 0; x < image.ImageDesc.Width; ++x) {
        const int index = image.RasterBits[y * image.ImageDesc.Width + x];
        if (index == control.TransparentColor) continue;
        const GifColorType& c = gif->SColorMap->Colors[index];
        shown[(y + image.ImageDesc.Top) * 7 + x + image.ImageDesc.Left] =
            static_cast<std::uint32_t>(c.Red << 16 | c.Green << 8 | c.Blue);
      }
    EXPECT_EQ(shown, draw(i).rgb) << "frame " << i;
  }
  DGifCloseFile(gif, &error);
  fs::remove(path);
}

TEST(Gif, AFolderThatIsNotThereIsNamed) {
  const Gif gif{.frame_count = 1,
                .draw =
                    [](int) {
                      return Picture{1, 1, {0}};
                    },
                .hundredths_of_seconds = [](int) { return 1; }};
  try {
    write_gif("/nowhere/at/all.gif", gif);
    FAIL() << "it was written";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("/nowhere/at/all.gif"));
  }
}

TEST(Png, IsReadableAndAsLargeAsItsPicture) {
  const fs::path path = fs::path(testing::TempDir()) / "nacre_animation_test.png";
  const film::Film film = tearing();
  write_png(path, Scene(film, 320).draw(0));
  EXPECT_TRUE(read_file(path).starts_with("\x89PNG"));
  fs::remove(path);
}

}  // namespace
}  // namespace nacre::animation
