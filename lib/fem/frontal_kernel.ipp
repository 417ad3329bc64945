// Dense arithmetic of the frontal factorisation, compiled once per instruction set (frontal_kernel_*.cpp define
// NACRE_SIMD).
//
// Every number of the front is reduced by the pivots in their order, one fused operation each, then scaled: whatever
// the width of vectors and tiles, the bits are the same. Tiles of up to kTileColumns x kTileVectors vectors stay in
// registers while all earlier pivots run past them.

#include <cmath>
#include <cstdint>
#include <type_traits>

#include <immintrin.h>

#include "fem/frontal_kernel.hpp"

namespace nacre::fem::NACRE_SIMD {

#include "fem/simd_packs.hpp"

using Vector = Pack<double>;
inline constexpr int kWidth = kLanes<double>;
inline constexpr int kTileColumns = kWidth == 8 ? 8 : 4;
inline constexpr int kTileVectors = 3;

NACRE_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }

void add_element(const FrontView& f, const FrontElement& element, const double* shear, const double* bulk) {
  constexpr int kUnknowns = 8;
  double stiffness[kUnknowns];
  for (int b = 0; b < kUnknowns; ++b) {
    if (element.rows[b] < 0) continue;
    for (int a = 0; a < kUnknowns; a += kWidth) {
      const Vector scaled_bulk = broadcast(element.lambda_pa) * load(bulk + b * kUnknowns + a);
      store(stiffness + a, fma(broadcast(element.mu_pa), load(shear + b * kUnknowns + a), scaled_bulk));
    }
    double* const column = f.column(element.rows[b]);
    for (int a = 0; a < kUnknowns; ++a)
      if (element.rows[a] >= element.rows[b]) column[element.rows[a]] += stiffness[a];
  }
}

void add_half(const FrontView& f, const FrontView& half, const BorderRun* runs, int count) {
  for (int first = 0; first < count; ++first)
    for (int i = 0; i < runs[first].count; ++i) {
      const double* const from = half.update + (runs[first].from + i) * half.border_rows;
      double* const to = f.column(runs[first].row + i);
      for (int run = first; run < count; ++run) {
        int j = run == first ? i : 0;
        const double* const values = from + runs[run].from;
        double* const target = to + runs[run].row;
        for (; j + kWidth <= runs[run].count; j += kWidth) store(target + j, load(target + j) + load(values + j));
        for (; j < runs[run].count; ++j) target[j] += values[j];
      }
    }
}

/// `Columns` columns of `Vectors` vectors of rows.
template <int Columns, int Vectors>
struct Tile {
  Vector value[Columns][Vectors];

  NACRE_INLINE void read(const double* from, int stride) {
    for (int c = 0; c < Columns; ++c)
      for (int v = 0; v < Vectors; ++v) value[c][v] = load(from + c * stride + v * kWidth);
  }
  NACRE_INLINE void write(double* to, int stride) const {
    for (int c = 0; c < Columns; ++c)
      for (int v = 0; v < Vectors; ++v) store(to + c * stride + v * kWidth, value[c][v]);
  }
  /// Subtracts sum_k L(row, k) L(column, k) over the first `count` pivots; `rows` and `columns` point at L(row, 0) and
  /// L(column, 0).
  NACRE_INLINE void subtract(const double* rows, const double* columns, int stride, int count) {
    for (int k = 0; k < count; ++k, rows += stride, columns += stride) {
      Vector row[Vectors];
      for (int v = 0; v < Vectors; ++v) row[v] = load(rows + v * kWidth);
      for (int c = 0; c < Columns; ++c) {
        const Vector factor = broadcast(columns[c]);
        for (int v = 0; v < Vectors; ++v) value[c][v] = fma(-factor, row[v], value[c][v]);
      }
    }
  }
};

/// Eliminates a square of `Columns` pivots whose earlier pivots have been subtracted. The square's upper triangle and
/// diagonal become zero, so that whole vectors of a column can be used afterwards.
template <int Columns>
bool eliminate_square(double* square, int stride, double smallest_pivot, double* inverse) {
  for (int c = 0; c < Columns; ++c) {
    double* column = square + c * stride;
    if (!(column[c] >= smallest_pivot)) return false;
    inverse[c] = 1.0 / std::sqrt(column[c]);
    for (int row = 0; row <= c; ++row) column[row] = 0.0;
    for (int row = c + 1; row < Columns; ++row) column[row] *= inverse[c];
    for (int later = c + 1; later < Columns; ++later)
      for (int row = later; row < Columns; ++row)
        square[later * stride + row] = fused(-column[later], column[row], square[later * stride + row]);
  }
  return true;
}

