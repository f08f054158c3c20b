#include "untangle/coarse/coarse_to_fine.h"

#include <gtest/gtest.h>

#include <atomic>

#include "geometry/parallel.h"
#include "mesh/areas.h"
#include "scene/shapes.h"
#include "untangle/conflict_regions.h"
#include "untangle/escalation.h"
#include "untangle/local/local_solver.h"
#include "untangle/strategies.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

/// A closed tube pushed through a smooth map that is too strong for it: `fine` says how many faces it has.
shapes::Shape tangled_tube(Index fine) {
  const double length = 20 * fine, around = 8 * fine;
  return shapes::grid(static_cast<Index>(length), static_cast<Index>(around), true, [=](double i, double j) {
    const double angle = 2 * M_PI * j / around;
    const Vec3 p(10 * (i / length - 0.5), std::cos(angle), std::sin(angle));
    return Vec3(p + Vec3(1.9 * std::sin(1.3 * p[0] + 0.4 * p[1]), 0.8 * std::sin(0.9 * p[0] + 0.7 * p[2]), 0));
  });
}

CoarseResult solve(Patch& patch, double factor, std::span<const IntersectingPair> tolerated,
                   const std::function<bool()>& stop, CoarseMeshes meshes = CoarseMeshes::until_solved) {
  const Task task{.tolerated = tolerated, .untangle = make_untangler(stop, {}), .stop = stop};
  return solve_on_coarser_mesh(patch, task, coarse_options(factor, meshes));
}

std::size_t pairs_in(const Patch& patch) {
  return IntersectionFinder(patch.triangles, patch.active_count).find(patch.x).size();
}

TEST(CoarseToFine, resolves_nearly_all_of_a_deep_tangle) {
  const shapes::Shape shape = shapes::crossing_wide_bumps(2, 2);
  Patch patch = shapes::patch_of(shape);
  const std::size_t before = pairs_in(patch);
  ASSERT_GT(before, 100u);
  const CoarseResult result = solve(patch, 4, {}, {});
  EXPECT_EQ(result.pairs_left, pairs_in(patch));
  EXPECT_LE(result.pairs_left, before / 20);
  // Whatever lies far from the tangle has stayed, and nothing has gone farther than a few times its depth.
  double farthest = 0;
  Index at_rest = 0;
  for (Index v = 0; v < patch.free_count; ++v) {
    farthest = std::max(farthest, (patch.x.col(v) - patch.rest.col(v)).norm());
    at_rest += patch.x.col(v) == patch.rest.col(v);
  }
  EXPECT_LT(farthest, 3);
  EXPECT_GT(at_rest, patch.free_count / 2);
}

TEST(CoarseToFine, coarse_meshes_do_without_what_is_left_out) {
  Patch patch = shapes::patch_of(shapes::crossing_wide_bumps(2, 2));
  const std::size_t before = pairs_in(patch);
  std::vector<std::string> all;
  for (const Tier& tier : coarse_mesh_tiers())
    for (const Strategy& strategy : tier.strategies) all.push_back(strategy.name);
  const Task task{.untangle = make_untangler({}, all)};
  EXPECT_EQ(solve_on_coarser_mesh(patch, task, coarse_options(4, CoarseMeshes::one)).pairs_left, before);
  EXPECT_EQ(patch.x, patch.rest);
}

TEST(CoarseToFine, resolves_tubes_that_run_through_themselves) {
  for (const Index fine : {2, 3}) {
    Patch patch = shapes::patch_of(tangled_tube(fine));
    const std::size_t before = pairs_in(patch);
    ASSERT_GT(before, 50u);
    const CoarseResult result = solve(patch, fine, {}, {});
    EXPECT_LE(result.pairs_left, before / 10) << before << " before";
  }
}

TEST(CoarseToFine, vertices_that_come_back_between_narrow_layers_find_places) {
  Patch patch = shapes::patch_of(tangled_tube(8));
  const std::size_t before = pairs_in(patch);
  ASSERT_GT(before, 1000u);
  EXPECT_LE(solve(patch, 8 / 1.5, {}, {}).pairs_left, before / 30);
}

TEST(CoarseToFine, tries_parts_that_went_far_again) {
  double motion = 0;
  for (const double factor : {3.0, 3.5, 5.0}) {
    Patch patch = shapes::patch_of(tangled_tube(2));
    const std::size_t before = pairs_in(patch);
    EXPECT_LT(solve(patch, factor, {}, {}, CoarseMeshes::one).pairs_left, before / 10);
    motion += (patch.x - patch.rest).colwise().norm().mean();
  }
  EXPECT_LT(motion, 1.12);  // 1.08; more where none is tried again
}

