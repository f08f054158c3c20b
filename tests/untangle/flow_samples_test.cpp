#include "untangle/flow_samples.h"

#include <gtest/gtest.h>

#include "mesh/areas.h"
#include "untangle/flow_shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

TEST(FlowSamples, MeansAndSpreadAreTransposes) {
  const Patch patch = patch_of(limb_and_sheet());
  const FlowSamples samples(patch.triangles, patch.rest, patch.free_count, 0.5);
  ASSERT_GT(samples.size(), 20);
  EXPECT_LT(samples.size(), patch.free_count / 2);
  double area = 0;
  for (Index c = 0; c < samples.size(); ++c) area += samples.area(c);
  EXPECT_NEAR(area, total_area(patch.rest, patch.triangles), 1e-9);
  Positions points, spread = Positions::Zero(3, patch.rest.cols());
  samples.points(patch.rest, points);
  Positions force(3, samples.size());
  for (Index c = 0; c < samples.size(); ++c) force.col(c) = Vec3(std::sin(c), std::cos(2 * c), c % 5);
  samples.spread(force, spread);
  EXPECT_NEAR(spread.cwiseProduct(patch.rest).sum(), force.cwiseProduct(points).sum(), 1e-9);
}

TEST(FlowSamples, GeodesicsFollowTheSurface) {
  // A cylinder of radius 1: half-way round is pi along the surface and 2 through space. A sphere apart is out of reach.
  Shape shape = unit_grid(12, 40, false, true,
                          [](double u, double v) { return Vec3(std::cos(tau * v), std::sin(tau * v), 2 * u); });
  shape.add(sphere(Vec3(0, 0, 1), 0.2, 6));
  const Patch patch = patch_of(shape);
  FlowSamples samples(patch.triangles, patch.rest, patch.free_count, 0.3);
  Positions points;
  samples.points(patch.rest, points);
  for (Index i = 0; i < samples.size(); ++i) {
    for (Index j = 0; j < samples.size(); ++j) {
      const double d = samples.geodesic(i, j, 5);
      const bool same = (points.col(i).head<2>().norm() > 0.5) == (points.col(j).head<2>().norm() > 0.5);
      if (!same) {
        EXPECT_EQ(d, 5);
        EXPECT_FALSE(samples.adjacent(i, j));
        continue;
      }
      EXPECT_GE(d, 0.95 * (points.col(i) - points.col(j)).norm());
      if (points.col(i).head<2>().norm() < 0.5) continue;
      const double angle = std::acos(
          std::clamp(points.col(i).head<2>().normalized().dot(points.col(j).head<2>().normalized()), -1.0, 1.0));
      const double exact = std::hypot(angle, points(2, i) - points(2, j));
      EXPECT_LE(d, 1.5 * exact + 0.1);  // a third of the spacing
      if (samples.adjacent(i, j)) {
        EXPECT_NE(i, j);
      }
    }
  }
}

}  // namespace
}  // namespace unsnarl
