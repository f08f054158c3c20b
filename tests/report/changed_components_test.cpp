#include "report/changed_components.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/rotation.h"
#include "rigid/rigid_motion.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

shapes::Shape cube(double side) {
  return shapes::box(Vec3::Constant(side));
}

/// Two cubes of side 1; the second begins `overlap` before the end of the first, along x, and 0.1 higher.
shapes::Shape two_cubes(double overlap) {
  return cube(1).add(cube(1), Vec3(1 - overlap, 0.1, 0.1));
}
constexpr Index second = 8;  // its first vertex

/// What is said where the vertices of the shape, from `first` on, are moved by `motion`.
template <class Motion>
std::vector<ChangedComponent> changed(const shapes::Shape& shape, Index first, const Motion& motion, double gap = 0) {
  const Surface surface = shape.surface();
  const PreparedSurface prepared = prepare(surface, {});
  IntersectionFinder finder(prepared.triangles());
  Positions x = prepared.rest;
  for (Index v = first; v < x.cols(); ++v) x.col(v) = motion(Vec3(x.col(v)));
  return changed_components(prepared, diagnose(surface, prepared, {}, finder), x, gap,
                            prepared.diagonal_of(surface.positions));
}
template <class Motion>
std::vector<ChangedComponent> second_cube_changed(double overlap, const Motion& motion, double gap = 0) {
  return changed(two_cubes(overlap), second, motion, gap);
}
auto shift(double by) {
  return [by](const Vec3& p) { return Vec3(p[0] + by, p[1], p[2]); };
}

TEST(ChangedComponents, small_changes_are_not_named) {
  EXPECT_TRUE(second_cube_changed(0.2, shift(0)).empty());
  EXPECT_TRUE(second_cube_changed(0.2, shift(0.3)).empty()) << "less than twice the depth";
  EXPECT_TRUE(
      second_cube_changed(0.2, [](const Vec3& p) { return Vec3(0.8 + (p[0] - 0.8) * 0.96, p[1], p[2]); }).empty());
  const Eigen::Matrix3d turn = rotation_by(Vec3(0, 0, 4 * std::numbers::pi / 180));
  EXPECT_TRUE(second_cube_changed(0.2, [&](const Vec3& p) { return Vec3(turn * p); }).empty());
}

TEST(ChangedComponents, lost_volume_is_named) {
  const auto found =
      second_cube_changed(0.2, [](const Vec3& p) { return Vec3(0.8 + (p[0] - 0.8) * 0.75, p[1], p[2]); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].component, 1u);
  EXPECT_EQ(found[0].first_face, 12);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_TRUE(found[0].has_shrunk);
  EXPECT_FALSE(found[0].is_turned);
  EXPECT_FALSE(found[0].is_far);
  EXPECT_NEAR(found[0].size_change_rel, -0.25, 1e-12);
}

