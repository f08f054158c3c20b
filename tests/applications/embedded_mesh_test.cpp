#include "applications/seifert/embedded_mesh.h"

#include <gtest/gtest.h>

#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

class Random {
 public:
  double operator()(double from, double to) { return from + (to - from) * splitmix_number(++state_ * splitmix_step); }
  Vec3 point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::uint64_t state_ = 0;
};

TEST(AreSeparated, never_says_so_of_triangles_that_meet) {
  Random random;
  int meeting = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 place = random.point(k % 3 == 0 ? 0 : 1000);
    const TrianglePoints wall{place + random.point(1), place + random.point(1), place + random.point(1)};
    // A sliver through a point of the wall, its third corner on the line of the others but for rounding.
    const Vec3 through = 0.4 * wall[0] + 0.3 * wall[1] + 0.3 * wall[2], along = random.point(1);
    const Vec3 from = through - random(0, 1) * along, to = through + random(0, 1) * along;
    const double t = random(-0.5, 1.5);
    const TrianglePoints sliver{from, to, (1 - t) * from + t * to};
    if (triangles_meet(wall, sliver) == Meeting::no) continue;
    ++meeting;
    EXPECT_FALSE(are_separated(wall, sliver, 0)) << k;
    EXPECT_FALSE(are_separated(sliver, wall, 0)) << k;
  }
  EXPECT_GT(meeting, 10000);
}

TEST(AreSeparated, says_so_of_most_that_are_apart) {
  Random random;
  int said = 0;
  for (int k = 0; k < 1000; ++k) {
    const TrianglePoints a{random.point(1), random.point(1), random.point(1)};
    TrianglePoints b{random.point(1), random.point(1), random.point(1)};
    for (Vec3& p : b) p.x() += 4;
    said += are_separated(a, b, 0.5);
  }
  EXPECT_GT(said, 950);
}

/// Two faces around a quad and one that stands over it.
TEST(EmbeddedMesh, a_face_that_folds_flat_onto_its_neighbour_is_refused) {
  SpanningMesh mesh;
  mesh.x = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}};
  mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  EmbeddedMesh embedded(mesh, 4, 1, 0.1);
  EXPECT_FALSE(embedded.move(4, {2, -1, 0}));  // face 0 would turn over, onto its neighbours
  EXPECT_FALSE(embedded.move(4, {2, 0, 0}));   // and lose its area
  EXPECT_TRUE(embedded.move(4, {2, 2, 1}));
}

}  // namespace
}  // namespace unsnarl
