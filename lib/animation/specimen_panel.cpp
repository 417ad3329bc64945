#include "animation/specimen_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "animation/colour.hpp"
#include "animation/panels.hpp"
#include "crack/marks.hpp"

namespace nacre::animation {
namespace {

constexpr double kLeft = 40.0, kRight = 520.0, kTop = 98.0, kBottom = 474.0;
constexpr double kGripHeight = 9.0;
constexpr std::uint32_t kGrip = 0x39414d;
constexpr int kVoid = 3;

/// From the specimen's metres to the picture. The lower grip stays where it is; there is room for the whole pull.
struct Placement {
  double scale = 1.0, left = 0.0;

  explicit Placement(const film::Film& film) {
    const double width_m = film.columns * film.element_size_m;
    const double height_m = film.rows * film.element_size_m * (1.0 + film.failure_strain);
    scale = std::min((kRight - kLeft) / width_m, (kBottom - kTop - 2.0 * kGripHeight) / height_m);
    left = 0.5 * (kLeft + kRight - scale * width_m);
  }
  CanvasPoint at(double x_m, double y_m) const { return {left + scale * x_m, kBottom - kGripHeight - scale * y_m}; }
};

std::vector<CanvasPoint> node_positions(const film::Film& film, const film::FilmFrame& frame,
                                        const Placement& placement) {
  std::vector<CanvasPoint> positions;
  positions.reserve(film.node_count());
  for (int node = 0; node < film.node_count(); ++node) {
    const double x_m = (node % (film.columns + 1)) * film.element_size_m + film.displacement_x_m(frame, node);
    const double y_m = (node / (film.columns + 1)) * film.element_size_m + film.displacement_y_m(frame, node);
    positions.push_back(placement.at(x_m, y_m));
  }
  return positions;
}

/// Per element: intact (0), failed before the frame before or empty from the start (1), or failed since (2).
std::vector<int> ages(const film::Film& film, int frame) {
  std::vector<int> age(film.material.size(), 0);
  for (std::size_t e = 0; e < age.size(); ++e) age[e] = film.material[e] == kVoid ? 1 : 0;
  const int now = film.frames[frame].broken;
  const int before = film.frames[std::max(frame - 1, 0)].broken;
  for (int i = 0; i < now; ++i) age[film.crack.order[i].element] = i < before ? 1 : 2;
  return age;
}

void draw_elements(Canvas& canvas, const film::Film& film, int index, const Placement& placement) {
  const film::FilmFrame& frame = film.frames[index];
  const std::vector<CanvasPoint> node = node_positions(film, frame, placement);
  const std::vector<int> age = ages(film, index);
  std::map<std::uint32_t, std::vector<std::array<CanvasPoint, 4>>> by_colour;
  std::vector<std::array<CanvasPoint, 4>> fresh;
  for (int row = 0; row < film.rows; ++row)
    for (int column = 0; column < film.columns; ++column) {
      const auto e = static_cast<std::size_t>(row * film.columns + column);
      if (age[e] == 1) continue;
      const auto corner = static_cast<std::size_t>(row * (film.columns + 1) + column);
      const std::size_t above = corner + static_cast<std::size_t>(film.columns) + 1;
      const std::array<CanvasPoint, 4> quad = {node[corner], node[corner + 1], node[above + 1], node[above]};
      const double level = frame.energy_level[e] / (film::kEnergyLevels - 1.0);
      age[e] == 2 ? fresh.push_back(quad) : by_colour[element_colour(film.material[e], level)].push_back(quad);
    }
  for (const auto& [rgb, quads] : by_colour) canvas.quads(quads, rgb);
  canvas.quads(fresh, kAccent);
}

struct MarkStyle {
  const char* letter;
  std::uint32_t rgb;
};
constexpr std::array<MarkStyle, crack::kMarkKinds> kMarkStyles = {
    {{"D", 0x7a3fb0}, {"B", 0xb0307a}, {"L", 0x2d7d46}, {"A", 0xb05a00}, {"G", 0x4a5568}}};

MarkStyle style_of(crack::MarkKind kind) { return kMarkStyles[static_cast<std::size_t>(kind)]; }

void draw_tag(Canvas& canvas, CanvasPoint at, const MarkStyle& style) {
  constexpr double kRadius = 7.5;
  canvas.disc(at, kRadius + 1.2, kPage);
  canvas.disc(at, kRadius, style.rgb);
  canvas.text({at.x, at.y + 3.9}, style.letter,
              {.size = 11.0, .rgb = kPage, .bold = true, .anchor = TextAnchor::centre});
}

/// The specimen before the test, with the data that marks need.
fem::Grid grid_of(const film::Film& film) {
  fem::Grid grid;
  grid.columns = film.columns;
  grid.rows = film.rows;
  grid.element_size_m = film.element_size_m;
  for (const std::uint8_t material : film.material) grid.phase.push_back(static_cast<fem::Phase>(material));
  return grid;
}

/// Letters next to the crack where a mechanism acts at this moment, and their meaning.
void draw_marks(Canvas& canvas, const film::Film& film, int index, const Placement& placement) {
  const film::FilmFrame& frame = film.frames[index];
  const std::vector<crack::Mark> marks = crack::marks_of(grid_of(film), film.crack);
  const std::vector<CanvasPoint> node = node_positions(film, frame, placement);
  constexpr double kAside = 14.0;  // so that the crack itself stays visible
  constexpr int kMostOfAKind = 5;  // more would cover the specimen; branches come longest first
  std::array<int, crack::kMarkKinds> shown{};
  for (const crack::Mark& mark : marks) {
    if (frame.strain < mark.strain || frame.strain > mark.until_strain) continue;
    if (++shown[static_cast<std::size_t>(mark.kind)] > kMostOfAKind) continue;
    const int corner = mark.element / film.columns * (film.columns + 1) + mark.element % film.columns;
    const CanvasPoint at = node[corner];
    const bool above = mark.kind == crack::MarkKind::bridging || mark.kind == crack::MarkKind::soft_arrest;
    const double left = mark.kind == crack::MarkKind::deflection ? kAside : 0.0;  // a guided stretch often has its turn
    draw_tag(canvas, {at.x - left, at.y + (above ? -kAside : kAside)}, style_of(mark.kind));
  }
  double x = kLeft;
  for (int kind = 0; kind < crack::kMarkKinds; ++kind) {
    const auto mark_kind = static_cast<crack::MarkKind>(kind);
    if (std::ranges::count(marks, mark_kind, &crack::Mark::kind) == 0) continue;
    const TextStyle style{.size = 12.0, .rgb = kInk};
    const std::string name(crack::to_string(mark_kind));
    draw_tag(canvas, {x + 8.0, 523.0}, style_of(mark_kind));
    canvas.text({x + 20.0, 527.0}, name, style);
    x += 20.0 + canvas.text_width(name, style) + 14.0;
  }
}

void draw_grips(Canvas& canvas, const film::Film& film, const film::FilmFrame& frame, const Placement& placement) {
  const double width_m = film.columns * film.element_size_m, height_m = film.rows * film.element_size_m;
  const CanvasPoint lower = placement.at(0.0, 0.0), upper = placement.at(0.0, height_m * (1.0 + frame.strain));
  const double width = placement.scale * width_m;
  canvas.rectangle({lower.x - 8.0, lower.y}, width + 16.0, kGripHeight, kGrip);
  canvas.rectangle({upper.x - 8.0, upper.y - kGripHeight}, width + 16.0, kGripHeight, kGrip);
  const double x = lower.x + 0.5 * width, y = upper.y - kGripHeight - 3.0;
  const std::array<CanvasPoint, 3> arrow = {{{x - 5.0, y}, {x + 5.0, y}, {x, y - 8.0}}};
  canvas.area(arrow, kGrip);
}

/// A length of 1, 2 or 5 times a power of ten, about a fifth of the specimen's width.
double round_length_mm(double width_mm) {
  const double wanted = width_mm / 4.0, decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= wanted) return factor * decade;
  return decade;
}

void draw_legend(Canvas& canvas, const film::Film& film, const Placement& placement) {
  const double y = 506.0;
  const double length_mm = round_length_mm(1e3 * film.columns * film.element_size_m);
  const double length = placement.scale * 1e-3 * length_mm;
  const double left = placement.at(0.0, 0.0).x;
  const std::array<CanvasPoint, 2> bar = {{{left, y - 4.5}, {left + length, y - 4.5}}};
  canvas.line(bar, 2.5, kInk);
  canvas.text({left + length + 8.0, y}, fmt::format("{:g} mm", length_mm), {.size = 13.0, .rgb = kInk});
  struct ColourKey {
    const char* name;
    std::uint32_t rgb;
  };
  const std::array<ColourKey, 4> entries = {{{"rigid", element_colour(1, 0.0)},
                                             {"interface", element_colour(2, 0.0)},
                                             {"soft", element_colour(0, 0.0)},
                                             {"failing", kAccent}}};
  double x = left + length + 78.0;
  for (const ColourKey& entry : entries) {
    canvas.rectangle({x, y - 10.0}, 11.0, 11.0, entry.rgb);
    const TextStyle style{.size = 13.0, .rgb = kInk};
    canvas.text({x + 16.0, y}, entry.name, style);
    x += 16.0 + canvas.text_width(entry.name, style) + 16.0;
  }
}

}  // namespace

