#include "applications/seifert/embedded_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

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

/// Triangles between two rings of three vertices each, all around.
void add_strip(SpanningMesh& mesh, Index lower, Index upper) {
  for (Index k = 0; k < 3; ++k) {
    const Index next = (k + 1) % 3;
    mesh.faces.push_back({lower + k, lower + next, upper + k});
    mesh.faces.push_back({lower + next, upper + next, upper + k});
  }
}

void add_ring(SpanningMesh& mesh, double radius, double height) {
  const double half = std::sqrt(0.75);
  mesh.x.insert(mesh.x.end(), {Vec3(radius, 0, height), Vec3(-radius / 2, radius * half, height),
                               Vec3(-radius / 2, -radius * half, height)});
}

TEST(EmbeddedMesh, a_needle_is_cut_off_at_its_foot) {
  SpanningMesh mesh;
  add_ring(mesh, 10, 0);
  for (int k = 0; k < 3; ++k) add_ring(mesh, 0.5, 2 * k);
  for (Index ring = 0; ring < 3; ++ring) add_strip(mesh, 3 * ring, 3 * ring + 3);
  mesh.x.push_back(Vec3(0, 0, 6));
  for (Index k = 0; k < 3; ++k) mesh.faces.push_back({9 + k, 9 + (k + 1) % 3, 12});
  EmbeddedMesh needle(mesh, 3, 1, 0.1);
  EXPECT_FALSE(needle.cut_off({0, 1}));   // at the end of the surface
  EXPECT_FALSE(needle.cut_off({9, 12}));  // no third edge closes a way around
  ASSERT_TRUE(needle.cut_off({3, 4}));
  const SpanningMesh flat = needle.compact();
  EXPECT_EQ(flat.x.size(), 6U);
  ASSERT_EQ(flat.faces.size(), 7U);
  for (const Triangle& t : flat.faces)  // all look the same way
    EXPECT_GT((flat.x[t[1]] - flat.x[t[0]]).cross(flat.x[t[2]] - flat.x[t[0]]).z(), 0);
}

TEST(EmbeddedMesh, a_tube_is_not_cut) {
  SpanningMesh mesh;
  for (const double height : {0.0, 4.0, 2.0}) add_ring(mesh, 0.5, height);  // both ends, then the middle
  add_strip(mesh, 0, 6);
  add_strip(mesh, 6, 3);
  EmbeddedMesh tube(mesh, 6, 1, 0.1);
  EXPECT_FALSE(tube.cut_off({6, 7}));
  EXPECT_EQ(tube.compact().faces.size(), 12U);
}

}  // namespace
}  // namespace unsnarl
