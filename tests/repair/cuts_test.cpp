#include "repair/cuts.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

Triangulation cut_of(std::vector<Triangle> triangles, std::vector<Index> polygon) {
  Triangulation cut;
  cut.triangles = std::move(triangles);
  cut.polygon = std::move(polygon);
  return cut;
}

TEST(Cuts, TheSameCutAddsNothing) {
  Triangulation all = cut_of({{0, 1, 2}, {0, 2, 3}}, {0, 0});
  EXPECT_TRUE(add_cut(all, all).empty());
  EXPECT_TRUE(add_cut(all, cut_of({{2, 0, 1}, {3, 0, 2}}, {0, 0})).empty()) << "from other corners";
  EXPECT_EQ(all.triangles.size(), 2u);
}

TEST(Cuts, TheOtherDiagonalOfAQuad) {
  // A triangle, and a quad beside it that is cut the other way.
  Triangulation all = cut_of({{4, 1, 0}, {0, 1, 2}, {0, 2, 3}}, {0, 1, 1});
  const auto strangers = add_cut(all, cut_of({{4, 1, 0}, {1, 2, 3}, {1, 3, 0}}, {0, 1, 1}));
  EXPECT_EQ(all.triangles, (std::vector<Triangle>{{4, 1, 0}, {0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(all.polygon, (std::vector<Index>{0, 1, 1, 1, 1}));
  ASSERT_EQ(strangers.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(strangers[k].a, 1 + static_cast<Index>(k / 2));
    EXPECT_EQ(strangers[k].b, 3 + static_cast<Index>(k % 2));
  }
}

TEST(Cuts, WhatBothCutsHoldIsNoStrangerToEither) {
  Triangulation all = cut_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, {0, 0, 0});
  const auto strangers = add_cut(all, cut_of({{0, 1, 2}, {0, 2, 4}, {2, 3, 4}}, {0, 0, 0}));
  EXPECT_EQ(all.triangles.size(), 5u);
  ASSERT_EQ(strangers.size(), 4u);
  for (const IntersectingPair& pair : strangers) {
    EXPECT_GT(pair.a, 0) << "the triangle that stayed must not meet the new ones";
    EXPECT_GT(pair.b, 2);
  }
}

}  // namespace
}  // namespace unsnarl
