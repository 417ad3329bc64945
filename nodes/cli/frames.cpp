#include "frames.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/result.hpp"

namespace nacre::cli {
namespace {

constexpr int kPointsPerElement = 4;
using Colour = std::array<unsigned char, 3>;

/// Colour of an element by its material; energy of 0..1 tints it towards red.
Colour colour_of(std::uint8_t material, float energy) {
  constexpr std::array<Colour, 4> kBase = {Colour{30, 30, 30}, Colour{235, 235, 235}, Colour{140, 140, 140},
                                           Colour{60, 110, 200}};
  constexpr std::uint8_t kVoid = 3;
  Colour colour = kBase[std::min<std::size_t>(material, kVoid)];
  if (material >= kVoid) return colour;
  constexpr Colour kHot = {230, 40, 20};
  const float share = std::sqrt(std::clamp(energy, 0.0F, 1.0F));  // the root shows small energies too
  for (std::size_t i = 0; i < colour.size(); ++i) {
    colour[i] = static_cast<unsigned char>(std::lround((1.0F - share) * colour[i] + share * kHot[i]));
  }
  return colour;
}

/// Rows from the top, as pictures have them; frames have row 0 at the bottom.
std::vector<unsigned char> points_of(const tester::FractureFrame& frame, float largest_energy) {
  std::vector<unsigned char> points;
  for (int y = 0; y < frame.rows * kPointsPerElement; ++y) {
    for (int x = 0; x < frame.columns * kPointsPerElement; ++x) {
      const int row = frame.rows - 1 - y / kPointsPerElement;
      const auto element = static_cast<std::size_t>(row * frame.columns + x / kPointsPerElement);
      const float energy = largest_energy > 0.0F ? frame.energy_j_per_m3[element] / largest_energy : 0.0F;
      const Colour colour = colour_of(frame.material[element], energy);
      points.insert(points.end(), colour.begin(), colour.end());
    }
  }
  return points;
}

}  // namespace

void write_frames(const std::string& folder, const std::string& stem,
                  const std::vector<tester::FractureFrame>& frames) {
  float largest_energy = 0.0F;
  for (const auto& frame : frames) {
    for (const float energy : frame.energy_j_per_m3) largest_energy = std::max(largest_energy, energy);
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<unsigned char> points = points_of(frames[i], largest_energy);
    png_image picture{};
    picture.version = PNG_IMAGE_VERSION;
    picture.width = static_cast<png_uint_32>(frames[i].columns * kPointsPerElement);
    picture.height = static_cast<png_uint_32>(frames[i].rows * kPointsPerElement);
    picture.format = PNG_FORMAT_RGB;
    const auto path = std::filesystem::path(folder) / fmt::format("{}-{:04}.png", stem, i);
    if (png_image_write_to_file(&picture, path.c_str(), 0, points.data(), 0, nullptr) == 0) {
      throw InputError::format("{}: cannot be written: {}", path.string(), picture.message);
    }
  }
}

}  // namespace nacre::cli
