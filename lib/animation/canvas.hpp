#pragma once
// A drawing surface in the pictures' own units, whatever their size in points. Wraps cairo.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "animation/picture.hpp"

typedef struct _cairo cairo_t;
typedef struct _cairo_surface cairo_surface_t;

namespace nacre::animation {

struct CanvasPoint {
  double x = 0.0, y = 0.0;
};

enum class TextAnchor { left, centre, right };

struct TextStyle {
  double size = 13.0;
  std::uint32_t rgb = 0x202020;
  bool bold = false;
  TextAnchor anchor = TextAnchor::left;
  bool upwards = false;  ///< turned by a quarter, reading from below
};

/// y runs down, as in pictures. Throws std::bad_alloc where cairo has no memory.
class Canvas {
 public:
  /// `width_units` across become `width_points` points; the height follows.
  Canvas(double width_units, double height_units, int width_points);

  void fill(std::uint32_t rgb);
  void rectangle(CanvasPoint corner, double width, double height, std::uint32_t rgb);
  /// Many quadrilaterals of one colour, all turning the same way, without smoothing: neighbours meet without seams, and
  /// the picture keeps few colours.
  void quads(std::span<const std::array<CanvasPoint, 4>> corners, std::uint32_t rgb);
  void area(std::span<const CanvasPoint> outline, std::uint32_t rgb);
  void line(std::span<const CanvasPoint> points, double width, std::uint32_t rgb);
  void disc(CanvasPoint centre, double radius, std::uint32_t rgb);
  void text(CanvasPoint at, const std::string& text, const TextStyle& style = {});
  double text_width(const std::string& text, const TextStyle& style);

  /// Paints a picture of as many points over all there is.
  void paint(const Picture& picture);
  Picture picture() const;

 private:
  void colour(std::uint32_t rgb);
  void outline(std::span<const CanvasPoint> points);
  void font(const TextStyle& style);
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> context_;
};

}  // namespace nacre::animation
