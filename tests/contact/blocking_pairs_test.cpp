#include "contact/blocking_pairs.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(BlockingPairs, compare_faces_not_classes) {
  const std::vector<IntersectingPair> tolerated = {{1, 5, PairClass::disjoint}, {2, 3, PairClass::folded}};
  const std::vector<IntersectingPair> pairs = {{1, 4, PairClass::disjoint},
                                               {1, 5, PairClass::degenerate},
                                               {2, 3, PairClass::folded},
                                               {2, 5, PairClass::disjoint}};
  const std::vector<IntersectingPair> expected = {{1, 4, PairClass::disjoint}, {2, 5, PairClass::disjoint}};
  EXPECT_TRUE(blocking_pairs(pairs, tolerated) == expected);
  EXPECT_TRUE(blocking_pairs(pairs, {}) == pairs);
  EXPECT_TRUE(blocking_pairs({}, tolerated).empty());
}

}  // namespace
}  // namespace unsnarl
