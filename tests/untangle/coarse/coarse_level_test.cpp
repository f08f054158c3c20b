#include "untangle/coarse/coarse_level.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

TEST(CoarseMesh, becomes_as_coarse_as_asked_for) {
  const Patch patch = shapes::patch_of(shapes::crossing_wide_bumps(2, 1));
  CoarseMesh coarse(patch, {});
  const double wanted = static_cast<double>(patch.triangles.size()) / 4;
  const std::size_t faces = coarsen(coarse, patch, wanted, {});
  EXPECT_LE(static_cast<double>(faces), wanted);
  EXPECT_GT(static_cast<double>(faces), wanted / 4);
  EXPECT_EQ(coarse.mesh.triangles().size(), faces);
}

TEST(CoarseMesh, stays_as_it_is_when_it_is_stopped) {
  const Patch patch = shapes::patch_of(shapes::crossing_wide_bumps(2, 1));
  CoarseMesh coarse(patch, {});
  EXPECT_EQ(coarsen(coarse, patch, 10, [] { return true; }), patch.triangles.size());
}

TEST(CoarseLevel, is_the_mesh_as_a_scene_of_its_own) {
  Patch patch = shapes::patch_of(shapes::bumpy_sheet(12, 1));
  CoarseMesh coarse(patch, {});
  coarsen(coarse, patch, 60, {});
  coarse.x.row(2).array() += 1;
  CoarseLevel level = make_level(coarse, patch);
  EXPECT_TRUE(std::is_sorted(level.vertices.begin(), level.vertices.end()));
  ASSERT_EQ(level.scene.vertex_count(), static_cast<Index>(level.vertices.size()));
  for (Index k = 0; k < level.scene.vertex_count(); ++k) {
    EXPECT_TRUE(level.scene.rest.col(k) == patch.rest.col(level.vertices[k]));
    EXPECT_TRUE(level.scene.x.col(k) == coarse.x.col(level.vertices[k]));
  }
  level.scene.x.setConstant(7);
  take_over(level, coarse);
  for (const Index v : level.vertices) EXPECT_TRUE(coarse.x.col(v) == Vec3::Constant(7));
}

TEST(CoarseLevel, tolerates_the_patch_s_pairs_under_their_numbers_there) {
  const Patch patch = shapes::patch_of(shapes::crossing_bumps(12, 0.5));
  const std::vector<IntersectingPair> tolerated = {shapes::pairs_at(patch.x, patch.triangles).front()};
  CoarseMesh coarse(patch, tolerated);
  coarsen(coarse, patch, 60, {});
  const CoarseLevel level = make_level(coarse, patch);
  const std::vector<IntersectingPair> found = tolerated_on(level, {}, coarse, tolerated);
  ASSERT_EQ(found.size(), 1u);
  const auto corners = [](const Scene& scene, Index t) {
    Positions at(3, 3);
    for (int k = 0; k < 3; ++k) at.col(k) = scene.rest.col(scene.triangles[t][k]);
    return at;
  };
  for (int k = 0; k < 3; ++k)
    EXPECT_TRUE(corners(level.scene, found[0].a).col(k) == patch.rest.col(patch.triangles[tolerated[0].a][k]));
}

TEST(CoarseLevel, recovers_what_is_not_at_rest) {
  const Patch patch = shapes::patch_of(shapes::bumpy_sheet(12, 1));
  CoarseMesh coarse(patch, {});
  coarsen(coarse, patch, 60, {});
  CoarseLevel level = make_level(coarse, patch);
  const Index moved = level.scene.vertex_count() / 2;
  level.scene.x.col(moved) += Vec3(0, 0, 0.5);
  SceneIndex index(level.scene);
  recover_level(level, index, {}, {});
  EXPECT_LT((level.scene.x - level.scene.rest).col(moved).norm(), 0.1);
}

}  // namespace
}  // namespace unsnarl
