#include "untangle/coarse/vertex_insertion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "contact/intersection_finder.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using Removal = ProgressiveMesh::Removal;

constexpr double roundoff = 1e-12;

/// A wavy sheet of 13 x 13 vertices, an edge long each, that has lost a round of them; and a fixed triangle far away.
struct CoarseSheet {
  static constexpr Index free_count = 13 * 13;
  Patch patch;
  ProgressiveMesh mesh;

  CoarseSheet() : patch(make_patch()), mesh(patch.triangles, ranks_of(patch)) { mesh.coarsen(patch.rest); }

  static Patch make_patch() {
    shapes::Shape shape =
        shapes::grid(12, 12, false, [](double i, double j) { return Vec3(i, j, 0.3 * std::sin(i) * std::cos(j)); });
    const auto active_count = static_cast<Index>(shape.triangles.size());
    for (const double y : {-1.0, 0.0, 1.0}) shape.points.push_back({0.1 * y * y, 0.05 * y, 9});
    shape.triangles.push_back({free_count, free_count + 1, free_count + 2});
    return shapes::patch_of(shape, free_count, active_count);
  }
  static std::vector<std::uint8_t> ranks_of(const Patch& patch) {
    std::vector<std::uint8_t> ranks(patch.vertices.size(), ProgressiveMesh::stays);
    std::fill(ranks.begin(), ranks.begin() + free_count, std::uint8_t{0});
    return ranks;
  }
};

/// The positions with those of the vertices that come back gone.
Positions without(const std::vector<Removal>& removals, Positions x) {
  for (const Removal& removal : removals) x.col(removal.vertex).setConstant(100);
  return x;
}

TEST(VertexInsertion, what_is_at_rest_comes_back_exactly) {
  CoarseSheet sheet;
  const std::vector<Removal> removals = sheet.mesh.refine();
  ASSERT_GT(removals.size(), 10u);
  Positions x = without(removals, sheet.patch.rest);
  EXPECT_TRUE(insert_vertices(sheet.patch, sheet.mesh, removals, x).empty());
  EXPECT_TRUE(x == sheet.patch.rest);
}

TEST(VertexInsertion, offsets_turn_with_their_fans) {
  CoarseSheet sheet;
  const std::vector<Removal> removals = sheet.mesh.refine();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 2).normalized()).toRotationMatrix();
  Positions turned = sheet.patch.rest;
  turned.leftCols(sheet.free_count) = turn * turned.leftCols(sheet.free_count);
  Positions x = without(removals, turned);
  EXPECT_TRUE(insert_vertices(sheet.patch, sheet.mesh, removals, x).empty());
  EXPECT_LT((x - turned).cwiseAbs().maxCoeff(), roundoff);
}

TEST(VertexInsertion, goes_elsewhere_where_something_is_in_the_way_and_back_when_that_is_gone) {
  CoarseSheet sheet;
  const std::vector<Removal> removals = sheet.mesh.refine();
  Positions moved = sheet.patch.rest;
  moved.leftCols(sheet.free_count).row(2).array() += 0.25;
  const auto height_above_fan = [&](const Removal& removal) {
    double height = moved(2, removal.vertex);
    for (int k = 0; k < 3; ++k) height -= removal.weights[k] * moved(2, removal.corners[k]);
    return height;
  };
  const Removal& highest = *std::max_element(removals.begin(), removals.end(), [&](const Removal& a, const Removal& b) {
    return height_above_fan(a) < height_above_fan(b);
  });
  const double height = height_above_fan(highest);
  ASSERT_GT(height, 0.05);
  // The fixed triangle stands upright beside the tip, and reaches a little below it.
  const Vec3 tip = moved.col(highest.vertex);
  Patch& patch = sheet.patch;
  for (Index k = 0; k < 3; ++k)
    patch.x.col(sheet.free_count + k) = tip + Vec3(0.02 + 0.01 * k, k == 1 ? 0.01 : 0, k == 1 ? -0.3 * height : height);
  moved.rightCols(3) = patch.x.rightCols(3);

  Positions x = without(removals, moved);
  const std::vector<Removal> displaced = insert_vertices(patch, sheet.mesh, removals, x);
  ASSERT_EQ(displaced.size(), 1u);
  EXPECT_EQ(displaced[0].vertex, highest.vertex);
  EXPECT_GT((x.col(highest.vertex) - tip).norm(), 0.1 * height);
  EXPECT_TRUE(shapes::pairs_at(x, patch.triangles).empty());

  const Positions beside = x;
  offer_better_places(patch, sheet.mesh, displaced, x);
  EXPECT_NE((x - moved).cwiseAbs().maxCoeff(), 0);
  EXPECT_TRUE(shapes::pairs_at(x, patch.triangles).empty());

  x = beside;
  x.rightCols(3) = patch.rest.rightCols(3);
  offer_better_places(patch, sheet.mesh, displaced, x);
  EXPECT_LT((x - moved).leftCols(sheet.free_count).cwiseAbs().maxCoeff(), roundoff);
}

}  // namespace
}  // namespace unsnarl
