#include "untangle/far_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "energy/minkowski_penalty.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

TEST(FarRegions, are_those_that_moved_many_times_their_overlap) {
  Shape shape = shapes::crossing_bumps(8, 0.3);
  const Index n = static_cast<Index>(shape.points.size());
  shape.add(shapes::crossing_bumps(8, 0.3), {50, 0, 0});
  Scene scene = shapes::scene_of(shape);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  std::vector<std::vector<Index>> regions(2, std::vector<Index>(n));
  std::iota(regions[0].begin(), regions[0].end(), 0);
  std::iota(regions[1].begin(), regions[1].end(), n);
  EXPECT_TRUE(far_regions(scene, regions, pairs).empty()) << "nothing has moved";
  // The overlap is between 0 and 0.3 deep.
  scene.x.col(3) += Vec3(0, 0, 0.3);
  scene.x.col(n + 3) += Vec3(0, 0, 30);
  EXPECT_EQ(far_regions(scene, regions, pairs), std::vector<std::vector<Index>>({regions[1]}));
}

// The finer the mesh, the less its faces overlap where the surfaces run through each other as deeply.
TEST(FarRegions, moved_farther_than_their_pockets_are_deep) {
  const Shape shape = shapes::crossing_wide_bumps(3, 1);
  Scene scene = shapes::scene_of(shape);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  std::vector<std::vector<Index>> regions(1, std::vector<Index>(scene.vertex_count()));
  std::iota(regions[0].begin(), regions[0].end(), 0);
  double deepest = 0;
  for (const IntersectingPair& pair : pairs)
    deepest = std::max(deepest, overlap_depth(scene.rest, scene.triangles[pair.a], scene.triangles[pair.b]));
  ASSERT_LT(21 * deepest, 2);
  scene.x.col(3) += Vec3(0, 0, 21 * deepest);
  EXPECT_TRUE(far_regions(scene, regions, pairs).empty());
  scene.x.col(3) += Vec3(0, 0, 20);
  EXPECT_EQ(far_regions(scene, regions, pairs), regions);
}

TEST(FarRegions, have_to_be_a_good_part_of_their_components) {
  const Shape shape = shapes::crossing_bumps(8, 0.3);
  Scene scene = shapes::scene_of(shape);
  scene.x.col(0) += Vec3(0, 0, 30);
  const std::vector<IntersectingPair> pairs = shapes::pairs_of(shape);
  const std::vector<std::vector<Index>> regions = {{0, scene.triangles[pairs[0].a][0]}};
  EXPECT_TRUE(far_regions(scene, regions, pairs).empty());
}

TEST(FarRegions, without_a_pair_there_is_no_measure) {
  const Shape shape = shapes::bumpy_sheet(6, 0.5);
  Scene scene = shapes::scene_of(shape);
  scene.x.col(0) += Vec3(0, 0, 100);
  const std::vector<std::vector<Index>> regions = {{0, 1, 2}};
  EXPECT_TRUE(far_regions(scene, regions, {}).empty());
}

}  // namespace
}  // namespace unsnarl
