#include "untangle/conflict_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

// A long strip of n cells; needles that pierce it in the cells given are triangles of their own.
shapes::Shape pierced_strip(Index n, const std::vector<int>& cells) {
  shapes::Shape shape = shapes::grid(n, 1, false, [](double i, double j) { return Vec3(i, j, 0); });
  for (const int cell : cells) {
    shapes::Shape needle;
    needle.points = {Vec3(cell + 0.5, 0.3, -1), Vec3(cell + 0.5, 0.31, 1), Vec3(cell + 0.51, 0.3, 1)};
    needle.triangles = {{0, 1, 2}};
    shape.add(needle);
  }
  return shape;
}

std::size_t region_count(const std::vector<int>& cells) {
  const shapes::Shape shape = pierced_strip(30, cells);
  return conflict_regions(shapes::scene_of(shape), shapes::pairs_of(shape)).size();
}

TEST(ConflictRegions, group_what_lies_within_two_edges) {
  EXPECT_EQ(region_count({}), 0u);
  EXPECT_EQ(region_count({5}), 1u);
  EXPECT_EQ(region_count({5, 6}), 1u) << "faces that share vertices";
  EXPECT_EQ(region_count({5, 7}), 1u) << "one edge between them";
  EXPECT_EQ(region_count({5, 8}), 1u) << "two edges between them";
  EXPECT_EQ(region_count({5, 9}), 2u) << "three edges between them";
  EXPECT_EQ(region_count({3, 12, 22}), 3u);
  EXPECT_EQ(region_count({3, 22, 12, 5}), 3u);
}

TEST(ConflictRegions, hold_every_pair_and_vertex_once) {
  const shapes::Shape shape = pierced_strip(30, {3, 12, 22, 5});
  const auto pairs = shapes::pairs_of(shape);
  ASSERT_GE(pairs.size(), 4u);
  const auto regions = conflict_regions(shapes::scene_of(shape), pairs);
  std::vector<IntersectingPair> all;
  Index last_first = -1;
  for (const ConflictRegion& region : regions) {
    EXPECT_TRUE(std::is_sorted(region.core.begin(), region.core.end()));
    EXPECT_TRUE(std::is_sorted(region.pairs.begin(), region.pairs.end()));
    EXPECT_GT(region.core.front(), last_first) << "ordered by their smallest vertices";
    last_first = region.core.front();
    std::vector<Index> core;
    for (const IntersectingPair& pair : region.pairs)
      for (Index t : {pair.a, pair.b}) core.insert(core.end(), shape.triangles[t].begin(), shape.triangles[t].end());
    std::sort(core.begin(), core.end());
    core.erase(std::unique(core.begin(), core.end()), core.end());
    EXPECT_EQ(region.core, core);
    all.insert(all.end(), region.pairs.begin(), region.pairs.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_TRUE(all == pairs);
}

// Faces of two components that intersect are one region, however far apart their vertices are by edges.
TEST(ConflictRegions, intersecting_faces_belong_together) {
  const shapes::Shape shape = shapes::crossed_squares();
  EXPECT_EQ(conflict_regions(shapes::scene_of(shape), shapes::pairs_of(shape)).size(), 1u);
}

TEST(Dilate, goes_ring_by_ring) {
  // Vertices 2 i and 2 i + 1 are the two ends of strategy i.
  Scene scene = shapes::scene_of(pierced_strip(30, {}));
  const std::vector<Index> start = {20, 21};
  EXPECT_EQ(dilate(scene, start, 0), start);
  EXPECT_EQ(dilate(scene, start, 1), (std::vector<Index>{18, 19, 20, 21, 22, 23}));
  EXPECT_EQ(dilate(scene, start, 2), (std::vector<Index>{16, 17, 18, 19, 20, 21, 22, 23, 24, 25}));
  EXPECT_EQ(dilate(scene, start, 1000).size(), 62u) << "the whole component";
  EXPECT_TRUE(dilate(scene, {}, 3).empty());
}

TEST(Dilate, leaves_fixed_vertices_out_but_goes_past_them) {
  Scene scene = shapes::scene_of(pierced_strip(30, {}));
  scene.fixed[20] = scene.fixed[22] = scene.fixed[23] = 1;
  const std::vector<Index> start = {20, 21};
  EXPECT_EQ(dilate(scene, start, 2), (std::vector<Index>{16, 17, 18, 19, 21, 24, 25}));
}

// A fan of needles around vertex 0, two of them far apart pierced.
shapes::Shape pierced_fan() {
  constexpr int spokes = 120;
  shapes::Shape shape;
  shape.points.push_back({0, 0, 0});
  for (int k = 0; k < spokes; ++k) {
    const double angle = 2 * M_PI * k / spokes;
    shape.points.push_back({100 * std::cos(angle), 100 * std::sin(angle), 0});
    shape.triangles.push_back({0, k + 1, (k + 1) % spokes + 1});
  }
  for (const int k : {10, 70}) {
    const Vec3 foot = (shape.points[0] + shape.points[k + 1] + shape.points[k + 2]) / 3;
    shapes::Shape needle;
    needle.points = {foot - Vec3(0, 0, 1), foot + Vec3(0, 0, 1), foot + Vec3(0.01, 0, 1)};
    needle.triangles = {{0, 1, 2}};
    shape.add(needle);
  }
  return shape;
}

TEST(ConflictRegions, vertices_of_high_valence_do_not_join_them) {
  const shapes::Shape shape = pierced_fan();
  const Scene scene = shapes::scene_of(shape);
  const auto pairs = shapes::pairs_of(shape);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(conflict_regions(scene, pairs).size(), 1u);
  const auto regions = conflict_regions(scene, pairs, 50);
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions[0].core, (std::vector<Index>{11, 12, 121, 122, 123}));
  EXPECT_EQ(regions[0].pairs.size(), 1u);
  EXPECT_EQ(dilate(scene, regions[0].core, 2).size(), 121u + 3u);
  EXPECT_EQ(dilate(scene, regions[0].core, 1, 50), (std::vector<Index>{10, 11, 12, 13, 121, 122, 123}));
}

}  // namespace
}  // namespace unsnarl
