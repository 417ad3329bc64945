#pragma once
// Small plots as inline SVG: axes with round ticks, dots, rings, lines, staircases, bands, error bars, legend. Colours
// come from the page's style sheet, one class per ink, so that a plot follows the light or dark scheme of the page.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::report {

struct PlotPoint {
  double x = 0.0, y = 0.0;
};

struct Range {
  double low = 0.0, high = 1.0;
};

/// Multiples of 1, 2 or 5 times a power of ten inside the range, about `wanted` of them. Empty for an empty range.
std::vector<double> round_ticks(const Range& range, int wanted);

/// The finite values' range, 0 included, widened by 5 % beyond the largest magnitude; 0..1 when there is nothing.
Range range_with_zero(std::span<const double> values);

/// `text` for element content and quoted attributes: markup characters as entities, control characters replaced.
std::string escaped(std::string_view text);

/// What a mark stands for. The same ink has the same meaning in every figure of the report.
enum class Ink {
  simulated,
  measured,
  earlier,
  homogeneous,
  thesis,
  family_1,
  family_2,
  family_3,
  family_4,
  family_5,
  family_6
};

/// The ink of the n-th family, from 0; the seventh has the first one's again.
Ink family_ink(std::size_t family);

enum class Stroke { solid, thin, dashed };

/// Labels and ranges of a plot. Texts are plain; they are escaped here.
struct Axes {
  std::string title;
  std::string x_label, y_label;
  Range x, y;
  int width = 350, height = 290;     ///< px, legend not counted
  bool whole_numbers_x = false;      ///< ticks at whole numbers only (rounds)
  std::vector<double> x_ticks = {};  ///< where they are not to be chosen
};

/// Marks are drawn in the order of the calls and clipped to the axes; points that are not finite are left out. `label`
/// names the marks in the legend; empty: none. Texts are plain.
class Plot {
 public:
  explicit Plot(Axes axes);
  /// Many small dots.
  void cloud(std::span<const PlotPoint> points, Ink ink, std::string_view label);
  /// Small squares, colours[i] (#rrggbb) for point i; no legend.
  void coloured(std::span<const PlotPoint> points, std::span<const std::string> colours);
  /// Filled circles; hints[i], where given, is shown when the pointer rests on circle i.
  void dots(std::span<const PlotPoint> points, Ink ink, std::string_view label,
            std::span<const std::string> hints = {});
  /// Hollow circles.
  void rings(std::span<const PlotPoint> points, Ink ink, std::string_view label,
             std::span<const std::string> hints = {});
  /// Bars of half_widths[i] to either side of points[i], in both directions; 0: no bar.
  void error_bars(std::span<const PlotPoint> points, std::span<const PlotPoint> half_widths, Ink ink);
  /// Upright bars, one for each abscissa.
  void error_bars(std::span<const double> xs, std::span<const Range> ends, Ink ink);
  void line(std::span<const PlotPoint> points, Ink ink, Stroke stroke, std::string_view label);
  /// The boundary of what a front dominates with respect to (0, 0); `front` by increasing x and decreasing y.
  void staircase(std::span<const PlotPoint> front, Ink ink, std::string_view label);
  /// The area between two lines over the same x.
  void band(std::span<const PlotPoint> lower, std::span<const PlotPoint> upper, Ink ink, std::string_view label);
  /// The horizontal line y = 0.
  void zero_line();
  std::string svg() const;

 private:
  struct LegendEntry {
    std::string sample, label;
  };
  double px(double x) const;
  double py(double y) const;
  std::string path_of(std::span<const PlotPoint> points) const;
  void circles(std::span<const PlotPoint> points, Ink ink, std::string_view shape, std::span<const std::string> hints);
  void add_to_legend(std::string sample, std::string_view label);
  std::string axes_svg() const;
  std::string legend_svg(int& rows) const;

  Axes axes_;
  std::string marks_;
  std::vector<LegendEntry> legend_;
};

}  // namespace nacre::report
