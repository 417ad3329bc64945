#include "fabricate/packing.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace nacre::fabricate {
namespace {

/// Lengths along a shelf, and across it.
struct Extent {
  double along_mm, across_mm;
};

/// One tray, filled in shelves from its front.
class ShelvedTray {
 public:
  /// A shelf takes only objects that are at least `least_fill` of its depth.
  ShelvedTray(const Extent& tray, double gap_mm, double least_fill)
      : tray_(tray), gap_mm_(gap_mm), least_fill_(least_fill) {}

  /// The place found, along and across; nothing when the tray is full.
  std::optional<Extent> place(const Extent& object) {
    if (object.along_mm + 2 * gap_mm_ > tray_.along_mm) return std::nullopt;
    for (Shelf& shelf : shelves_) {
      const bool fits = object.across_mm <= shelf.depth_mm && object.across_mm >= least_fill_ * shelf.depth_mm;
      if (fits && shelf.used_mm + object.along_mm + 2 * gap_mm_ <= tray_.along_mm) return put(shelf, object);
    }
    const double begin_mm = shelves_.empty() ? gap_mm_ : shelves_.back().begin_mm + shelves_.back().depth_mm + gap_mm_;
    if (begin_mm + object.across_mm + gap_mm_ > tray_.across_mm) return std::nullopt;
    shelves_.push_back({begin_mm, object.across_mm, 0.0});
    return put(shelves_.back(), object);
  }

 private:
  struct Shelf {
    double begin_mm, depth_mm, used_mm;
  };
  Extent put(Shelf& shelf, const Extent& object) const {
    const double along_mm = shelf.used_mm + gap_mm_;
    shelf.used_mm = along_mm + object.along_mm;
    return {along_mm, shelf.begin_mm};
  }
  Extent tray_;
  double gap_mm_, least_fill_;
  std::vector<Shelf> shelves_;
};

struct Packing {
  std::vector<Place> places;
  int trays = 0;
};

Packing shelved(std::span<const Rectangle> objects, const Rectangle& tray, double gap_mm, bool along_x,
                double least_fill) {
  const auto turned = [&](const Rectangle& each) {
    return along_x ? Extent{each.x_mm, each.y_mm} : Extent{each.y_mm, each.x_mm};
  };
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const Extent first = turned(objects[a]), second = turned(objects[b]);
    return first.across_mm != second.across_mm ? first.across_mm > second.across_mm : first.along_mm > second.along_mm;
  });
  Packing packing{.places = std::vector<Place>(objects.size())};
  std::vector<ShelvedTray> trays;
  for (const std::size_t i : order) {
    const Extent object = turned(objects[i]);
    std::optional<Extent> place;
    std::size_t taken = 0;
    for (; taken < trays.size() && !place; ++taken) place = trays[taken].place(object);
    if (!place) {
      ShelvedTray next(turned(tray), gap_mm, least_fill);
      place = next.place(object);
      if (!place) continue;
      trays.push_back(std::move(next));
      taken = trays.size();
    }
    packing.places[i] = {static_cast<int>(taken), along_x ? place->along_mm : place->across_mm,
                         along_x ? place->across_mm : place->along_mm};
  }
  packing.trays = static_cast<int>(trays.size());
  return packing;
}

}  // namespace

std::vector<Place> packed(std::span<const Rectangle> objects, const Rectangle& tray, double gap_mm) {
  constexpr double kLikeTheShelf = 0.75;
  Packing best;
  for (const bool along_x : {true, false})
    for (const double least_fill : {0.0, kLikeTheShelf}) {
      Packing packing = shelved(objects, tray, gap_mm, along_x, least_fill);
      if (best.places.empty() || packing.trays < best.trays) best = std::move(packing);
    }
  return best.places;
}

}  // namespace nacre::fabricate
