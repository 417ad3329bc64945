#include "scalar_explicit.hpp"

#include <cmath>

#include "fem/element.hpp"

namespace nacre::bench {
namespace {

constexpr float kGaussPoint = 0.21132487f;  // (1 - 1/sqrt 3) / 2

}  // namespace

ScalarExplicit::ScalarExplicit(const fem::Grid& grid, const fem::ExplicitSettings& settings)
    : columns_(grid.columns), rows_(grid.rows), elements_(static_cast<std::size_t>(grid.element_count())) {
  const double h = grid.element_size_m, dt = settings.time_step_s, density = settings.density_kg_per_m3;
  strain_per_step_ = settings.strain_rate_per_s * dt;
  force_pa_ = density * h * h / (dt * dt) / grid.columns;
  alpha_ = static_cast<float>(settings.gamma_per_s * dt);
  const double scale = dt * dt / (4.0 * density * h * h);
  const std::vector<material::Lame> lame = fem::lame_of(grid);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (grid.phase[e] != fem::Phase::empty)
      elements_[e] = {.mu = static_cast<float>(lame[e].mu_pa * scale),
                      .lambda = static_cast<float>(lame[e].lambda_pa * scale),
                      .threshold = static_cast<float>(grid.threshold_j_per_m3[e] * scale),
                      .empty = false};
  const auto nodes = static_cast<std::size_t>((columns_ + 1) * (rows_ + 1));
  for (std::vector<float>* field : {&qx_, &qy_, &vx_, &vy_, &fx_, &fy_, &smooth_x_, &smooth_y_}) field->resize(nodes);
}

void ScalarExplicit::add_element_forces(int row, int column) {
  Element& element = elements_[row * columns_ + column];
  if (element.empty) return;
  const int first = row * (columns_ + 1) + column;
  const int node[4] = {first, first + 1, first + columns_ + 1, first + columns_ + 2};
  float largest = 0.0f;
  for (int point = 0; point < 4; ++point) {
    const float x = point % 2 == 0 ? kGaussPoint : 1.0f - kGaussPoint;
    const float y = point / 2 == 0 ? kGaussPoint : 1.0f - kGaussPoint;
    const float nx[4] = {-(1.0f - y), 1.0f - y, -y, y}, ny[4] = {-(1.0f - x), -x, 1.0f - x, x};
    float xx = 0.0f, xy = 0.0f, yx = 0.0f, yy = static_cast<float>(strain_);
    for (int a = 0; a < 4; ++a) {
      const auto n = static_cast<std::size_t>(node[a]);
      xx += qx_[n] * nx[a];
      xy += qx_[n] * ny[a];
      yx += qy_[n] * nx[a];
      yy += qy_[n] * ny[a];
    }
    const float change = xx + yy + (xx * yy - xy * yx), inverse_j = 1.0f / (1.0f + change), log_j = std::log1p(change);
    const float t = (element.mu * change + element.lambda * log_j) * inverse_j;
    const float pxx = element.mu * (xx - yy) + t * (1.0f + yy), pyy = element.mu * (yy - xx) + t * (1.0f + xx);
    const float shear = element.mu * (xy + yx), pxy = shear - t * yx, pyx = shear - t * xy;
    for (int a = 0; a < 4; ++a) {
      fx_[node[a]] -= pxx * nx[a] + pxy * ny[a];
      fy_[node[a]] -= pyx * nx[a] + pyy * ny[a];
    }
    const float isochoric = (xx - yy) * (xx - yy) + (xy + yx) * (xy + yx) + 2.0f * (change - log_j);
    largest = std::fmax(largest, 0.5f * (element.mu * isochoric + element.lambda * log_j * log_j));
  }
  if (largest > element.threshold) {
    element.empty = true;
    ++failed_;
  }
}

void ScalarExplicit::add_forces() {
  std::fill(fx_.begin(), fx_.end(), 0.0f);
  std::fill(fy_.begin(), fy_.end(), 0.0f);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) add_element_forces(row, column);
}

void ScalarExplicit::accelerate() {
  for (int row = 0; row <= rows_; ++row)
    for (int column = 0; column <= columns_; ++column) {
      const auto n = static_cast<std::size_t>(row * (columns_ + 1) + column);
      vx_[n] += fx_[n];
      if (row > 0 && row < rows_) vy_[n] += fy_[n];
    }
}

/// Eq. 2.4 on interior nodes, then q += v.
void ScalarExplicit::smooth() {
  smooth_x_ = vx_;
  smooth_y_ = vy_;
  for (int row = 1; row < rows_; ++row)
    for (int column = 1; column < columns_; ++column) {
      float x = 0.0f, y = 0.0f;
      for (int dr = -1; dr <= 1; ++dr)
        for (int dc = -1; dc <= 1; ++dc) {
          const auto n = static_cast<std::size_t>((row + dr) * (columns_ + 1) + column + dc);
          x += vx_[n];
          y += vy_[n];
        }
      const auto n = static_cast<std::size_t>(row * (columns_ + 1) + column);
      smooth_x_[n] += alpha_ * (x / 9.0f - vx_[n]);
      smooth_y_[n] += alpha_ * (y / 9.0f - vy_[n]);
    }
  vx_.swap(smooth_x_);
  vy_.swap(smooth_y_);
  for (std::size_t n = 0; n < qx_.size(); ++n) {
    qx_[n] += vx_[n];
    qy_[n] += vy_[n];
  }
}

double ScalarExplicit::step() {
  add_forces();
  double bottom = 0.0, top = 0.0;
  for (int column = 0; column <= columns_; ++column) {
    bottom += fy_[column];
    top -= fy_[rows_ * (columns_ + 1) + column];
  }
  accelerate();
  smooth();
  strain_ += strain_per_step_;
  return 0.5 * (bottom + top) * force_pa_;
}

}  // namespace nacre::bench
