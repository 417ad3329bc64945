#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "animation/picture.hpp"

namespace nacre::animation {

/// An endless GIF. Its 255 colours are the commonest of a few pictures; others take the nearest of them. Points that
/// stay as they were are left out.
struct Gif {
  int frame_count = 0;                            ///< >= 1
  std::function<Picture(int)> draw;               ///< all pictures have the size of the first; called twice for some
  std::function<int(int)> hundredths_of_seconds;  ///< duration of a picture
};

/// Writes the GIF, whole or not at all. Throws InputError naming the file.
void write_gif(const std::filesystem::path& path, const Gif& gif);

}  // namespace nacre::animation
