#include "animation/scene.hpp"

#include <cassert>

#include <fmt/format.h>

#include "animation/chart_panel.hpp"
#include "animation/panels.hpp"
#include "animation/specimen_panel.hpp"

namespace nacre::animation {
namespace {

void draw_title(Canvas& canvas, const film::Film& film) {
  std::string design = film.design;
  if (design.size() > 24) design = design.substr(0, 21) + "...";  // a layout without symmetry
  canvas.text({32.0, 40.0}, fmt::format("Fracture of {}", design), {.size = 21.0, .rgb = kInk, .bold = true});
  canvas.text(
      {32.0, 62.0},
      fmt::format("simulated notched specimen, {:.1f} \u00d7 {:.1f} mm, pulled vertically; deformation to scale",
                  1e3 * film.columns * film.element_size_m, 1e3 * film.rows * film.element_size_m),
      {.size = 13.0, .rgb = kFaint});
}

}  // namespace

Scene::Scene(const film::Film& film, int width_points) : film_(film), width_points_(width_points) {
  assert(width_points >= 320 && !film.frames.empty());
}

Picture Scene::draw(int frame) const {
  Canvas canvas(kSceneWidth, kSceneHeight, width_points_);
  canvas.fill(kPage);
  draw_title(canvas, film_);
  draw_specimen(canvas, film_, frame);
  draw_energy_scale(canvas, film_);
  draw_chart(canvas, film_, frame);
  return canvas.picture();
}

int Scene::hundredths_of_seconds(int frame) const {
  if (frame == 0) return 60;
  return frame + 1 == frame_count() ? 250 : 9;
}

}  // namespace nacre::animation
