#include "untangle/local/sheet_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

struct Crossed {
  Shape shape;
  EdgeTable edges = build_edges(shape.triangles);
  Contours contours = trace_contours(shape.positions(), shape.triangles, edges, shapes::pairs_of(shape));

  Vec3 point_of(const Crossing& c) const {
    const auto [u, v] = edges.edges[c.edge];
    return (1 - c.along) * shape.points[u] + c.along * shape.points[v];
  }
  /// How fast a motion shortens the curves.
  double rate(SheetMotion motion) const {
    const std::vector<Vec3> pushes = sheet_pushes(contours, motion);
    double rate = 0;
    for (std::size_t i = 0; i < pushes.size(); ++i)
      rate += contours.crossings[i].side * pushes[i].dot(contours.crossings[i].direction);
    return rate;
  }
};

// A tube through a wider and wider one: they cross once around.
Crossed tube_and_funnel() {
  Shape shape = shapes::tube(12, 31, 2.1);
  shape.add(shapes::grid(12, 29, true, [](double i, double j) {
    const double angle = 6.283185307179586 * j / 29 + 0.07, r = 2.137 + 0.2 * (i - 5.83);
    return Vec3(i - 5.83, r * std::cos(angle), r * std::sin(angle));
  }));
  return {shape};
}

Crossed sheets() {
  return {shapes::crossing_bumps(12, 0.3)};
}

TEST(SheetMotion, slides_go_one_way_along_a_curve) {
  const Crossed tubes = tube_and_funnel();
  ASSERT_EQ(tubes.contours.count, 1);
  const std::vector<Vec3> pushes = sheet_pushes(tubes.contours, SheetMotion::slide);
  ASSERT_EQ(pushes.size(), tubes.contours.crossings.size());
  for (const Vec3& push : pushes) {
    EXPECT_NEAR((push - pushes[0]).norm(), 0, 1e-12);
    EXPECT_NEAR(push.norm(), 1, 1e-12);
  }
}

TEST(SheetMotion, offsets_part_what_lies_around_each_other) {
  const Crossed tubes = tube_and_funnel();
  const std::vector<Vec3> pushes = sheet_pushes(tubes.contours, SheetMotion::offset);
  double squares = 0, side = 0;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    Vec3 outward = tubes.point_of(tubes.contours.crossings[i]);
    outward[0] = 0;
    const double radial = pushes[i].dot(outward.normalized());
    EXPECT_GT(std::abs(radial), 0.8);
    if (i == 0) side = radial;
    EXPECT_GT(radial * side, 0) << "one goes in where others go out";
    squares += pushes[i].squaredNorm();
  }
  EXPECT_NEAR(squares / static_cast<double>(pushes.size()), 1, 1e-12);
  EXPECT_GT(tubes.rate(SheetMotion::offset), 5 * tubes.rate(SheetMotion::slide));
}

TEST(SheetMotion, free_crossings_have_each_its_own) {
  const Crossed tubes = tube_and_funnel();
  const std::vector<Vec3> pushes = sheet_pushes(tubes.contours, SheetMotion::free);
  for (std::size_t i = 0; i < pushes.size(); ++i)
    EXPECT_TRUE(pushes[i] == tubes.contours.crossings[i].side * tubes.contours.crossings[i].direction);
}

TEST(SheetMotion, steeper_is_the_one_that_shortens_faster) {
  for (const Crossed& crossed : {tube_and_funnel(), sheets()}) {
    ASSERT_EQ(crossed.contours.count, 1);
    const double slide = crossed.rate(SheetMotion::slide), offset = crossed.rate(SheetMotion::offset);
    EXPECT_GT(slide, 0);
    EXPECT_GT(offset, 0);
    EXPECT_EQ(crossed.rate(SheetMotion::steeper), std::max(slide, offset));
  }
}

TEST(SheetMotion, curves_do_not_influence_each_other) {
  Shape both = tube_and_funnel().shape;
  both.add(sheets().shape, {100, 0, 0});
  const Crossed all{both};
  ASSERT_EQ(all.contours.count, 2);
  for (const SheetMotion motion : {SheetMotion::slide, SheetMotion::offset, SheetMotion::steeper, SheetMotion::free})
    EXPECT_NEAR(all.rate(motion), tube_and_funnel().rate(motion) + sheets().rate(motion), 1e-9);
}

}  // namespace
}  // namespace unsnarl
