#include "scene/overlapping_components.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/diagnose.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::box;

/// The same with its normals turned.
shapes::Shape inward(shapes::Shape shape) {
  for (Triangle& t : shape.triangles) std::swap(t[1], t[2]);
  return shape;
}

std::vector<OverlappingComponent> overlapping(const shapes::Shape& shape) {
  const Surface surface = shape.surface();
  const PreparedSurface prepared = prepare(surface, {});
  IntersectionFinder finder(prepared.triangles());
  const Diagnosis diagnosis = diagnose(surface, prepared, {}, finder);
  return overlapping_components(prepared, diagnosis.components,
                                meeting_components(diagnosis.components, diagnosis.pairs));
}

TEST(OverlappingComponents, shares_of_boxes_are_those_of_their_volumes) {
  // Half of the bar's width, half of its depth and 0.7 of its height lie in the first box; the third is apart.
  shapes::Shape shape = box(Vec3(1, 1, 1));
  shape.add(box(Vec3(0.5, 0.5, 1)), Vec3(0.75, 0.75, 0.3)).add(box(Vec3(1, 1, 1)), Vec3(9, 0, 0));
  const std::vector<OverlappingComponent> found = overlapping(shape);
  ASSERT_EQ(found.size(), 1u) << "4 % of the first box are less than what is listed";
  EXPECT_EQ(found[0].component, 1u);
  EXPECT_EQ(found[0].first_face, 12);
  EXPECT_NEAR(found[0].volume_share, 0.5 * 0.5 * 0.7, 0.05);
}

TEST(OverlappingComponents, what_lies_in_several_others_counts_once) {
  shapes::Shape shape = box(Vec3(1, 1, 1));
  shape.add(box(Vec3(1, 1, 1)), Vec3(0.6, 0.01, 0.02)).add(box(Vec3(1, 1, 1)), Vec3(0.62, 0.03, -0.01));
  const std::vector<OverlappingComponent> found = overlapping(shape);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].volume_share, 0.4, 0.05);
}

TEST(OverlappingComponents, open_surfaces_hollows_and_what_only_lies_inside_are_left_out) {
  shapes::Shape in_a_sheet = shapes::bumpy_sheet(4, 0);
  EXPECT_TRUE(overlapping(in_a_sheet.add(box(Vec3(1, 1, 1)), Vec3(-0.4, -0.4, -0.4))).empty());
  shapes::Shape hollow = box(Vec3(3, 3, 3));
  EXPECT_TRUE(overlapping(hollow.add(inward(box(Vec3(2.5, 2, 2))), Vec3(0.9, 0.5, 0.5))).empty());
  shapes::Shape nested = box(Vec3(3, 3, 3));
  EXPECT_TRUE(overlapping(nested.add(box(Vec3(1, 1, 1)), Vec3(1, 1, 1))).empty());
}

TEST(OverlappingComponents, thin_and_slanted_parts_are_measured_as_others) {
  // A rod from the middle of a large box to the outside, along the diagonal of space.
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 0, 0), Vec3(1, 1, 1)).toRotationMatrix();
  shapes::Shape rod = box(Vec3(20, 0.1, 0.1));
  for (Vec3& p : rod.points) p = turn * p;
  shapes::Shape shape = box(Vec3(10, 10, 10));
  const std::vector<OverlappingComponent> found = overlapping(shape.add(rod, Vec3(5, 5, 5)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].volume_share, 5 * std::numbers::sqrt3 / 20, 0.06);
}

}  // namespace
}  // namespace unsnarl
