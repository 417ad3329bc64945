#include "animation/canvas.hpp"

#include <cairo.h>

#include <cmath>
#include <cstring>
#include <new>
#include <numbers>

namespace nacre::animation {

Canvas::Canvas(double width_units, double height_units, int width_points)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_points,
                                          static_cast<int>(std::lround(width_points * height_units / width_units))),
               cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  cairo_scale(context_.get(), width_points / width_units, width_points / width_units);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  // Grey antialiasing on every machine: subpixel antialiasing is made for one screen.
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), &cairo_font_options_destroy);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options.get());
}

void Canvas::colour(std::uint32_t rgb) {
  cairo_set_source_rgb(context_.get(), (rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0);
}

void Canvas::fill(std::uint32_t rgb) {
  colour(rgb);
  cairo_paint(context_.get());
}

void Canvas::rectangle(CanvasPoint corner, double width, double height, std::uint32_t rgb) {
  colour(rgb);
  cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
  cairo_fill(context_.get());
}

void Canvas::outline(std::span<const CanvasPoint> points) {
  cairo_new_path(context_.get());
  for (const CanvasPoint& point : points) cairo_line_to(context_.get(), point.x, point.y);
}

void Canvas::quads(std::span<const std::array<CanvasPoint, 4>> corners, std::uint32_t rgb) {
  cairo_set_antialias(context_.get(), CAIRO_ANTIALIAS_NONE);
  colour(rgb);
  cairo_new_path(context_.get());
  for (const std::array<CanvasPoint, 4>& quad : corners) {
    cairo_move_to(context_.get(), quad[0].x, quad[0].y);
    for (std::size_t i = 1; i < 4; ++i) cairo_line_to(context_.get(), quad[i].x, quad[i].y);
    cairo_close_path(context_.get());
  }
  cairo_fill(context_.get());
  cairo_set_antialias(context_.get(), CAIRO_ANTIALIAS_DEFAULT);
}

void Canvas::area(std::span<const CanvasPoint> points, std::uint32_t rgb) {
  colour(rgb);
  outline(points);
  cairo_fill(context_.get());
}

void Canvas::line(std::span<const CanvasPoint> points, double width, std::uint32_t rgb) {
  colour(rgb);
  outline(points);
  cairo_set_line_width(context_.get(), width);
  cairo_stroke(context_.get());
}

void Canvas::disc(CanvasPoint centre, double radius, std::uint32_t rgb) {
  colour(rgb);
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(context_.get());
}

void Canvas::font(const TextStyle& style) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size);
}

double Canvas::text_width(const std::string& text, const TextStyle& style) {
  font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(CanvasPoint at, const std::string& text, const TextStyle& style) {
  const double width = text_width(text, style);
  const double back = style.anchor == TextAnchor::left ? 0.0 : style.anchor == TextAnchor::centre ? 0.5 * width : width;
  cairo_save(context_.get());
  colour(style.rgb);
  cairo_move_to(context_.get(), at.x, at.y);
  if (style.upwards) cairo_rotate(context_.get(), -0.5 * std::numbers::pi);
  cairo_rel_move_to(context_.get(), -back, 0.0);
  cairo_show_text(context_.get(), text.c_str());
  cairo_restore(context_.get());
}

void Canvas::paint(const Picture& picture) {
  cairo_surface_flush(surface_.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  for (int y = 0; y < picture.height; ++y)
    std::memcpy(bytes + y * stride, &picture.rgb[y * picture.width], static_cast<std::size_t>(picture.width) * 4);
  cairo_surface_mark_dirty(surface_.get());
}

Picture Canvas::picture() const {
  cairo_surface_flush(surface_.get());
  Picture picture;
  picture.width = cairo_image_surface_get_width(surface_.get());
  picture.height = cairo_image_surface_get_height(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  const unsigned char* bytes = cairo_image_surface_get_data(surface_.get());
  picture.rgb.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y)
    std::memcpy(&picture.rgb[y * picture.width], bytes + y * stride, static_cast<std::size_t>(picture.width) * 4);
  for (std::uint32_t& rgb : picture.rgb) rgb &= 0xffffff;
  return picture;
}

}  // namespace nacre::animation
