#include "run/limits.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(Limits, what_ends_at_a_share_of_the_time_leaves_the_rest) {
  const Context context;
  Limits limits(RunLimits{.time_s = 1e9}, context);
  EXPECT_FALSE(limits.stopper_at(1)());
  EXPECT_EQ(limits.status_or(Status::reduced), Status::reduced);
  EXPECT_TRUE(limits.stopper_at(-1)());  // it has passed
  EXPECT_FALSE(limits.reached());
  EXPECT_EQ(limits.status_or(Status::reduced), Status::time_limit);
  EXPECT_EQ(limits.status_of_result(Status::embedded), Status::embedded);
}

TEST(Limits, without_a_limit_no_share_of_it_passes) {
  const Context context;
  Limits limits(RunLimits{}, context);
  EXPECT_FALSE(limits.stopper_at(-1)());
  EXPECT_EQ(limits.status_or(Status::reduced), Status::reduced);
}

}  // namespace
}  // namespace unsnarl
