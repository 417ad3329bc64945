#pragma once
// One layer as it is printed, droplet by droplet, and stacks of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nacre::fabricate {

/// Material of a droplet, as written in slices.
enum class Droplet : std::uint8_t { none = 0, soft = 1, rigid = 2 };

/// Rows x columns of droplets, row 0 at the printer's far end (the top of a layout file), column 0 at the left.
struct Slice {
  int columns = 0;
  int rows = 0;
  std::vector<Droplet> droplets;  ///< row after row
  Droplet at(int column, int row) const { return droplets[static_cast<std::size_t>(row) * columns + column]; }
  bool operator==(const Slice&) const = default;
};

/// Number of droplets of each material: none, soft, rigid.
using DropletCount = std::array<std::int64_t, 3>;
DropletCount count_droplets(const Slice& slice);

/// Share of rigid droplets among those printed; 0 when none is.
double rigid_fraction(const DropletCount& count);

/// Layers of one size, made one at a time, from any thread.
class SliceStack {
 public:
  virtual ~SliceStack() = default;
  virtual int layers() const = 0;
  /// The droplets of layer 0 <= `layer` < layers().
  virtual Slice slice(int layer) const = 0;
  /// Whether a layer is known to equal the one below it.
  virtual bool is_like_before(int layer) const = 0;
  /// Whether droplets of a layer are drawn at random, so that no picture of it is small.
  virtual bool is_noise(int layer) const = 0;
};

}  // namespace nacre::fabricate