/// Rows below the square of a panel of pivots.
template <int Columns, int Vectors>
NACRE_INLINE void finish_rows(const FrontView& f, int panel, int row) {
  const int stride = f.stride();
  double* const at = f.factor + panel * stride;
  Tile<Columns, Vectors> tile;
  tile.read(at + row, stride);
  tile.subtract(f.factor + row, f.factor + panel, stride, panel);
  for (int c = 0; c < Columns; ++c) {
    const Vector inverse = broadcast(f.inverse[panel + c]);
    for (int v = 0; v < Vectors; ++v) tile.value[c][v] *= inverse;
    for (int later = c + 1; later < Columns; ++later) {
      const Vector factor = broadcast(at[c * stride + panel + later]);
      for (int v = 0; v < Vectors; ++v) tile.value[later][v] = fma(-factor, tile.value[c][v], tile.value[later][v]);
    }
  }
  tile.write(at + row, stride);
}

/// Calls rows(vectors, row) for the rows from `row` to `end` in tiles of kTileVectors vectors and a last, smaller one.
template <class Rows>
NACRE_INLINE void in_tiles(int row, int end, const Rows& rows) {
  for (; row + kTileVectors * kWidth <= end; row += kTileVectors * kWidth)
    rows(std::integral_constant<int, kTileVectors>{}, row);
  if (row + 2 * kWidth <= end) {
    rows(std::integral_constant<int, 2>{}, row);
    row += 2 * kWidth;
  }
  if (row < end) rows(std::integral_constant<int, 1>{}, row);
}

template <int Columns>
bool pivot_panel(const FrontView& f, int panel, double smallest_pivot) {
  const int stride = f.stride();
  double* const square = f.factor + panel * stride + panel;
  for (int row = 0; row < Columns; row += kWidth) {
    Tile<Columns, 1> tile;
    tile.read(square + row, stride);
    tile.subtract(f.factor + panel + row, f.factor + panel, stride, panel);
    tile.write(square + row, stride);
  }
  if (!eliminate_square<Columns>(square, stride, smallest_pivot, f.inverse + panel)) return false;
  const int below = Columns == kTileColumns ? panel + Columns : f.pivot_rows;
  in_tiles(below, stride, [&](auto vectors, int row) { finish_rows<Columns, vectors>(f, panel, row); });
  return true;
}

template <int Columns>
void border_panel(const FrontView& f, int panel) {
  const int first = panel / kWidth * kWidth;
  in_tiles(first, f.border_rows, [&](auto vectors, int row) {
    Tile<Columns, vectors> tile;
    double* const at = f.update + panel * f.border_rows + row;
    tile.read(at, f.border_rows);
    tile.subtract(f.factor + f.pivot_rows + row, f.factor + f.pivot_rows + panel, f.stride(), f.pivots);
    tile.write(at, f.border_rows);
  });
}

/// Calls panel(columns) with `columns` as a constant.
template <class Panel>
NACRE_INLINE auto with_columns(int columns, const Panel& panel) {
  switch (columns) {
    case 1:
      return panel(std::integral_constant<int, 1>{});
    case 2:
      return panel(std::integral_constant<int, 2>{});
    case 3:
      return panel(std::integral_constant<int, 3>{});
    case 4:
      return panel(std::integral_constant<int, 4>{});
    default:
      break;
  }
  if constexpr (kTileColumns > 4) {
    switch (columns) {
      case 5:
        return panel(std::integral_constant<int, 5>{});
      case 6:
        return panel(std::integral_constant<int, 6>{});
      case 7:
        return panel(std::integral_constant<int, 7>{});
      default:
        break;
    }
  }
  return panel(std::integral_constant<int, kTileColumns>{});
}

