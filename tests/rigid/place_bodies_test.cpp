#include "rigid/place_bodies.h"

#include <gtest/gtest.h>

#include "rigid/boxes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

TEST(PlaceBodies, the_smaller_one_makes_way_by_about_the_depth) {
  const Shape large = shapes::box({2, 2, 2}, 3), small = shapes::box({1, 1, 1}, 3);
  Shape both = large;
  both.add(small, {1.4, 0.13, 0.07});  // 0.1 deep
  Bodies bodies(both.positions(), both.triangles, shapes::parts_of({&large, &small}), 2, {});
  EXPECT_FALSE(place_bodies(bodies, {}));
  EXPECT_TRUE(bodies.list()[0].is_at_rest());
  EXPECT_TRUE(bodies.list()[1].is_placed);
  EXPECT_TRUE(bodies.is_free(bodies.list()[1]));
  EXPECT_GE(bodies.largest_displacement(bodies.list()[1]), 0.1);
  EXPECT_LT(bodies.largest_displacement(bodies.list()[1]), 0.104);
}

TEST(PlaceBodies, what_may_pass_is_in_no_way) {
  const Shape large = shapes::box({2, 2, 2}, 3), small = shapes::box({1, 1, 1}, 3);
  Shape all = large;
  all.add(small, {1.4, 0.13, 0.07}).add(small, {0.05, 1.3, 0.07});
  std::vector<Index> part_of(large.triangles.size(), 0);
  for (const Index part : {1, 2}) part_of.insert(part_of.end(), small.triangles.size(), part);
  const PassingParts parts(3, std::vector<std::array<Index, 2>>{{0, 1}});
  Bodies bodies(all.positions(), all.triangles, shapes::parts_of({&large, &small, &small}), 3, {},
                Passing({}, part_of, parts));
  EXPECT_FALSE(place_bodies(bodies, {}));
  EXPECT_TRUE(bodies.list()[1].is_at_rest());
  EXPECT_FALSE(bodies.list()[2].is_at_rest());
  for (const Body& body : bodies.list()) EXPECT_TRUE(bodies.is_free(body));
}

TEST(PlaceBodies, turns_where_that_is_nearer) {
  // A plate that stands askew in a slot.
  const Shape wall = shapes::box({0.6, 2, 2}, 3), plate = shapes::turned(shapes::box({0.7, 1.9, 0.5}, 3), 0.12);
  Shape scene = wall;
  scene.add(wall, {1.4, 0, 0}).add(plate, {0.7, 0, 0});
  std::vector<Index> body_of(2 * wall.points.size(), -1);
  std::vector<std::uint8_t> fixed(body_of.size(), 1);
  body_of.insert(body_of.end(), plate.points.size(), 0);
  fixed.insert(fixed.end(), plate.points.size(), 0);
  Bodies bodies(scene.positions(), scene.triangles, body_of, 1, fixed);
  EXPECT_FALSE(place_bodies(bodies, {}));
  const Body& body = bodies.list()[0];
  EXPECT_TRUE(body.is_placed);
  EXPECT_NE(body.rotation, Eigen::Matrix3d::Identity());
  EXPECT_LT(bodies.largest_displacement(body), 0.13);
}

TEST(PlaceBodies, what_may_not_go_far_enough_stays) {
  const Shape box = shapes::box({1, 1, 1}, 2);
  Shape both = box;
  both.add(box, {0.8, 0.13, 0.07});
  Bodies bodies(both.positions(), both.triangles, shapes::parts_of({&box, &box}), 2, {});
  EXPECT_TRUE(place_bodies(bodies, {.most_motion = 0.15}));
  EXPECT_EQ(bodies.list()[0].is_placed + bodies.list()[1].is_placed, 1);
  EXPECT_EQ(bodies.x(), bodies.rest());
}

TEST(PlaceBodies, what_is_free_does_not_move) {
  const Shape box = shapes::box({1, 1, 1}, 2);
  Shape three = box;
  three.add(box, {0.8, 0.13, 0.07}).add(box, {1.9, 0, 0});
  Bodies bodies(three.positions(), three.triangles, shapes::parts_of({&box, &box, &box}), 3, {});
  EXPECT_FALSE(place_bodies(bodies, {}));
  EXPECT_TRUE(bodies.list()[2].is_at_rest());
  for (const Body& body : bodies.list()) EXPECT_TRUE(bodies.is_free(body));
}

}  // namespace
}  // namespace unsnarl
