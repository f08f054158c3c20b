#include "scene/patch_progress.h"

#include <gtest/gtest.h>

namespace unsnarl {
namespace {

TEST(PatchProgress, pairs_that_are_gone_are_work_done) {
  PatchProgress progress;
  progress.begin(40);
  EXPECT_EQ(progress.pairs, 40u);
  EXPECT_EQ(progress.done, 0);
  progress.set_pairs(10);
  EXPECT_EQ(progress.pairs, 10u);
  EXPECT_DOUBLE_EQ(progress.done, 0.75);
  progress.set_pairs(60);  // more than there were: a candidate on its way
  EXPECT_EQ(progress.pairs, 60u);
  EXPECT_EQ(progress.done, 0);
}

TEST(PatchProgress, without_pairs_nothing_is_done) {
  PatchProgress progress;
  progress.begin(0);
  EXPECT_EQ(progress.done, 0);
}

class Reporter : public testing::Test {
 protected:
  int reports = 0;
  const std::function<void()> report = [this] { ++reports; };
  const std::function<bool()> never = [] { return false; };

  static void ask_for(ProgressReporter& reporter, std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) EXPECT_FALSE(reporter.asked());
  }
};

TEST_F(Reporter, reports_now_and_then) {
  ProgressReporter reporter(report, never);
  ask_for(reporter, std::chrono::milliseconds(700));
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 3) << "one each 200 ms at most";
}

TEST_F(Reporter, reports_from_its_own_thread_alone) {
  ProgressReporter reporter(report, never);
  std::thread([&] { ask_for(reporter, std::chrono::milliseconds(300)); }).join();
  EXPECT_EQ(reports, 0);
  reporter.asked();
  EXPECT_EQ(reports, 1);
}

TEST_F(Reporter, says_whether_to_stop) {
  const std::function<bool()> always = [] { return true; }, nothing;
  EXPECT_TRUE(ProgressReporter({}, always).asked());
  EXPECT_FALSE(ProgressReporter({}, nothing).asked());
}

}  // namespace
}  // namespace unsnarl