void draw_specimen(Canvas& canvas, const film::Film& film, int index) {
  const Placement placement(film);
  draw_elements(canvas, film, index, placement);
  draw_grips(canvas, film, film.frames[index], placement);
  draw_legend(canvas, film, placement);
  draw_marks(canvas, film, index, placement);
}

void draw_energy_scale(Canvas& canvas, const film::Film& film) {
  constexpr double kX = 548.0, kWidth = 14.0, kHighest = 128.0, kLowest = 456.0;
  const double step = (kLowest - kHighest) / film::kEnergyLevels;
  for (int level = 0; level < film::kEnergyLevels; ++level) {
    const double y = kLowest - (level + 1) * step, share = level / (film::kEnergyLevels - 1.0);
    canvas.rectangle({kX, y}, 0.5 * kWidth, step + 0.6, element_colour(1, share));
    canvas.rectangle({kX + 0.5 * kWidth, y}, 0.5 * kWidth, step + 0.6, element_colour(0, share));
  }
  canvas.text({kX - 2.0, kHighest - 24.0}, "energy density", {.size = 12.0, .rgb = kInk});
  canvas.text({kX - 2.0, kHighest - 9.0}, "in J/m\u00b3", {.size = 12.0, .rgb = kFaint});
  static constexpr std::array<const char*, 10> kPowers = {"1",        "10",       "10\u00b2", "10\u00b3", "10\u2074",
                                                          "10\u2075", "10\u2076", "10\u2077", "10\u2078", "10\u2079"};
  const double highest = std::log10(film.largest_energy_j_per_m3);
  for (std::size_t power = 0; power < kPowers.size(); ++power) {
    const double share = 1.0 - (highest - static_cast<double>(power)) / film::kEnergyDecades;
    if (share < 0.0 || share > 1.0) continue;
    const double y = kLowest - share * (kLowest - kHighest);
    const std::array<CanvasPoint, 2> tick = {{{kX + kWidth, y}, {kX + kWidth + 4.0, y}}};
    canvas.line(tick, 1.0, kInk);
    canvas.text({kX + kWidth + 8.0, y + 4.5}, kPowers[power], {.size = 12.0, .rgb = kInk});
  }
}

}  // namespace nacre::animation
