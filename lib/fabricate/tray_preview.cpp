#include "fabricate/tray_preview.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "fabricate/slice_picture.hpp"

namespace nacre::fabricate {
namespace {

constexpr int kTrayPoints = 1400, kFrame = 30;
constexpr double kFoot = kLegendHeight + 2 * kFrame;
constexpr std::uint32_t kTrayPaper = 0xffffff, kTray = 0xe9edf2, kInk = 0x202020;
constexpr animation::TextStyle kLabel{.size = 17.0, .rgb = kInk, .bold = true, .anchor = animation::TextAnchor::centre};

/// The label on a patch of paper, along the longer side of its specimen.
void draw_label(animation::Canvas& canvas, const std::string& label, animation::CanvasPoint middle, bool upwards) {
  animation::TextStyle style = kLabel;
  style.upwards = upwards;
  const double length = canvas.text_width(label, style) + 8.0, height = style.size + 6.0;
  const double width = upwards ? height : length, tall = upwards ? length : height;
  canvas.rectangle({middle.x - width / 2, middle.y - tall / 2}, width, tall, kTrayPaper);
  const double baseline = 0.35 * style.size;
  canvas.text({middle.x + (upwards ? baseline : 0.0), middle.y + (upwards ? 0.0 : baseline)}, label, style);
}

}  // namespace

void write_tray_preview(const Job& job, int tray, std::span<const DropletPlan> plans,
                        const std::filesystem::path& path) {
  const Printer& printer = job.request.printer;
  const double points_per_mm = kTrayPoints / std::max(printer.tray_x_mm, printer.tray_y_mm);
  const int tray_height = static_cast<int>(printer.tray_y_mm * points_per_mm);
  const int tray_width = static_cast<int>(printer.tray_x_mm * points_per_mm);
  const int width = tray_width + 2 * kFrame, height = tray_height + static_cast<int>(kFoot) + 2 * kFrame;
  animation::Canvas canvas(width, height, width);
  canvas.fill(kTrayPaper);
  canvas.rectangle({kFrame, kFrame}, tray_width, tray_height, kTray);
  const double foot = tray_height + 2.0 * kFrame;
  draw_legend(canvas, kFrame, foot);
  draw_scale_bar(canvas, kFrame + kLegendWidth + 40.0, foot, 50.0, points_per_mm);
  canvas.text({kFrame + kLegendWidth + 40.0, foot + 80.0},
              fmt::format("{}, tray {} of {}, {} x {} mm, its front below", job.batch(tray), tray, job.trays,
                          printer.tray_x_mm, printer.tray_y_mm),
              {.size = 20.0, .rgb = kInk});
  animation::Picture picture = canvas.picture();
  const auto corner_of = [&](const PlacedSpecimen& specimen) {
    const double top_mm = printer.tray_y_mm - specimen.y_mm - job.models[specimen.model].size_y_mm;
    return animation::CanvasPoint{kFrame + specimen.x_mm * points_per_mm, kFrame + top_mm * points_per_mm};
  };
  for (const PlacedSpecimen& specimen : job.specimens) {
    if (specimen.tray != tray) continue;
    const DropletPlan& plan = plans[specimen.model];
    const animation::CanvasPoint corner = corner_of(specimen);
    draw_slice(picture, plan, plan.slice(plan.layers() / 2), whole_of(plan), static_cast<int>(corner.x),
               static_cast<int>(corner.y), points_per_mm);
  }
  canvas.paint(picture);
  for (const PlacedSpecimen& specimen : job.specimens) {
    if (specimen.tray != tray) continue;
    const PrintModel& model = job.models[specimen.model];
    const animation::CanvasPoint corner = corner_of(specimen);
    draw_label(canvas, specimen.label,
               {corner.x + model.size_x_mm * points_per_mm / 2, corner.y + model.size_y_mm * points_per_mm / 2},
               model.size_y_mm > model.size_x_mm);
  }
  animation::write_png(path, canvas.picture());
}

}  // namespace nacre::fabricate
