#include "fabricate/slice_png.hpp"

#include <png.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>

#include "base/files.hpp"
#include "base/result.hpp"

// libpng reports errors by long jumps: no function that may jump holds an object with a destructor.
namespace nacre::fabricate {
namespace {

constexpr png_color colour_of(std::uint32_t rgb) {
  return {static_cast<png_byte>(rgb >> 16), static_cast<png_byte>(rgb >> 8 & 0xff), static_cast<png_byte>(rgb & 0xff)};
}
constexpr SliceColours kIndexed = colours_of(SlicePixels::indexed), kRgba = colours_of(SlicePixels::rgba);
constexpr std::array kPalette = {colour_of(kIndexed.none), colour_of(kIndexed.soft), colour_of(kIndexed.rigid)};
constexpr std::array kOpaque = {colour_of(kRgba.none), colour_of(kRgba.soft), colour_of(kRgba.rigid)};
constexpr std::size_t kRgbaBytes = 4;
constexpr auto kUnknown = static_cast<Droplet>(0xff);

struct PngFault {
  std::array<char, 128> text{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* fault = static_cast<PngFault*>(png_get_error_ptr(png));
  std::strncpy(fault->text.data(), message, fault->text.size() - 1);
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}
void flush(png_structp) {}

png_uint_32 per_metre(int dpi) { return static_cast<png_uint_32>(std::lround(dpi / 25.4e-3)); }

/// The points of one row of droplets.
void paint(const Droplet* droplets, int columns, png_bytep points) {
  for (int column = 0; column < columns; ++column, points += kRgbaBytes) {
    const png_color& colour = kOpaque[static_cast<std::size_t>(droplets[column])];
    points[0] = colour.red, points[1] = colour.green, points[2] = colour.blue, points[3] = 0xff;
  }
}

/// The droplets of one row of points; kUnknown for a colour that stands for none.
void recognise(const png_byte* points, int columns, Droplet* droplets) {
  for (int column = 0; column < columns; ++column, points += kRgbaBytes) {
    droplets[column] = kUnknown;
    for (std::size_t i = 0; i < kOpaque.size(); ++i)
      if (points[0] == kOpaque[i].red && points[1] == kOpaque[i].green && points[2] == kOpaque[i].blue &&
          points[3] == 0xff)
        droplets[column] = static_cast<Droplet>(i);
  }
}

/// Writes into `out`, which the caller owns, as `row_of_points`; false when libpng gave up.
bool encode(png_structp png, png_infop info, const Slice& slice, const Printer& printer, bool is_noise,
            std::string* row_of_points, std::string* out) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const bool is_rgba = printer.pixels == SlicePixels::rgba;
  png_set_write_fn(png, out, append, flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(slice.columns), static_cast<png_uint_32>(slice.rows), 8,
               is_rgba ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!is_rgba) png_set_PLTE(png, info, kPalette.data(), kPalette.size());
  png_set_pHYs(png, info, per_metre(printer.dpi_x), per_metre(printer.dpi_y), PNG_RESOLUTION_METER);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, is_noise ? 1 : 6);
  // Of four bytes a point the matches are worth their search.
  if (is_noise && !is_rgba) png_set_compression_strategy(png, Z_RLE);
  png_write_info(png, info);
  for (int row = 0; row < slice.rows; ++row) {
    const Droplet* droplets = slice.droplets.data() + std::size_t(row) * slice.columns;
    if (is_rgba) paint(droplets, slice.columns, reinterpret_cast<png_bytep>(row_of_points->data()));
    png_write_row(png, is_rgba ? reinterpret_cast<png_const_bytep>(row_of_points->data())
                               : reinterpret_cast<png_const_bytep>(droplets));
  }
  png_write_end(png, info);
  return true;
}

/// The unread rest of a file.
struct PngSource {
  const char* at;
  std::size_t left;
};

void take(png_structp png, png_bytep bytes, std::size_t count) {
  auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source->left) png_error(png, "the file ends early");
  std::memcpy(bytes, source->at, count);
  source->at += count;
  source->left -= count;
}

bool decode_head(png_structp png, png_infop info, PngSource* source, Slice* slice, bool* is_rgba) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, source, take);
  png_read_info(png, info);
  *is_rgba = png_get_color_type(png, info) == PNG_COLOR_TYPE_RGB_ALPHA && png_get_bit_depth(png, info) == 8;
  if (!*is_rgba && png_get_color_type(png, info) != PNG_COLOR_TYPE_PALETTE) png_error(png, "neither indexed nor RGBA");
  png_set_packing(png);
  slice->columns = png_get_image_width(png, info);
  slice->rows = png_get_image_height(png, info);
  return true;
}

/// `row_of_points`: of an RGBA picture, empty for an indexed one.
bool decode_rows(png_structp png, std::string* row_of_points, Slice* slice) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (int row = 0; row < slice->rows; ++row) {
    Droplet* droplets = slice->droplets.data() + std::size_t(row) * slice->columns;
    auto* points = reinterpret_cast<png_bytep>(row_of_points->data());
    png_read_row(png, row_of_points->empty() ? reinterpret_cast<png_bytep>(droplets) : points, nullptr);
    if (!row_of_points->empty()) recognise(points, slice->columns, droplets);
  }
  return true;
}

}  // namespace

std::string to_png(const Slice& slice, const Printer& printer, bool is_noise) {
  PngFault fault;
  std::string bytes, row_of_points(kRgbaBytes * static_cast<std::size_t>(slice.columns), '\0');
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault, on_error, on_warning);
  png_infop info = png_create_info_struct(png);
  const bool written = encode(png, info, slice, printer, is_noise, &row_of_points, &bytes);
  png_destroy_write_struct(&png, &info);
  if (!written) throw InputError::format("a slice cannot be written as PNG: {}", fault.text.data());
  return bytes;
}

Slice read_slice(const std::filesystem::path& path) {
  constexpr int kLongestSide = 1 << 17;
  const std::string file = read_file(path);
  PngSource source{file.data(), file.size()};
  PngFault fault;
  Slice slice;
  std::string row_of_points;
  bool is_rgba = false;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, on_error, on_warning);
  png_infop info = png_create_info_struct(png);
  bool read = decode_head(png, info, &source, &slice, &is_rgba);
  if (read && (slice.columns > kLongestSide || slice.rows > kLongestSide)) {
    std::strncpy(fault.text.data(), "more than 131072 droplets along a side", fault.text.size() - 1);
    read = false;
  }
  if (read) {
    slice.droplets.resize(static_cast<std::size_t>(slice.columns) * static_cast<std::size_t>(slice.rows));
    if (is_rgba) row_of_points.resize(kRgbaBytes * static_cast<std::size_t>(slice.columns));
    read = decode_rows(png, &row_of_points, &slice);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!read)
    throw InputError::format("{}: not a readable slice: {}; expected a PNG, indexed or of 32 bits", path.string(),
                             fault.text.data());
  for (const Droplet droplet : slice.droplets) {
    if (droplet > Droplet::rigid && is_rgba)
      throw InputError::format("{}: a colour other than #{:06x} none, #{:06x} soft, #{:06x} rigid", path.string(),
                               kRgba.none, kRgba.soft, kRgba.rigid);
    if (droplet > Droplet::rigid)
      throw InputError::format("{}: index {} in the picture, expected 0 none, 1 soft or 2 rigid", path.string(),
                               static_cast<int>(droplet));
  }
  return slice;
}

}  // namespace nacre::fabricate
