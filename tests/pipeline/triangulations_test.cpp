#include "pipeline/triangulations.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

Triangulation cut_of(std::vector<Triangle> triangles, std::vector<Index> polygon) {
  Triangulation cut;
  cut.triangles = std::move(triangles);
  cut.polygon = std::move(polygon);
  return cut;
}

TEST(Cuts, the_same_cut_adds_nothing) {
  const Triangulation cut = cut_of({{0, 1, 2}, {0, 2, 3}}, {0, 0});
  const Triangulation from_other_corners = cut_of({{2, 0, 1}, {3, 0, 2}}, {0, 0});
  const UnitedTriangulations united = unite({cut, cut, Triangulation(), from_other_corners});
  EXPECT_TRUE(united.exclusive.empty());
  EXPECT_EQ(united.all.triangles, cut.triangles);
}

TEST(Cuts, the_other_diagonal_of_a_quad) {
  // A triangle, and a quad beside it that is cut the other way.
  const Triangulation cut = cut_of({{4, 1, 0}, {0, 1, 2}, {0, 2, 3}}, {0, 1, 1});
  const auto [all, of_first, exclusive] = unite({cut, cut_of({{4, 1, 0}, {1, 2, 3}, {1, 3, 0}}, {0, 1, 1})});
  EXPECT_EQ(all.triangles, (std::vector<Triangle>{{4, 1, 0}, {0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(all.polygon, (std::vector<Index>{0, 1, 1, 1, 1}));
  EXPECT_EQ(of_first, 3u);
  ASSERT_EQ(exclusive.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(exclusive[k].a, 1 + static_cast<Index>(k / 2));
    EXPECT_EQ(exclusive[k].b, 3 + static_cast<Index>(k % 2));
  }
}

TEST(Cuts, what_both_cuts_hold_is_no_stranger_to_either) {
  const Triangulation cut = cut_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, {0, 0, 0});
  const auto [all, of_first, exclusive] = unite({cut, cut_of({{0, 1, 2}, {0, 2, 4}, {2, 3, 4}}, {0, 0, 0})});
  EXPECT_EQ(all.triangles.size(), 5u);
  EXPECT_EQ(of_first, 3u);
  ASSERT_EQ(exclusive.size(), 4u);
  for (const IntersectingPair& pair : exclusive) {
    EXPECT_GT(pair.a, 0) << "the triangle that stayed must not meet the new ones";
    EXPECT_GT(pair.b, 2);
  }
}

TEST(Cuts, duplicates_that_the_first_cuts_have_are_not_new) {
  // Polygons 0 and 1 lie on 0 1 2 by the first cut already, 2 comes there by a later one.
  const Triangulation all = cut_of({{0, 1, 2}, {2, 1, 0}, {5, 6, 7}, {0, 1, 2}}, {0, 1, 2, 2});
  EXPECT_TRUE(polygons_on_new_duplicates(all, 3, std::vector<IntersectingPair>{{0, 1, PairClass::duplicate}}).empty());
  const std::vector<IntersectingPair> pairs = {
      {0, 1, PairClass::duplicate}, {0, 3, PairClass::duplicate}, {2, 3, PairClass::folded}};
  EXPECT_EQ(polygons_on_new_duplicates(all, 3, pairs), (std::vector<Index>{0, 2}));
}

}  // namespace
}  // namespace unsnarl