TEST(CoarseToFine, carries_the_nearest_of_several_solutions) {
  // Rounded, so that it is the same whatever the library of functions: others differ less, and either way.
  shapes::Shape shape = shapes::limb_and_sheet();
  for (Vec3& p : shape.points) p = (p * 0x1p16).array().round() * 0x1p-16;
  const auto motion_with = [&](CoarseMeshes meshes) {
    Patch patch = shapes::patch_of(shape);
    EXPECT_EQ(solve(patch, 2.5, {}, {}, meshes).pairs_left, 0u);
    return (patch.x - patch.rest).colwise().norm().mean();
  };
  EXPECT_LT(motion_with(CoarseMeshes::until_solved), 0.8 * motion_with(CoarseMeshes::one));  // 0.018, 0.026
}

TEST(CoarseToFine, resolves_what_no_short_step_can) {
  for (const shapes::Shape& shape : {shapes::thick_trefoil(), shapes::figure_eight_torus(), shapes::limb_and_sheet(),
                                     shapes::punctured_cross_cap(), shapes::punctured_roman_surface()}) {
    SCOPED_TRACE(shape.triangles.size());
    Patch patch = shapes::patch_of(shape);
    const std::size_t before = pairs_in(patch);
    ASSERT_GT(before, 50u);
    EXPECT_LE(solve(patch, 3, {}, {}).pairs_left, before / 10);
    EXPECT_LE(pairs_in(patch), before / 10);
    for (const Triangle& t : patch.triangles) EXPECT_GT(triangle_area(patch.x, t), 0);
    const double diagonal = (patch.rest.rowwise().maxCoeff() - patch.rest.rowwise().minCoeff()).norm();
    EXPECT_LT((patch.x - patch.rest).colwise().norm().mean(), 0.15 * diagonal);
  }
}

TEST(CoarseToFine, an_embedded_patch_stays_where_it_is) {
  Patch patch = shapes::patch_of(shapes::bumpy_sheet(24, 2, 6));
  const CoarseResult result = solve(patch, 4, {}, {});
  EXPECT_EQ(result.pairs_left, 0u);
  EXPECT_TRUE(patch.x == patch.rest);
}

TEST(CoarseToFine, what_cannot_be_simplified_stays_where_it_is) {
  shapes::Shape shape;
  shape.points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, -0.5, -1}, {0, -0.5, 1}, {0.1, 2, 0.1}};
  shape.triangles = {{0, 1, 2}, {3, 4, 5}};
  Patch patch = shapes::patch_of(shape);
  const Positions before = patch.x;
  const CoarseResult result = solve(patch, 2, {}, {});
  EXPECT_GT(result.pairs_left, 0u);
  EXPECT_TRUE(patch.x == before);
}

TEST(CoarseToFine, holds_what_is_fixed_and_lets_tolerated_pairs_be) {
  const shapes::Shape shape = shapes::crossing_wide_bumps(2, 2);
  const Scene scene = shapes::scene_of(shape);
  SceneIndex index(scene);
  const std::vector<ConflictRegion> regions = conflict_regions(scene, index.find_pairs());
  ASSERT_EQ(regions.size(), 1u);
  Patch patch = cut_patch(scene, index, dilate(scene, regions[0].core, 12), 10);
  patch.edge_length = 0.5;
  const Positions before = patch.x;
  // All are tolerated: nothing is left to be done.
  IntersectionFinder finder(patch.triangles, patch.active_count);
  const std::vector<IntersectingPair> pairs = finder.find(patch.x);
  EXPECT_TRUE(solve(patch, 4, pairs, {}).pairs_left == 0);
  EXPECT_TRUE(patch.x == before);

  const CoarseResult result = solve(patch, 4, {}, {});
  EXPECT_LT(result.pairs_left, pairs.size() / 10);
  for (Index v = patch.free_count; v < patch.x.cols(); ++v) EXPECT_TRUE(patch.x.col(v) == before.col(v));
}

TEST(CoarseToFine, ends_soon_when_it_is_stopped_at_any_time) {
  const shapes::Shape shape = shapes::crossing_wide_bumps(2, 2);
  std::atomic<int> questions = 0;  // any thread may ask
  Patch whole = shapes::patch_of(shape);
  solve(whole, 4, {}, [&] { return ++questions < 0; });
  ASSERT_GT(questions, 100);
  for (int share = 0; share < 8; ++share) {
    Patch patch = shapes::patch_of(shape);
    const std::size_t before = pairs_in(patch);
    const int last = questions * share / 8;
    const Positions start = patch.x;
    std::atomic<int> asked = 0;
    const CoarseResult result = solve(patch, 4, {}, [&] { return ++asked > last; });
    EXPECT_LT(asked, last + 16);
    EXPECT_EQ(result.pairs_left, pairs_in(patch));
    EXPECT_LE(result.pairs_left, before);
    if (last == 0) {
      EXPECT_TRUE(patch.x == start);
    }
  }
}

TEST(CoarseToFine, is_the_same_with_any_number_of_threads) {
  const shapes::Shape shape = shapes::crossing_wide_bumps(2, 2);
  Positions expected;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const ThreadLimit control(threads);
    Patch patch = shapes::patch_of(shape);
    solve(patch, 4, {}, {});
    if (threads == 1) expected = patch.x;
    EXPECT_TRUE(patch.x == expected) << threads << " threads";
  }
}

}  // namespace
}  // namespace unsnarl
