#include "untangle/flow.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "mesh/areas.h"
#include "untangle/flow_shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

double mean_displacement(const Patch& patch) {
  const double diagonal = (patch.rest.rowwise().maxCoeff() - patch.rest.rowwise().minCoeff()).norm();
  return (patch.x - patch.rest).colwise().norm().mean() / diagonal;
}

void expect_untangled(Patch& patch, double largest_mean_displacement, double largest_growth) {
  ASSERT_GT(count_pairs(patch), 0u);
  const FlowResult result = flow(patch);
  EXPECT_TRUE(result.clean) << result.pairs_left;
  EXPECT_EQ(count_pairs(patch), 0u);
  EXPECT_LT(mean_displacement(patch), largest_mean_displacement);
  const double growth = total_area(patch.x, patch.triangles) / total_area(patch.rest, patch.triangles);
  EXPECT_LT(growth, largest_growth);
  EXPECT_GT(growth, 1 / largest_growth);
  for (const Triangle& t : patch.triangles) {
    EXPECT_GE(triangle_area(patch.x, t), 1e-3 * triangle_area(patch.rest, t));
  }
}

TEST(Flow, ParsTwoSpheres) {
  Patch patch = patch_of(two_spheres(12));
  expect_untangled(patch, 0.02, 1.1);
}

TEST(Flow, OpensAThickTrefoil) {
  Patch patch = patch_of(thick_trefoil());
  expect_untangled(patch, 0.25, 2);
}

TEST(Flow, OpensAFigureEightTorus) {
  Patch patch = patch_of(figure_eight_torus());
  ASSERT_GT(count_pairs(patch), 0u);
  const FlowResult result = flow(patch);
  EXPECT_TRUE(result.clean) << result.pairs_left;
  EXPECT_EQ(count_pairs(patch), 0u);
  EXPECT_LT(mean_displacement(patch), 0.25);
}

TEST(Flow, FreesALimbPressedThroughASheet) {
  Patch patch = patch_of(limb_and_sheet());
  expect_untangled(patch, 0.1, 1.2);
}

TEST(Flow, FixedVerticesAndObstaclesStayBitIdentical) {
  // The sheet stands still: only the limb may give way.
  Patch patch = patch_with_fixed(limb_and_sheet(), [](const Vec3& p) { return p[2] == 0.003; });
  ASSERT_LT(patch.active_count, static_cast<Index>(patch.triangles.size()));
  const Positions before = patch.rest;
  expect_untangled(patch, 0.2, 1.5);
  const Index fixed = static_cast<Index>(before.cols()) - patch.free_count;
  EXPECT_EQ(patch.x.rightCols(fixed), before.rightCols(fixed));
  EXPECT_EQ(patch.rest, before);
}

TEST(Flow, WorksInARegionWithFixedSurroundings) {
  // Two sheets, one dented through the other in the middle; only the middle may move.
  const auto sheet = [](double height, double dent) {
    return unit_grid(20, 20, false, false, [=](double u, double v) {
      const double x = 4 * u - 2, y = 4 * v - 2;
      return Vec3(x, y, height - dent * std::exp(-4 * (x * x + y * y)));
    });
  };
  Shape shape = sheet(0.1, 0.25);
  shape.add(sheet(0.0, 0));
  Patch patch = patch_with_fixed(shape, [](const Vec3& p) { return p.head<2>().norm() > 1.5; });
  const Positions before = patch.rest;
  expect_untangled(patch, 0.05, 1.1);
  const Index fixed = static_cast<Index>(before.cols()) - patch.free_count;
  EXPECT_EQ(patch.x.rightCols(fixed), before.rightCols(fixed));
}

TEST(Flow, SeparatesCoincidentSheets) {
  const auto sheet = [] { return unit_grid(6, 6, false, false, [](double u, double v) { return Vec3(u, v, 0); }); };
  Shape shape = sheet();
  shape.add(sheet());
  Patch patch = patch_of(shape);
  expect_untangled(patch, 0.05, 1.1);
}

TEST(Flow, OpensFoldsAndOneVertexCrossings) {
  // A strip folded back flat onto itself.
  Patch fold =
      patch_of(unit_grid(8, 4, false, false, [](double u, double v) { return Vec3(u < 0.5 ? u : 1 - u, 0.5 * v, 0); }));
  expect_untangled(fold, 0.1, 1.2);
  // One vertex of a flat fan pulled across its neighbours.
  Shape fan;
  fan.points.push_back(Vec3::Zero());
  for (int k = 0; k < 8; ++k) fan.points.emplace_back(std::cos(tau * k / 8), std::sin(tau * k / 8), 0.1 * (k % 3));
  fan.points[1] = Vec3(-0.3, 0.75, 0.05);
  for (Index k = 0; k < 8; ++k) fan.triangles.push_back({0, k + 1, (k + 1) % 8 + 1});
  Patch crossing = patch_of(fan);
  ASSERT_GT(count_pairs(crossing), 0u);
  const FlowResult result = flow(crossing);
  EXPECT_TRUE(result.clean) << result.pairs_left;
  EXPECT_EQ(count_pairs(crossing), 0u);
}

TEST(Flow, LeavesCleanInputAlone) {
  Patch patch = patch_of(sphere(Vec3(0, 0, 0), 1, 8));
  const FlowResult result = flow(patch);
  EXPECT_TRUE(result.clean);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(patch.x, patch.rest);
}

TEST(Flow, DuplicateFacesAndToleratedPairsAreLetBe) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, 8);
  shape.triangles.push_back({shape.triangles[5][1], shape.triangles[5][2], shape.triangles[5][0]});
  Patch patch = patch_of(shape);
  ASSERT_EQ(count_pairs(patch), 1u);
  EXPECT_TRUE(flow(patch).clean);

  Patch tangled = patch_of(limb_and_sheet());
  const std::vector<IntersectingPair> pairs = IntersectionFinder(tangled.triangles).find(tangled.x);
  const FlowResult result = flow(tangled, {}, pairs);
  EXPECT_TRUE(result.clean);
  EXPECT_EQ(tangled.x, tangled.rest);
}

TEST(Flow, StopsWhenToldToAndKeepsTheBestState) {
  Patch patch = patch_of(figure_eight_torus());
  const std::size_t before = count_pairs(patch);
  int asked = 0;
  const FlowResult result = flow(patch, [&] { return ++asked > 10; });
  EXPECT_FALSE(result.clean);
  EXPECT_GT(result.iterations, 0);
  EXPECT_LE(result.iterations, 10) << "it asks once an iteration at least";
  EXPECT_LE(asked, 20) << "told so, it goes on";
  EXPECT_EQ(count_pairs(patch), result.pairs_left);
  EXPECT_LE(result.pairs_left, before);
}

TEST(Flow, GivesTheSameBytesAtAnyThreadCount) {
  std::vector<Positions> results;
  for (const std::size_t threads : {1, 2, 4}) {
    const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    Patch patch = patch_of(thick_trefoil());
    flow(patch);
    results.push_back(patch.x);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace unsnarl
