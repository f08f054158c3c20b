#include "untangle/local/separating_forces.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// Two flat sheets, the second one at this height above the first.
Patch two_flat_sheets(double height) {
  const shapes::Shape sheet = shapes::bumpy_sheet(4, 0);
  return shapes::patch_of(shapes::Shape(sheet).add(sheet, {0.2, 0.1, height}));
}

TEST(PenaltyForce, parts_sheets_within_its_margin) {
  const Patch patch = two_flat_sheets(0.05);
  const Index half = patch.free_count / 2;
  PenaltyForce penalty(patch, 0.1);
  Positions force = Positions::Zero(3, patch.x.cols());
  penalty.add(patch.x, force);
  EXPECT_LT(force.row(2).leftCols(half).sum(), 0);
  EXPECT_GT(force.row(2).rightCols(half).sum(), 0);
  EXPECT_NEAR(force.row(2).sum(), 0, 1e-9);
  penalty.set_margin(0.01);
  force.setZero();
  penalty.add(patch.x, force);
  EXPECT_TRUE(force.isZero());
}

TEST(DeepestOverlap, is_that_of_the_deepest_pair) {
  const Patch patch = shapes::patch_of(shapes::crossing_bumps(12, 0.5));
  const std::vector<IntersectingPair> pairs = shapes::pairs_at(patch.x, patch.triangles);
  ASSERT_GT(pairs.size(), 2u);
  double deepest = 0;
  for (const IntersectingPair& pair : pairs)
    deepest = std::max(deepest, deepest_overlap(patch, patch.x, std::span(&pair, 1)));
  EXPECT_GT(deepest, 0);
  EXPECT_EQ(deepest_overlap(patch, patch.x, pairs), deepest);
  EXPECT_EQ(deepest_overlap(patch, patch.x, {}), 0);
}

TEST(ContourForce, pushes_two_sheets_apart) {
  const Patch patch = shapes::patch_of(shapes::crossing_bumps(12, 0.5));
  const Index half = patch.free_count / 2;
  const EdgeTable edges = build_edges(patch.triangles);
  const std::vector<IntersectingPair> pairs = shapes::pairs_at(patch.x, patch.triangles);
  const PenaltyForce penalty(patch, 0.03);
  for (const SheetMotion motion : {SheetMotion::slide, SheetMotion::offset, SheetMotion::steeper}) {
    Positions force = Positions::Zero(3, patch.x.cols());
    add_contour_force(patch, patch.x, edges, pairs, penalty.penalty(), motion, force);
    const double lower = force.row(2).leftCols(half).sum(), upper = force.row(2).rightCols(half).sum();
    EXPECT_LT(lower * upper, 0) << static_cast<int>(motion);
    std::vector<Triangle> triangles = patch.triangles;
    // A small step along the force shortens the curve: fewer or as many pairs.
    const Positions x = patch.x + 0.1 / force.colwise().norm().maxCoeff() * force;
    EXPECT_LE(shapes::pairs_at(x, triangles).size(), pairs.size()) << static_cast<int>(motion);
  }
}

}  // namespace
}  // namespace unsnarl