TEST(ChangedComponents, what_is_turned_inside_out_has_lost_more_than_all) {
  const auto found = second_cube_changed(0.2, [](const Vec3& p) { return Vec3(2 - p[0], p[1], p[2]); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size_change_rel, -2, 1e-12);
  EXPECT_NE(describe(found[0], 1).find("component 1 was turned inside out"), std::string::npos);
}

TEST(ChangedComponents, of_open_ones_the_area_counts) {
  const auto found = changed(shapes::bumpy_sheet(4, 0), 0, [](const Vec3& p) { return Vec3(0.9 * p); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].is_closed);
  EXPECT_NEAR(found[0].size_change_rel, 0.81 - 1, 1e-12);
  EXPECT_NE(describe(found[0], 1).find("component 0 lost 19 % of its area"), std::string::npos);
}

TEST(ChangedComponents, rotations_are_named_with_their_angle) {
  const Eigen::Matrix3d turn = rotation_by(Vec3(0, 0, 12 * std::numbers::pi / 180));
  const Vec3 middle(1.3, 0.6, 0.6);
  const auto found = second_cube_changed(0.2, [&](const Vec3& p) { return Vec3(turn * (p - middle) + middle); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_turned);
  EXPECT_FALSE(found[0].has_shrunk);
  EXPECT_NEAR(found[0].rotation_deg, 12, 1e-9);
}

TEST(ChangedComponents, new_creases_are_named_with_their_share) {
  const auto folded = [](double degrees) {
    const Eigen::Matrix3d turn = rotation_by(Vec3(0, degrees * std::numbers::pi / 180, 0));
    return [turn](const Vec3& p) { return p[0] > 0 ? Vec3(turn * p) : p; };
  };
  const auto creased = [&](int cells, double degrees) {
    const auto found = changed(shapes::bumpy_sheet(cells, 0), 0, folded(degrees));
    return found.empty() ? 0 : found[0].creased_share;
  };
  EXPECT_NEAR(creased(8, 70), 0.125, 1e-12) << "half of the triangles of two of eight columns";
  EXPECT_NEAR(creased(16, 70), 0.0625, 1e-12) << "half of it on a mesh twice as fine";
  EXPECT_EQ(creased(8, 40), 0);
  const auto found = changed(shapes::bumpy_sheet(8, 0), 0, folded(70));
  EXPECT_TRUE(found[0].is_creased);
  EXPECT_NE(describe(found[0], 1).find("has new creases on 12 % of its area"), std::string::npos);
}

TEST(ChangedComponents, far_is_more_than_twice_the_depth_and_the_gap) {
  const auto found = second_cube_changed(0.2, shift(0.5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_far);
  const double diagonal = Vec3(1.8, 1.1, 1.1).norm();
  EXPECT_NEAR(*found[0].depth_rel * diagonal, 0.2, 1e-12);
  EXPECT_NEAR(found[0].displacement_rel * diagonal, 0.5, 1e-12);
  EXPECT_GE(found[0].farthest_vertex, second);
  EXPECT_EQ(describe(found[0], diagonal), "component 1 moved by 0.5 (21 % of the diagonal) where it overlapped by 0.2");
  EXPECT_TRUE(second_cube_changed(0.2, shift(0.5), 0.11).empty());
}

TEST(ChangedComponents, what_overlaps_nothing_may_not_move_at_all) {
  ASSERT_EQ(second_cube_changed(-0.2, shift(0.1)).size(), 1u);
  EXPECT_TRUE(second_cube_changed(-0.2, shift(0.01)).empty()) << "less than 1 % of its own diagonal";
}

TEST(ChangedComponents, the_middle_of_a_large_face_is_measured_too) {
  // The end of a long box, larger than its depth, in a cube with vertices far from it.
  shapes::Shape shape = cube(2), bar = cube(1);
  for (Vec3& p : bar.points) p[0] *= 5;
  const double depth = 0.4;
  const auto found = changed(shape.add(bar, Vec3(2 - depth, 0.5, 0.5)), second, shift(0.9));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(*found[0].depth_rel * Vec3(6.6, 2, 2).norm(), depth, 1e-12);
}

TEST(ChangedComponents, depths_that_are_not_known_make_nothing_far) {
  shapes::Shape sheets = shapes::crossed_squares();
  const auto of_open = changed(sheets, 0, shift(100));
  EXPECT_TRUE(of_open.empty());
  shapes::Shape cube_in_sheet = shapes::bumpy_sheet(4, 0);
  const auto found = changed(cube_in_sheet.add(cube(1), Vec3(-0.4, -0.4, -0.3)), 25, shift(3));
  ASSERT_EQ(found.size(), 1u) << "the sheet is open, but the cube is closed";
  EXPECT_NEAR(*found[0].depth_rel * Vec3(4, 4, 1).norm(), 0.3, 0.1);
}

TEST(ChangedComponents, what_lost_most_comes_first) {
  shapes::Shape shape = cube(1);
  shape.add(cube(1), Vec3(3, 0, 0)).add(cube(1), Vec3(6, 0, 0)).add(cube(1), Vec3(9, 0, 0));
  const auto squeezed = [](const Vec3& p) {
    const int number = static_cast<int>(p[0] / 3);
    const double kept = std::array<double, 4>{0.9, 0.5, 1, 0.8}[number];
    return Vec3(p[0], p[1] + (number == 2 ? 0.3 : 0), kept * p[2]);
  };
  const auto found = changed(shape, 0, squeezed);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].component, 1u);
  EXPECT_EQ(found[1].component, 3u);
  EXPECT_EQ(found[2].component, 0u);
  EXPECT_EQ(found[3].component, 2u);
}

TEST(ChangedComponents, advice_counts_the_parts) {
  EXPECT_EQ(advice_on_overlaps({}), "");
  const std::vector<OverlappingComponent> two(2);
  EXPECT_EQ(advice_on_overlaps(two).find("2 parts overlap by more than 10 % of their volume: "), 0u);
  EXPECT_EQ(
      advice_on_overlaps(std::span(two).first(1)).find("1 part overlaps others by more than 10 % of its volume: "), 0u);
}

}  // namespace
}  // namespace unsnarl
