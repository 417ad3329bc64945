#pragma once
// The material of every droplet of a specimen (thesis 2.2.1, 2.2.3).

#include <cstdint>
#include <utility>

#include "fabricate/droplet_axis.hpp"
#include "fabricate/printer.hpp"
#include "fabricate/slice.hpp"
#include "fabricate/specimen.hpp"
#include "pattern/design.hpp"

namespace nacre::fabricate {

/// How the interface between unlike pixels is printed.
enum class Interface {
  engineered,  ///< alternating droplets in areas of type 1, 2 and 3 (2.2.3)
  sharp,       ///< every droplet has the material of its pixel
};

/// Material of the gripped ends of a pattern's specimen.
enum class GripMaterial { pattern, rigid };

/// The areas into which pixels are divided (2.2.3, Figure 2-3): inside one pixel, or an interface area of type 1
/// (neighbours along the printer's x), 2 (along y) or 3 (around a corner).
enum class Area { centre = 0, type_1 = 1, type_2 = 2, type_3 = 3 };

/// One kind of object to print.
struct SpecimenPlan {
  pattern::Design design;
  SpecimenKind kind = SpecimenKind::toughness;
  double orientation_deg = 0.0;  ///< 0: pulled along the printer's y; 90: turned counter-clockwise, along x
  double thickness_mm = 3.2;
  Interface interface = Interface::engineered;
  GripMaterial grips = GripMaterial::pattern;
  NotchOptions notch = {};
  std::uint64_t seed = 1;  ///< of homogeneous mixtures
};

/// Decides the material of every droplet, layer by layer; about 2 bytes of memory per droplet of a layer.
class DropletPlan : public SliceStack {
 public:
  /// Throws InputError for an orientation other than 0 or 90, a thickness outside 0.1 to 50 mm, an impossible
  /// notch, or a printer that check_printer() refuses.
  DropletPlan(const SpecimenPlan& specimen, const Printer& printer);

  int columns() const { return x_.droplets(); }
  int rows() const { return y_.droplets(); }
  int layers() const override { return layers_; }
  /// All layers of patterns and pure materials are the same, no two of a mixture are.
  bool is_like_before(int layer) const override { return layer > 0 && !random_; }
  bool is_noise(int) const override { return random_; }
  /// Depends on (plan, seed, layer) alone. A mixture's droplet is rigid with the probability phi of the design (2.2.1),
  /// independent of all others.
  Slice slice(int layer) const override;

  const DropletAxis& x() const { return x_; }
  const DropletAxis& y() const { return y_; }
  Area area(int column, int row) const;
  /// The tip of the notch, or the middle of a bar, in mm from the left and the far edge of a slice.
  std::pair<double, double> point_of_interest() const;

 private:
  bool solid(int column, int row) const;
  bool in_grip(int column, int row) const;
  bool pixel_is_rigid(std::int32_t pixel_x, std::int32_t pixel_y) const;
  Droplet designed(int column, int row) const;

  SpecimenPlan specimen_;
  bool turned_;
  bool random_;
  pattern::Layout printed_layout_;  ///< as it lies on the tray
  DropletAxis x_, y_;
  int layers_;
  std::uint32_t rigid_below_ = 0;  ///< a mixture's droplet is rigid when 32 random bits are below it; 0 for others
  Slice base_;                     ///< all layers of a pattern; of a mixture: rigid where there is material
};

}  // namespace nacre::fabricate
