#include "untangle/attempt_log.h"

#include <gtest/gtest.h>

#include "untangle/strategies.h"

namespace unsnarl {
namespace {

TEST(AttemptLog, keeps_the_furthest_strategy_of_each_vertex) {
  AttemptLog log(Positions::Zero(3, 4));
  log.note_tried(std::vector<Index>{0, 1}, strategy_name(2));
  log.note_tried(std::vector<Index>{1, 2}, strategy_name(1));
  EXPECT_EQ(log.strategy, (std::vector<std::int8_t>{2, 2, 1, -1}));
  log.note_tried(std::vector<Index>{3}, "of no table");
  EXPECT_EQ(log.strategy[3], -1);
}

TEST(AttemptLog, notes_what_went_too_far_and_what_a_limit_cut_short) {
  AttemptLog log(Positions::Zero(3, 6));
  log.note_too_far(std::vector<Index>{5});
  EXPECT_EQ(log.is_too_far, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1}));
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}};
  log.note_cut_short(std::vector<IntersectingPair>{{0, 2, PairClass::one_vertex}}, triangles);
  EXPECT_EQ(log.is_cut_short, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace unsnarl
