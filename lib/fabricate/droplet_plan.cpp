#include "fabricate/droplet_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "base/result.hpp"

namespace nacre::fabricate {
namespace {

constexpr std::int64_t kPixelUm = static_cast<std::int64_t>(thesis::kPixelSize.value * 1e6 + 0.5);

SpecimenPlan checked(const SpecimenPlan& specimen, const Printer& printer) {
  check_printer(printer);
  if (specimen.orientation_deg != 0.0 && specimen.orientation_deg != 90.0) {
    throw InputError::format("orientation {}: expected 0 or 90 degrees", specimen.orientation_deg);
  }
  if (!(specimen.thickness_mm >= 0.1 && specimen.thickness_mm <= 50.0)) {
    throw InputError::format("thickness {} mm: expected 0.1 to 50 mm", specimen.thickness_mm);
  }
  if (!(specimen.notch.height_mm > 0.0 && specimen.notch.height_mm <= 10.0)) {
    throw InputError::format("notch of {} mm height: expected above 0, at most 10 mm", specimen.notch.height_mm);
  }
  return specimen;
}

DropletAxis axis_of(const SpecimenPlan& specimen, int dpi, bool along_specimen) {
  const SpecimenGeometry geometry = geometry_of(specimen.kind);
  return {dpi, along_specimen ? geometry.length_um : geometry.width_um, kPixelUm};
}

/// Pixel index -> row or column of the layout, which repeats from the specimen's middle both ways.
int in_unit(std::int32_t pixel) {
  const int place = pixel % pattern::kSide;
  return place < 0 ? place + pattern::kSide : place;
}

/// SplitMix64's output function: a bijection of 64 bits that passes as random on a counter.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

std::uint32_t threshold_of(double probability) {
  return static_cast<std::uint32_t>(std::lround(probability * std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

DropletPlan::DropletPlan(const SpecimenPlan& specimen, const Printer& printer)
    : specimen_(checked(specimen, printer)),
      turned_(specimen.orientation_deg == 90.0),
      random_(false),
      x_(axis_of(specimen, printer.dpi_x, turned_)),
      y_(axis_of(specimen, printer.dpi_y, !turned_)),
      layers_(layers_of(specimen.thickness_mm, printer)) {
  if (const pattern::Layout* layout = specimen_.design.layout()) {
    printed_layout_ = turned_ ? layout->rotated() : *layout;
  } else {
    const double phi = specimen_.design.rigid_fraction();
    random_ = phi > 0.0 && phi < 1.0;
    if (random_) rigid_below_ = threshold_of(phi);
    for (int pixel = 0; pixel < pattern::kPixels; ++pixel) {
      printed_layout_.set(pixel / pattern::kSide, pixel % pattern::kSide, phi > 0.0);
    }
  }
  base_.columns = columns();
  base_.rows = rows();
  base_.droplets.reserve(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()));
  for (int row = 0; row < rows(); ++row) {
    for (int column = 0; column < columns(); ++column) base_.droplets.push_back(designed(column, row));
  }
}

bool DropletPlan::solid(int column, int row) const {
  // Turned counter-clockwise, the specimen's upper end lies at the left and its left edge at the bottom of the picture.
  const SpecimenGeometry geometry = geometry_of(specimen_.kind);
  const double across_mm = turned_ ? 1e-3 * geometry.width_um - y_.centre_mm(row) : x_.centre_mm(column);
  const double along_mm = turned_ ? x_.centre_mm(column) : y_.centre_mm(row);
  const auto [first_mm, last_mm] = solid_across(specimen_.kind, along_mm, specimen_.notch);
  return across_mm >= first_mm && across_mm <= last_mm;
}

bool DropletPlan::in_grip(int column, int row) const {
  const SpecimenGeometry geometry = geometry_of(specimen_.kind);
  const double along_mm = turned_ ? x_.centre_mm(column) : y_.centre_mm(row);
  return std::min(along_mm, 1e-3 * geometry.length_um - along_mm) < geometry.grip_mm;
}

bool DropletPlan::pixel_is_rigid(std::int32_t pixel_x, std::int32_t pixel_y) const {
  return printed_layout_.rigid(in_unit(pixel_y), in_unit(pixel_x));
}

Area DropletPlan::area(int column, int row) const {
  const bool between_x = x_.place(column).at_interface(), between_y = y_.place(row).at_interface();
  return static_cast<Area>((between_x ? 1 : 0) + (between_y ? 2 : 0));
}

Droplet DropletPlan::designed(int column, int row) const {
  if (!solid(column, row)) return Droplet::none;
  if (specimen_.design.layout() != nullptr && specimen_.grips == GripMaterial::rigid && in_grip(column, row))
    return Droplet::rigid;
  const AxisPlace &px = x_.place(column), &py = y_.place(row);
  const bool own_is_rigid = pixel_is_rigid(px.own, py.own);
  const auto like_own = [&](std::int32_t pixel_x, std::int32_t pixel_y) {
    return pixel_is_rigid(pixel_x, pixel_y) == own_is_rigid;
  };
  const bool all_alike =
      like_own(px.neighbour, py.own) && like_own(px.own, py.neighbour) && like_own(px.neighbour, py.neighbour);
  if (all_alike || specimen_.interface == Interface::sharp) return own_is_rigid ? Droplet::rigid : Droplet::soft;
  // 2.2.3: rows alternate by the parity of i + j' (type 1, 3), columns by that of j + i' (type 2).
  const bool rows_alternate = area(column, row) != Area::type_2;
  const std::int64_t parity = rows_alternate ? std::int64_t{px.low()} + row : std::int64_t{py.low()} + column;
  return parity % 2 == 0 ? Droplet::rigid : Droplet::soft;
}

std::pair<double, double> DropletPlan::point_of_interest() const {
  const SpecimenGeometry geometry = geometry_of(specimen_.kind);
  const double width_mm = 1e-3 * static_cast<double>(geometry.width_um);
  const double along_mm = 0.5e-3 * static_cast<double>(geometry.length_um);
  const double across_mm = specimen_.kind == SpecimenKind::toughness ? thesis::kNotchLength * 1e3 : width_mm / 2;
  return turned_ ? std::pair(along_mm, width_mm - across_mm) : std::pair(across_mm, along_mm);
}

Slice DropletPlan::slice(int layer) const {
  if (!random_) return base_;
  Slice slice = base_;
  const std::uint64_t stream = mixed(specimen_.seed ^ content_hash64("droplets of a mixture"));
  std::uint64_t counter = mixed(stream + static_cast<std::uint64_t>(layer));  // layers draw from far apart
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < slice.droplets.size(); ++i) {
    bits = i % 2 == 0 ? mixed(counter++) : bits >> 32;
    if (slice.droplets[i] == Droplet::none) continue;
    slice.droplets[i] = static_cast<std::uint32_t>(bits) < rigid_below_ ? Droplet::rigid : Droplet::soft;
  }
  return slice;
}

}  // namespace nacre::fabricate
