#include "contact/near_along_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::grid;
using shapes::Shape;

/// A strip in the form of a U along x: legs of length 1 at z = 0 and z = 0.1, joined at x = 1. n cells a leg.
Shape channel(Index n) {
  return grid(2 * n + 1, 1, false, [=](double i, double j) {
    return i <= n ? Vec3(i / n, 0.05 * j, 0) : Vec3((2 * n + 1 - i) / n, 0.05 * j, 0.1);
  });
}

/// Whether faces above each other at x are joined within a ball between them.
bool joins(const Shape& shape, Index n, double x, double radius) {
  const Positions rest = shape.positions();
  const EdgeTable edges = build_edges(shape.triangles);
  NearAlongSurface ways(shape.triangles, rest, edges);
  const auto cell = std::min(n - 1, static_cast<Index>(x * n));
  ways.start(2 * cell);
  return ways.joins(2 * (2 * n - cell), Vec3(x, 0.025, 0.05), radius);
}

TEST(NearAlongSurface, is_what_a_ball_holds_a_way_to_however_the_surface_is_cut) {
  for (const Index n : {2, 7, 40, 300}) {
    const Shape shape = channel(n);
    for (const double x : {0.1, 0.5, 0.9}) {
      EXPECT_TRUE(joins(shape, n, x, 1.08 * (1 - x) + 0.05)) << n << " " << x;
      EXPECT_FALSE(joins(shape, n, x, 0.98 * (1 - x))) << n << " " << x;
    }
  }
}

TEST(NearAlongSurface, of_two_pieces_nothing_is) {
  Shape shape = channel(4);
  const auto count = static_cast<Index>(shape.triangles.size());
  shape.add(channel(4), {0, 0, 0.01});
  const Positions rest = shape.positions();
  const EdgeTable edges = build_edges(shape.triangles);
  NearAlongSurface ways(shape.triangles, rest, edges);
  ways.start(0);
  EXPECT_FALSE(ways.joins(count, Vec3::Zero(), 100));
  EXPECT_TRUE(ways.joins(count - 1, Vec3::Zero(), 100));
  ways.start(count);
  EXPECT_TRUE(ways.joins(count + 1, Vec3::Zero(), 0.2));
  EXPECT_FALSE(ways.joins(0, Vec3::Zero(), 100));
}

}  // namespace
}  // namespace unsnarl
