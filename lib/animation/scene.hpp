#pragma once

#include "animation/picture.hpp"
#include "film/film.hpp"

namespace nacre::animation {

/// Draws a film for people: the deformed specimen between its grips with the energy density over the materials, failed
/// elements left out (those that failed since the frame before bright), letters at toughening mechanisms
/// (crack/marks.hpp), colour scale, scale bar, and the stress-strain curve with a marker. 16:9.
class Scene {
 public:
  /// The film must outlive the scene. width_points >= 320.
  explicit Scene(const film::Film& film, int width_points = 960);

  int frame_count() const { return film_.frames.size(); }
  Picture draw(int frame) const;
  /// Duration of the frame: longer for the first and the last.
  int hundredths_of_seconds(int frame) const;

 private:
  const film::Film& film_;
  int width_points_;
};

}  // namespace nacre::animation