bool eliminate(const FrontView& f, double smallest_pivot) {
  for (int panel = 0; panel < f.pivots; panel += kTileColumns) {
    const int columns = f.pivots - panel < kTileColumns ? f.pivots - panel : kTileColumns;
    if (!with_columns(columns, [&](auto count) { return pivot_panel<count>(f, panel, smallest_pivot); })) return false;
  }
  for (int panel = 0; panel < f.border; panel += kTileColumns) {
    const int columns = f.border - panel < kTileColumns ? f.border - panel : kTileColumns;
    with_columns(columns, [&](auto count) { border_panel<count>(f, panel); });
  }
  return true;
}

/// Pivots solved for together: the same at every width, as the order of sums depends on it.
inline constexpr int kGroup = kFrontPadding;

/// Solves for `Columns` pivots from `first` on and subtracts them from the rows below.
template <int Columns>
void forward_group(const FrontView& f, int first, double* x) {
  const int stride = f.stride();
  const double* const column = f.factor + first * stride;
  Vector solved[Columns];
  for (int c = 0; c < Columns; ++c) {
    x[first + c] *= f.inverse[first + c];
    solved[c] = broadcast(x[first + c]);
    for (int row = c + 1; row < Columns; ++row)
      x[first + row] = fused(-column[c * stride + first + row], x[first + c], x[first + row]);
  }
  for (int row = first + kGroup; row < stride; row += kWidth) {
    Vector sum = load(x + row);
    for (int c = 0; c < Columns; ++c) sum = fma(-load(column + c * stride + row), solved[c], sum);
    store(x + row, sum);
  }
}

/// Subtracts from `Columns` pivots from `first` on the part of their columns of L below `below`.
template <int Columns>
void subtract_below(const FrontView& f, int first, int below, double* x) {
  constexpr int kParts = kGroup / kWidth;
  const int stride = f.stride();
  const double* const column = f.factor + first * stride;
  Vector sum[Columns][kParts] = {};  // kGroup partial sums at every width
  for (int row = below; row < stride; row += kGroup)
    for (int part = 0; part < kParts; ++part) {
      const Vector value = load(x + row + part * kWidth);
      for (int c = 0; c < Columns; ++c)
        sum[c][part] = fma(load(column + c * stride + row + part * kWidth), value, sum[c][part]);
    }
  for (int c = 0; c < Columns; ++c) {
    double partial[kGroup];
    for (int part = 0; part < kParts; ++part) store(partial + part * kWidth, sum[c][part]);
    x[first + c] -= ((partial[0] + partial[4]) + (partial[2] + partial[6])) +
                    ((partial[1] + partial[5]) + (partial[3] + partial[7]));
  }
}

void backward_group(const FrontView& f, int first, int columns, double* x) {
  const int stride = f.stride();
  for (int c = 0; c < columns; c += kTileColumns) {
    const int count = columns - c < kTileColumns ? columns - c : kTileColumns;
    with_columns(count, [&](auto constant) { subtract_below<constant>(f, first + c, first + kGroup, x); });
  }
  for (int c = columns; c-- > 0;) {
    x[first + c] *= f.inverse[first + c];
    for (int earlier = 0; earlier < c; ++earlier)
      x[first + earlier] = fused(-f.factor[(first + earlier) * stride + first + c], x[first + c], x[first + earlier]);
  }
}

void forward(const FrontView& f, double* x) {
  for (int first = 0; first < f.pivots; first += kGroup) {
    switch (f.pivots - first) {
      case 1:
        forward_group<1>(f, first, x);
        break;
      case 2:
        forward_group<2>(f, first, x);
        break;
      case 3:
        forward_group<3>(f, first, x);
        break;
      case 4:
        forward_group<4>(f, first, x);
        break;
      case 5:
        forward_group<5>(f, first, x);
        break;
      case 6:
        forward_group<6>(f, first, x);
        break;
      case 7:
        forward_group<7>(f, first, x);
        break;
      default:
        forward_group<kGroup>(f, first, x);
        break;
    }
  }
}

void backward(const FrontView& f, double* x) {
  for (int first = (f.pivot_rows - kGroup); first >= 0; first -= kGroup)
    backward_group(f, first, f.pivots - first < kGroup ? f.pivots - first : kGroup, x);
}

extern const FrontalKernel kFrontal = {add_element, add_half, eliminate, forward, backward};

}  // namespace nacre::fem::NACRE_SIMD
