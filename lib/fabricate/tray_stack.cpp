#include "fabricate/tray_stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nacre::fabricate {

TrayStack::TrayStack(const Job& job, int tray, std::span<const DropletPlan> plans) : plans_(plans) {
  const auto on_tray = [&](const PlacedSpecimen& specimen) { return specimen.tray == tray; };
  corner_x_mm_ = corner_y_mm_ = std::numeric_limits<double>::max();
  for (const PlacedSpecimen& specimen : job.specimens) {
    if (!on_tray(specimen)) continue;
    corner_x_mm_ = std::min(corner_x_mm_, specimen.x_mm);
    corner_y_mm_ = std::min(corner_y_mm_, specimen.y_mm);
  }
  for (const PlacedSpecimen& specimen : job.specimens) {
    if (!on_tray(specimen)) continue;
    const DropletPlan& plan = plans[specimen.model];
    const auto droplets = [](double length_mm, double pitch) {
      return static_cast<int>(std::lround(length_mm / pitch));
    };
    const int column = droplets(specimen.x_mm - corner_x_mm_, plan.x().pitch());
    const int from_front = droplets(specimen.y_mm - corner_y_mm_, plan.y().pitch());
    parts_.push_back({specimen.model, column, from_front});
    columns_ = std::max(columns_, column + plan.columns());
    rows_ = std::max(rows_, from_front + plan.rows());
    layers_ = std::max(layers_, plan.layers());
  }
  for (Part& part : parts_) part.row = rows_ - part.row - plans[part.model].rows();  // row 0 is at the far end
  std::ranges::stable_sort(parts_, {}, &Part::model);
}

bool TrayStack::is_like_before(int layer) const {
  return layer > 0 && std::ranges::all_of(parts_, [&](const Part& part) {
           const DropletPlan& plan = plans_[part.model];
           return layer > plan.layers() || (layer < plan.layers() && plan.is_like_before(layer));
         });
}

bool TrayStack::is_noise(int layer) const {
  return std::ranges::any_of(parts_, [&](const Part& part) {
    const DropletPlan& plan = plans_[part.model];
    return layer < plan.layers() && plan.is_noise(layer);
  });
}

Slice TrayStack::slice(int layer) const {
  Slice tray{.columns = columns_,
             .rows = rows_,
             .droplets = std::vector<Droplet>(static_cast<std::size_t>(columns_) * rows_, Droplet::none)};
  std::optional<std::size_t> model;
  Slice own;
  for (const Part& part : parts_) {
    const DropletPlan& plan = plans_[part.model];
    if (layer >= plan.layers()) continue;
    if (model != part.model) own = plan.slice(layer);
    model = part.model;
    for (int row = 0; row < own.rows; ++row)
      std::copy_n(own.droplets.begin() + std::ptrdiff_t{row} * own.columns, own.columns,
                  tray.droplets.begin() + (std::ptrdiff_t{part.row} + row) * columns_ + part.column);
  }
  return tray;
}

}  // namespace nacre::fabricate
