#include "contact/passing.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace unsnarl {
namespace {

TEST(Passing, parts_pass_either_way_round_and_through_themselves_only_if_said) {
  const PassingParts parts(3, std::vector<std::array<Index, 2>>{{2, 0}, {1, 1}});
  for (const auto [p, q] : {std::array<Index, 2>{0, 2}, {2, 0}, {1, 1}}) EXPECT_TRUE(parts.pass(p, q)) << p << q;
  for (const auto [p, q] : {std::array<Index, 2>{0, 0}, {2, 2}, {0, 1}, {1, 0}, {1, 2}, {2, 1}})
    EXPECT_FALSE(parts.pass(p, q)) << p << q;
}

TEST(Passing, what_meets_and_what_passes_are_all_pairs_of_a_group) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const std::vector<Index> group_of = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1}, part_of = {0, 1, 2, 2};
  const PassingParts parts(3, std::vector<std::array<Index, 2>>{{0, 2}, {1, 1}});
  const Passing passing(group_of, part_of, parts), inverse = passing.only_what_passes();
  for (Index t = 0; t < 4; ++t)
    for (Index u = 0; u < 4; ++u) {
      const bool are_of_one = (t == 3) == (u == 3);
      EXPECT_EQ(passing.meet(triangles, t, u), are_of_one && !parts.pass(part_of[t], part_of[u])) << t << u;
      EXPECT_EQ(inverse.meet(triangles, t, u), are_of_one && parts.pass(part_of[t], part_of[u])) << t << u;
    }
  EXPECT_TRUE(Passing().meet(triangles, 0, 3));
  EXPECT_FALSE(Passing(group_of).meet(triangles, 0, 3));
}

}  // namespace
}  // namespace unsnarl
