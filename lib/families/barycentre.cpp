#include "families/barycentre.hpp"

#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "families/earth_movers.hpp"

namespace nacre::families {
namespace {

using pattern::kAllFreePixels;
using pattern::kFreePixels;
using pattern::Pattern;

constexpr double kRounding = 1e-7;  // of a cell's height: the programme's own tolerance

/// Soft free pixels of one source that are not soft in all, and the height of their cells.
struct Earth {
  std::vector<int> pixels;
  double cell_height = 0.0;
};

Earth exclusive_earth(std::uint64_t soft) {
  Earth earth;
  int cells = 0;
  for (int i = 0; i < kFreePixels; ++i) {
    if (((soft >> i) & 1u) == 0) continue;
    earth.pixels.push_back(i);
    cells += quarter_cells(i);
  }
  if (cells > 0) earth.cell_height = 1.0 / cells;
  return earth;
}

/// The linear programme: transport from every source to one histogram that all of them end in.
class Programme {
 public:
  Programme(const std::vector<Earth>& sources, std::span<const double> weights) {
    int rows = 0;
    for (const Earth& source : sources) rows += source.pixels.size();
    const int first_equality = rows;
    int row = 0;
    for (std::size_t k = 0; k < sources.size(); ++k) {
      for (const int pixel : sources[k].pixels) {
        right_.push_back(sources[k].cell_height * quarter_cells(pixel));
        for (int to = 0; to < kFreePixels; ++to) add_flow(row, pixel, to, k, weights[k], first_equality);
        ++row;
      }
      if (k == 0) first_flows_ = costs_.size();
    }
    // All sources end in the same histogram: source k's earth at each pixel equals the first one's.
    for (std::size_t k = 1; k < sources.size(); ++k) {
      for (int to = 0; to < kFreePixels; ++to) {
        right_.push_back(0.0);
        const int equality = first_equality + static_cast<int>(k - 1) * kFreePixels + to;
        for (int flow = 0; flow < first_flows_ / kFreePixels; ++flow)
          add_entry(equality, flow * kFreePixels + to, -1.0);
      }
    }
  }

  /// Earth of the barycentre at every free pixel; empty when the programme was not solved.
  std::vector<double> solve() const {
    const CoinPackedMatrix matrix(true, rows_.data(), columns_.data(), values_.data(),
                                  static_cast<CoinBigIndex>(values_.size()));
    ClpSimplex simplex;
    simplex.setLogLevel(0);
    simplex.loadProblem(matrix, nullptr, nullptr, costs_.data(), right_.data(), right_.data());
    simplex.dual();
    if (!simplex.isProvenOptimal()) return {};
    const double* flows = simplex.primalColumnSolution();
    std::vector<double> earth(kFreePixels, 0.0);
    for (int flow = 0; flow < first_flows_; ++flow) earth[flow % kFreePixels] += flows[flow];
    return earth;
  }

 private:
  void add_flow(int row, int from, int to, std::size_t source, double weight, int first_equality) {
    const int column = costs_.size();
    const double distance = free_pixel_distance(from, to);
    costs_.push_back(weight * distance * distance);
    add_entry(row, column, 1.0);
    if (source > 0) add_entry(first_equality + static_cast<int>(source - 1) * kFreePixels + to, column, 1.0);
  }
  void add_entry(int row, int column, double value) {
    rows_.push_back(row);
    columns_.push_back(column);
    values_.push_back(value);
  }

  std::vector<int> rows_, columns_;
  std::vector<double> values_, costs_, right_;
  int first_flows_ = 0;
};

/// Free pixels whose cells are at least so high.
std::uint64_t cut_at(double height, const std::vector<double>& earth) {
  std::uint64_t soft = 0;
  for (int i = 0; i < kFreePixels; ++i)
    if (earth[i] / quarter_cells(i) >= height * (1.0 - kRounding)) soft |= std::uint64_t{1} << i;
  return soft;
}

/// The highest free pixels, as many as come nearest to so many cells.
std::uint64_t highest(double cells, const std::vector<double>& earth) {
  std::vector<int> order;
  for (int i = 0; i < kFreePixels; ++i)
    if (earth[i] > kRounding) order.push_back(i);
  std::ranges::stable_sort(order, std::greater{}, [&](int i) { return earth[i] / quarter_cells(i); });
  std::uint64_t soft = 0;
  double taken = 0.0;
  for (const int i : order) {
    if (taken + 0.5 * quarter_cells(i) > cells + kRounding) break;
    taken += quarter_cells(i);
    soft |= std::uint64_t{1} << i;
  }
  return soft;
}

}  // namespace

std::optional<Pattern> barycentre(std::span<const Pattern> sources, std::span<const double> weights,
                                  BarycentreCut cut) {
  std::uint64_t common = kAllFreePixels, any = 0;
  for (const Pattern& source : sources) {
    common &= ~source.bits() & kAllFreePixels;
    any |= ~source.bits() & kAllFreePixels;
  }
  if (common == any) return sources.front();
  std::vector<Earth> earths;
  double height = 0.0, cells = 0.0;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    earths.push_back(exclusive_earth(~sources[k].bits() & kAllFreePixels & ~common));
    if (earths.back().pixels.empty()) return std::nullopt;
    height += weights[k] / sum * earths.back().cell_height;
    cells += weights[k] / sum / earths.back().cell_height;
  }
  const std::vector<double> earth = Programme(earths, weights).solve();
  if (earth.empty()) return std::nullopt;
  const std::uint64_t soft = common | (cut == BarycentreCut::height ? cut_at(height, earth) : highest(cells, earth));
  return Pattern(~soft & kAllFreePixels);
}

}  // namespace nacre::families
