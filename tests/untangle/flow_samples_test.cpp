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

TEST(FlowSamples, AdjacentClustersAreThoseJoinedByAnEdge) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 6);
  shape.add(sphere(Vec3(0.1, 0, 0), 1, 6));
  const Patch patch = patch_of(shape);
  const FlowSamples samples(patch.triangles, patch.rest, patch.free_count, 0.3);
  std::vector<std::pair<Index, Index>> joined;
  for (const Triangle& t : patch.triangles)
    for (const Index u : t)
      for (const Index v : t)
        if (samples.cluster_of(u) != samples.cluster_of(v))
          joined.emplace_back(samples.cluster_of(u), samples.cluster_of(v));
  std::sort(joined.begin(), joined.end());
  for (Index i = 0; i < samples.size(); ++i)
    for (Index j = 0; j < samples.size(); ++j)
      EXPECT_EQ(samples.adjacent(i, j), std::binary_search(joined.begin(), joined.end(), std::pair(i, j)));
}

}  // namespace
}  // namespace unsnarl
