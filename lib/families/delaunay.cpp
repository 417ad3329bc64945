#include "families/delaunay.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace nacre::families {
namespace {

/// Qhull's state, freed with everything it allocated.
class Qhull {
 public:
  Qhull() : sink_(std::fopen("/dev/null", "w")) { qh_zero(&state_, sink_); }
  ~Qhull() {
    qh_freeqhull(&state_, !qh_ALL);
    int left = 0, total = 0;
    qh_memfreeshort(&state_, &left, &total);
    std::fclose(sink_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  qhT* state() { return &state_; }
  FILE* sink() const { return sink_; }

 private:
  qhT state_{};
  FILE* sink_;  // degenerate points are a result here, not a message
};

std::vector<Triangle> lower_triangles(qhT* qh) {
  std::vector<Triangle> triangles;
  facetT* facet;
  FORALLfacets {
    if (facet->upperdelaunay || qh_setsize(qh, facet->vertices) != 3) continue;
    Triangle triangle{};
    std::size_t corner = 0;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) triangle[corner++] = qh_pointid(qh, vertex->point);
    std::ranges::sort(triangle);
    triangles.push_back(triangle);
  }
  std::ranges::sort(triangles);
  return triangles;
}

}  // namespace

std::vector<Triangle> delaunay(const Eigen::MatrixX2d& points) {
  if (points.rows() < 3) return {};
  std::vector<coordT> coordinates;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    coordinates.push_back(points(i, 0));
    coordinates.push_back(points(i, 1));
  }
  Qhull qhull;
  char command[] = "qhull d Qt Qbb Qc";
  const int failed =
      qh_new_qhull(qhull.state(), 2, points.rows(), coordinates.data(), False, command, nullptr, qhull.sink());
  return failed ? std::vector<Triangle>{} : lower_triangles(qhull.state());
}

}  // namespace nacre::families
