#include "contact/intersection_segments.h"

#include <gtest/gtest.h>

#include "contact/intersection_finder.h"

namespace unsnarl {
namespace {

struct Case {
  Positions x;
  std::vector<Triangle> triangles;

  std::vector<std::array<Vec3, 2>> segments() const {
    const std::vector<IntersectingPair> pairs = IntersectionFinder(triangles).find(x);
    EXPECT_EQ(pairs.size(), 1u);
    return intersection_segments(x, triangles, pairs);
  }
};

Positions points(const std::vector<Vec3>& list) {
  Positions x(3, static_cast<Index>(list.size()));
  for (std::size_t v = 0; v < list.size(); ++v) x.col(static_cast<Index>(v)) = list[v];
  return x;
}

void expect_segment(const std::vector<std::array<Vec3, 2>>& segments, Vec3 p, Vec3 q) {
  ASSERT_EQ(segments.size(), 1u);
  auto [a, b] = segments[0];
  if ((a - p).norm() > (b - p).norm()) std::swap(a, b);
  EXPECT_LT((a - p).norm(), 1e-14);
  EXPECT_LT((b - q).norm(), 1e-14);
}

TEST(IntersectionSegments, a_triangle_through_another) {
  const Case both = {points({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 9, 0}}),
                     {{0, 1, 2}, {3, 4, 5}}};
  expect_segment(both.segments(), {1, 1, 0}, {1, 3, 0});
}

TEST(IntersectionSegments, one_wholly_inside_the_other) {
  const Case inside = {points({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}}),
                       {{0, 1, 2}, {3, 4, 5}}};
  expect_segment(inside.segments(), {1, 1, 0}, {1.5, 1, 0});
}

TEST(IntersectionSegments, begin_at_the_common_vertex) {
  const Case fan = {points({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}}), {{0, 1, 2}, {0, 3, 4}}};
  expect_segment(fan.segments(), {0, 0, 0}, {1, 1, 0});
}

TEST(IntersectionSegments, touching_in_a_point_and_flat_overlap_have_none) {
  const Case touching = {points({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}}),
                         {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_TRUE(touching.segments().empty());
  const Case flat = {points({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}}),
                     {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_TRUE(flat.segments().empty());
}

}  // namespace
}  // namespace unsnarl
