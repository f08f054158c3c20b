#include "rigid/recover_bodies.h"

#include <gtest/gtest.h>

#include "contact/smallest_gap.h"
#include "geometry/rotation.h"
#include "rigid/boxes.h"
#include "rigid/place_bodies.h"

namespace unsnarl {
namespace {

using shapes::Shape;

std::vector<Index> bodies_of_triangles(const Bodies& bodies) {
  std::vector<Index> owners;
  for (Index t = 0; t < static_cast<Index>(bodies.triangles().size()); ++t)
    owners.push_back(bodies.owner_of_triangle(t));
  return owners;
}

double sum_of_squares(const Bodies& bodies) {
  return (bodies.x() - bodies.rest()).squaredNorm();
}

TEST(RecoverBodies, two_boxes_share_the_least_motion) {
  const Shape box = shapes::box({1, 1, 1}, 4);
  Shape both = box;
  both.add(box, {0.9, 0, 0});  // face to face, 0.1 deep
  both.points[0][2] += 1e-9;   // not exactly
  Bodies bodies(both.positions(), both.triangles, shapes::parts_of({&box, &box}), 2, {});
  place_bodies(bodies, {});
  const double placed = sum_of_squares(bodies);
  recover_bodies(bodies, {.min_gap = 1e-6});
  for (const Body& body : bodies.list()) {
    EXPECT_TRUE(bodies.is_free(body));
    EXPECT_NEAR(bodies.largest_displacement(body), 0.05, 0.002);
  }
  // Half of what one alone has to move.
  EXPECT_LT(sum_of_squares(bodies), 0.55 * placed);
}

TEST(RecoverBodies, a_body_goes_all_the_way_back_where_nothing_is) {
  const Shape box = shapes::box({1, 1, 1}, 2);
  Shape both = box;
  both.add(box, {3, 0, 0});
  Bodies bodies(both.positions(), both.triangles, shapes::parts_of({&box, &box}), 2, {});
  Body& body = bodies.list()[0];
  body.centre += Vec3(0, 0.4, 0.2);
  body.rotation = rotation_by({0.1, 0.2, 0.3});
  bodies.move(body);
  bodies.settle(body);
  const double far = bodies.largest_displacement(body);
  recover_bodies(bodies, {});
  EXPECT_LT(bodies.largest_displacement(body), 1e-3 * far);
  EXPECT_TRUE(bodies.list()[1].is_at_rest());
}

TEST(RecoverBodies, keeps_the_gap_that_is_asked_for) {
  const Shape large = shapes::box({2, 2, 2}, 3), small = shapes::box({1, 1, 1}, 3);
  for (const double gap : {0.0, 0.03, 0.2}) {
    Shape both = large;
    both.add(small, {1.4, 0.13, 0.07});
    std::vector<Index> body_of(large.points.size(), -1);
    std::vector<std::uint8_t> fixed(large.points.size(), 1);
    body_of.insert(body_of.end(), small.points.size(), 0);
    fixed.insert(fixed.end(), small.points.size(), 0);
    Bodies bodies(both.positions(), both.triangles, body_of, 1, fixed);
    place_bodies(bodies, {});
    recover_bodies(bodies, {.min_gap = gap});
    const Body& body = bodies.list()[0];
    EXPECT_TRUE(bodies.is_free(body));
    double nearest = 1e9;  // of the small box from the face x = 1 of the large one
    for (Index v : body.vertices) nearest = std::min(nearest, bodies.x()(0, v) - 1);
    EXPECT_GT(nearest, gap);
    EXPECT_LT(nearest, gap + 0.002);
  }
}

TEST(RecoverBodies, opens_gaps_at_rest_where_that_is_asked_for) {
  const Shape box = shapes::box({1, 1, 1}, 2);
  Shape three = box;
  three.add(box, {1.001, 0.13, 0.07}).add(box, {2.003, -0.06, 0.1});
  Bodies bodies(three.positions(), three.triangles, shapes::parts_of({&box, &box, &box}), 3, {});
  recover_bodies(bodies, {.min_gap = 0.05});
  for (const Body& body : bodies.list()) EXPECT_TRUE(body.is_at_rest());
  recover_bodies(bodies, {.min_gap = 0.05, .opens_gaps_at_rest = true});
  EXPECT_GE(smallest_gap(three.triangles, bodies.x(), bodies_of_triangles(bodies)).distance, 0.05);
  for (const Body& body : bodies.list()) EXPECT_LT(bodies.largest_displacement(body), 0.06);
}

TEST(RecoverBodies, what_is_near_at_rest_is_not_pushed) {
  const Shape box = shapes::box({1, 1, 1}, 2);
  Shape three = box;
  three.add(box, {0.9, 0.13, 0.07}).add(box, {-0.2, 1.01, 0.05});  // the third is 0.01 from the first
  Bodies bodies(three.positions(), three.triangles, shapes::parts_of({&box, &box, &box}), 3, {});
  bodies.list()[1].centre += Vec3(0.3, 0, 0);
  bodies.move(bodies.list()[1]);
  bodies.settle(bodies.list()[1]);
  recover_bodies(bodies, {.min_gap = 0.005});
  EXPECT_LT(bodies.largest_displacement(bodies.list()[2]), 0.02);
  for (const Body& body : bodies.list()) EXPECT_TRUE(bodies.is_free(body));
}

}  // namespace
}  // namespace unsnarl
