#include "scene/patch_progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

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

TEST_F(Reporter, reports_from_whatever_thread_asks) {
  ProgressReporter reporter(report, never);
  std::thread([&] { ask_for(reporter, std::chrono::milliseconds(500)); }).join();
  EXPECT_GE(reports, 1) << "the thread that made it asks nothing";
  EXPECT_LE(reports, 2);
}

TEST_F(Reporter, gives_one_report_at_a_time) {
  std::atomic<int> at_once = 0, most = 0;
  const std::function<void()> slow = [&] {
    most = std::max(most.load(), ++at_once);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    --at_once;
    ++reports;
  };
  ProgressReporter reporter(slow, never);
  std::thread other([&] { ask_for(reporter, std::chrono::milliseconds(700)); });
  ask_for(reporter, std::chrono::milliseconds(700));
  other.join();
  EXPECT_EQ(most, 1);
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 3);
}

TEST_F(Reporter, says_whether_to_stop) {
  const std::function<bool()> always = [] { return true; }, nothing;
  EXPECT_TRUE(ProgressReporter({}, always).asked());
  EXPECT_FALSE(ProgressReporter({}, nothing).asked());
}

}  // namespace
}  // namespace unsnarl
