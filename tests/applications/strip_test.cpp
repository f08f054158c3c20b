#include "applications/knots/strip.h"

#include <gtest/gtest.h>

#include <set>

#include "applications/knots/knot_path.h"

namespace unsnarl {
namespace {

/// Every edge of either polygon is on one triangle, and triangles that follow each other have two corners in common.
void expect_annulus(const std::vector<StripTriangle>& strip, Index lower, Index upper) {
  ASSERT_EQ(strip.size(), static_cast<std::size_t>(lower + upper));
  std::set<Index> below, above;
  const auto corners = [&](const StripTriangle& t) {
    return t.on_lower ? std::set<Index>{t.edge, (t.edge + 1) % lower, lower + t.apex}
                      : std::set<Index>{lower + t.edge, lower + (t.edge + 1) % upper, t.apex};
  };
  for (std::size_t k = 0; k < strip.size(); ++k) {
    EXPECT_TRUE((strip[k].on_lower ? below : above).insert(strip[k].edge).second);
    const std::set<Index> here = corners(strip[k]), next = corners(strip[(k + 1) % strip.size()]);
    EXPECT_EQ(std::count_if(here.begin(), here.end(), [&](Index v) { return next.count(v) > 0; }), 2);
  }
  EXPECT_EQ(below.size(), static_cast<std::size_t>(lower));
  EXPECT_EQ(above.size(), static_cast<std::size_t>(upper));
}

TEST(Strip, is_an_annulus) {
  expect_annulus(straight_strip(7), 7, 7);
  const std::vector<Index> pieces{1, 4, 2, 3};
  expect_annulus(strip_to_finer(pieces), 4, 10);
  for (const Index first : {0, 3, 9}) expect_annulus(strip_from_finer(pieces, first), 10, 4);
}

TEST(Strip, a_knot_and_its_finer_self_are_isotopic) {
  const Positions knot = points_of(knot_of_table("4_1").components[0]);
  const DensePolygon dense = densified(knot, 150);
  EXPECT_TRUE(meeting_pairs(knot, dense.points, strip_to_finer(dense.pieces), 1).empty());
  EXPECT_TRUE(meeting_pairs(dense.points, knot, strip_from_finer(dense.pieces), 1).empty());
  // With the points of the finer one turned by some, the way winds around and through.
  EXPECT_FALSE(meeting_pairs(dense.points, knot, strip_from_finer(dense.pieces, 75), 1).empty());
  Positions bad = knot;
  bad.col(3) = bad.col(4);  // an edge without length
  EXPECT_FALSE(meeting_pairs(bad, bad, straight_strip(static_cast<Index>(bad.cols())), 1).empty());
}

}  // namespace
}  // namespace unsnarl
