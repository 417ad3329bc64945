#include "families/isomap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

#include "base/random.hpp"
#include "base/result.hpp"
#include "families/delaunay.hpp"

namespace nacre::families {
namespace {

/// Points of a rectangle, and their distances when it is rolled up in space.
struct Rolled {
  Eigen::MatrixX2d plane;
  DistanceMatrix distances;
};

Rolled rolled_plane(int count, double radius) {
  Rolled rolled{Eigen::MatrixX2d(count, 2), DistanceMatrix(static_cast<std::size_t>(count))};
  RandomStream random(1, "rolled plane");
  for (Eigen::Index i = 0; i < count; ++i) rolled.plane.row(i) << random.uniform(0.0, 4.0), random.uniform(0.0, 2.0);
  const auto in_space = [&](Eigen::Index i) {
    const double angle = rolled.plane(i, 0) / radius;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), rolled.plane(i, 1));
  };
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      rolled.distances.set(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                           (in_space(i) - in_space(j)).norm());
  return rolled;
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / std::sqrt(x.squaredNorm() * y.squaredNorm());
}

TEST(Isomap, RecoversAPlaneThatIsRolledUp) {
  const Rolled rolled = rolled_plane(700, 0.9);  // more than half a turn
  const Embedding embedding = isomap(rolled.distances);
  EXPECT_EQ(embedding.bridges, 0);
  EXPECT_LT(embedding.residual_variance, 0.01);
  EXPECT_GT(std::abs(correlation(embedding.points.col(0), rolled.plane.col(0))), 0.995);
  EXPECT_GT(std::abs(correlation(embedding.points.col(1), rolled.plane.col(1))), 0.98);
}

TEST(Isomap, JoinsPartsThatHangTogetherNowhere) {
  DistanceMatrix distances(30);
  for (std::size_t i = 0; i < 30; ++i)  // three heaps of ten on a line, twenty apart
    for (std::size_t j = 0; j < i; ++j)
      distances.set(i, j,
                    std::abs(20.0 * (static_cast<double>(i / 10) - static_cast<double>(j / 10)) +
                             0.1 * (static_cast<double>(i % 10) - static_cast<double>(j % 10))));
  const Embedding embedding = isomap(distances, 3);
  EXPECT_EQ(embedding.bridges, 2);
  EXPECT_LT(embedding.residual_variance, 1e-6);
  EXPECT_NEAR(std::abs(embedding.points(0, 0) - embedding.points(29, 0)), 40.9, 0.01);
  EXPECT_THROW(isomap(DistanceMatrix(3)), InputError);
}

TEST(Delaunay, HasAnEmptyCircleAroundEveryTriangle) {
  RandomStream random(2, "delaunay");
  Eigen::MatrixX2d points(60, 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) << random.uniform(), random.uniform();
  const std::vector<Triangle> triangles = delaunay(points);
  EXPECT_GT(triangles.size(), 60u);
  double area = 0.0;
  for (const Triangle& t : triangles) {
    const Eigen::RowVector2d a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
    area += 0.5 * std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
    Eigen::Matrix2d sides;
    sides << b - a, c - a;
    const Eigen::Vector2d halves(0.5 * (b.squaredNorm() - a.squaredNorm()), 0.5 * (c.squaredNorm() - a.squaredNorm()));
    const Eigen::RowVector2d centre = sides.colPivHouseholderQr().solve(halves).transpose();
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      EXPECT_GE((points.row(i) - centre).norm(), (a - centre).norm() - 1e-9);
  }
  EXPECT_GT(area, 0.8);  // of the square: the hull of 60 points
}

TEST(Delaunay, OfPointsOnALineIsEmpty) {
  Eigen::MatrixX2d line(5, 2);
  for (Eigen::Index i = 0; i < 5; ++i) line.row(i) << static_cast<double>(i), 2.0 * static_cast<double>(i);
  EXPECT_TRUE(delaunay(line).empty());
  EXPECT_TRUE(delaunay(line.topRows(2)).empty());
}

}  // namespace
}  // namespace nacre::families
