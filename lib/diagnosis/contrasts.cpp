#include "diagnosis/contrasts.hpp"

#include <array>
#include <cmath>
#include <functional>

namespace nacre::diagnosis {
namespace {

using pattern::kSide;
using pattern::Layout;

/// Pixel with periodic indices: a layout is repeated over the specimen.
bool at(const Layout& layout, int row, int column) { return layout.rigid((row + kSide) % kSide, (column + kSide) % kSide); }

/// Share of neighbouring pixel pairs that differ; pairs across (dr = 0, dc = 1) or along (dr = 1, dc = 0) the load.
double interface_share(const Layout& layout, int dr, int dc) {
  int differing = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) differing += at(layout, r, c) != at(layout, r + dr, c + dc);
  }
  return differing / static_cast<double>(pattern::kPixels);
}

/// Mean length in pixels of unbroken runs of one phase in both directions.
double mean_run(const Layout& layout, bool rigid) {
  int pixels = 0, ends = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      if (at(layout, r, c) != rigid) continue;
      pixels += 2;
      ends += at(layout, r, c + 1) != rigid;
      ends += at(layout, r + 1, c) != rigid;
    }
  }
  return ends > 0 ? pixels / static_cast<double>(ends) : kSide;
}

/// Share of pixel corners where only diagonal neighbours agree: the phases touch point to point.
double diagonal_contacts(const Layout& layout) {
  int count = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const bool a = at(layout, r, c), b = at(layout, r, c + 1), d = at(layout, r + 1, c), e = at(layout, r + 1, c + 1);
      count += a == e && b == d && a != b;
    }
  }
  return count / static_cast<double>(pattern::kPixels);
}

/// Share of pixel corners where the four pixels do not all agree.
double mixed_corners(const Layout& layout) {
  int count = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int sum = at(layout, r, c) + at(layout, r, c + 1) + at(layout, r + 1, c) + at(layout, r + 1, c + 1);
      count += sum != 0 && sum != 4;
    }
  }
  return count / static_cast<double>(pattern::kPixels);
}

/// 1 when rigid pixels, joined by edges, connect bottom and top of the unit.
double rigid_percolates(const Layout& layout) {
  std::array<std::array<bool, kSide>, kSide> seen{};
  std::vector<std::pair<int, int>> open;
  for (int c = 0; c < kSide; ++c) {
    if (layout.rigid(0, c)) open.emplace_back(0, c), seen[0][static_cast<std::size_t>(c)] = true;
  }
  constexpr std::array<std::pair<int, int>, 4> kNeighbours = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  while (!open.empty()) {
    const auto [r, c] = open.back();
    open.pop_back();
    if (r == kSide - 1) return 1.0;
    for (const auto& [dr, dc] : kNeighbours) {
      const int nr = r + dr, nc = (c + dc + kSide) % kSide;
      if (nr < 0 || nr >= kSide || !layout.rigid(nr, nc) || seen[static_cast<std::size_t>(nr)][static_cast<std::size_t>(nc)]) continue;
      seen[static_cast<std::size_t>(nr)][static_cast<std::size_t>(nc)] = true;
      open.emplace_back(nr, nc);
    }
  }
  return 0.0;
}

struct Feature {
  const char* name;
  std::function<double(const Layout&)> of;
};

const std::vector<Feature>& layout_features() {
  static const std::vector<Feature> kFeatures = {
      {"interface length across the load", [](const Layout& l) { return interface_share(l, 0, 1); }},
      {"interface length along the load", [](const Layout& l) { return interface_share(l, 1, 0); }},
      {"run length of the rigid phase", [](const Layout& l) { return mean_run(l, true); }},
      {"run length of the soft phase", [](const Layout& l) { return mean_run(l, false); }},
      {"point contacts at pixel corners", diagonal_contacts},
      {"mixed pixel corners", mixed_corners},
      {"percolation of the rigid phase", rigid_percolates},
  };
  return kFeatures;
}

/// Appends the direction when it varies: centred, unit length.
void add_if_varying(std::vector<ContrastDirection>& directions, const std::string& name, Eigen::VectorXd values) {
  values.array() -= values.mean();
  const double length = values.norm();
  if (length < 1e-9 * (1.0 + values.size())) return;
  directions.push_back({name, values / length});
}

}  // namespace

std::vector<ContrastDirection> contrast_directions(const Observations& observations, const Eigen::VectorXd& predicted) {
  std::vector<ContrastDirection> directions;
  const auto over_groups = [&](const std::function<double(const Observation&)>& value) {
    Eigen::VectorXd values(observations.size());
    for (int i = 0; i < observations.size(); ++i) values[i] = value(observations.groups[static_cast<std::size_t>(i)]);
    return values;
  };
  add_if_varying(directions, "rigid fraction", over_groups([](const Observation& g) { return g.design.rigid_fraction(); }));
  add_if_varying(directions, "stiffness level", predicted);
  add_if_varying(directions, "orientation", over_groups([](const Observation& g) { return g.conditions.orientation_deg; }));
  add_if_varying(directions, "strain rate", over_groups([](const Observation& g) { return std::log(g.conditions.strain_rate_per_s); }));
  add_if_varying(directions, "thickness", over_groups([](const Observation& g) { return g.conditions.thickness_mm; }));
  add_if_varying(directions, "print order", over_groups([](const Observation& g) { return g.print_order; }));
  for (const Feature& feature : layout_features()) {
    add_if_varying(directions, feature.name, over_groups([&](const Observation& g) { return feature.of(*g.design.layout()); }));
  }
  return directions;
}

}  // namespace nacre::diagnosis
