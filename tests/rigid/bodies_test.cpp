#include "rigid/bodies.h"

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "rigid/boxes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

TEST(Bodies, displacement_is_that_of_the_vertices) {
  const Shape box = shapes::box({1, 2, 3}, 3);
  Bodies bodies(box.positions(), box.triangles, shapes::parts_of({&box}), 1, {});
  Body& body = bodies.list()[0];
  EXPECT_EQ(body.squared_displacement(), 0);
  EXPECT_TRUE(body.is_at_rest());
  body.rotation = rotation_by({0.3, -0.2, 0.7});
  body.centre += Vec3(0.5, 1, -2);
  bodies.move(body);
  const Positions moved = bodies.x() - bodies.rest();
  EXPECT_NEAR(body.squared_displacement(), moved.squaredNorm(), 1e-9);
  EXPECT_NEAR(bodies.largest_displacement(body), moved.colwise().norm().maxCoeff(), 1e-12);
  body.rotation.setIdentity();
  body.centre = body.rest_centre;
  bodies.move(body);
  EXPECT_EQ(bodies.x(), bodies.rest());
}

TEST(Bodies, know_what_they_must_not_meet) {
  // A body in the middle, through a fixed box, another body and a soft sheet.
  const Shape middle = shapes::box({2, 1, 1}, 2), other = shapes::box({1, 1, 1}, 2);
  Shape scene = middle;
  scene.add(other, {1.2, 0.1, 0.2}).add(other, {-1.2, 0.1, 0.2});
  const auto sheet_begin = static_cast<Index>(scene.points.size());
  scene.add(shapes::bumpy_sheet(4, 0.1));
  std::vector<Index> body_of(scene.points.size(), -1);
  std::vector<std::uint8_t> fixed(scene.points.size(), 0);
  for (std::size_t v = 0; v < middle.points.size() + other.points.size(); ++v)
    body_of[v] = v < middle.points.size() ? 0 : 1;
  for (Index v = static_cast<Index>(middle.points.size() + other.points.size()); v < sheet_begin; ++v) fixed[v] = 1;
  Bodies bodies(scene.positions(), scene.triangles, body_of, 2, fixed);
  const auto met = [&] {
    std::array<bool, 3> kinds = {};  // body, obstacle, soft
    for (const IntersectingPair& pair : bodies.contacts_of(bodies.list()[0])) {
      const Index v = scene.triangles[pair.b][0];
      kinds[body_of[v] == 1 ? 0 : fixed[v] ? 1 : 2] = true;
    }
    return kinds;
  };
  EXPECT_EQ(met(), (std::array<bool, 3>{true, true, false}));
  bodies.set_present(1, false);
  EXPECT_EQ(met(), (std::array<bool, 3>{false, true, false}));
  bodies.avoid_soft(0);
  EXPECT_EQ(met(), (std::array<bool, 3>{false, true, true}));
  EXPECT_FALSE(bodies.is_free(bodies.list()[0]));
  bodies.list()[0].centre += Vec3(0, 20, 0);
  bodies.move(bodies.list()[0]);
  EXPECT_TRUE(bodies.is_free(bodies.list()[0]));
}

}  // namespace
}  // namespace unsnarl
