#include "run/run_control.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace unsnarl {
namespace {

TEST(RunControl, ends_where_it_is_cancelled) {
  Context context;
  RunControl control(&context, {});
  EXPECT_FALSE(control.stopped());
  EXPECT_EQ(control.status_or(Status::reduced), Status::reduced);
  context.cancel();
  EXPECT_TRUE(control.stopped());
  EXPECT_EQ(control.status_or(Status::reduced), Status::cancelled);
}

TEST(RunControl, ends_at_its_limits) {
  RunControl timed(nullptr, {.time_s = 1e-3});
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_TRUE(timed.stopped());
  EXPECT_EQ(timed.status_or(Status::embedded), Status::time_limit);
  EXPECT_GE(timed.seconds(), 1e-3);
  RunControl small(nullptr, {.memory_mb = 1e-3});
  EXPECT_TRUE(small.stopped());
  EXPECT_EQ(small.status_or(Status::embedded), Status::memory_limit);
}

TEST(RunControl, says_the_first_reason_for_good) {
  Context context;
  RunControl control(&context, {.memory_mb = 1e-3});
  EXPECT_TRUE(control.stopped());
  context.cancel();
  EXPECT_TRUE(control.stopped());
  EXPECT_EQ(control.status_or(Status::embedded), Status::memory_limit);
}

TEST(RunControl, tells_of_progress_that_never_decreases) {
  Context context;
  std::vector<double> fractions;
  context.on_progress = [&](const Context::Progress& progress) { fractions.push_back(progress.fraction); };
  RunControl control(&context, {});
  for (const double fraction : {0.1, 0.5, 0.3}) control.tell(fraction, "work");
  EXPECT_EQ(fractions, (std::vector<double>{0.1, 0.5, 0.5}));
  RunControl(nullptr, {}).tell(0.5, "unheard");
}

}  // namespace
}  // namespace unsnarl
