// The order of the work on the frames of a sequence, whatever order jobs end in.
#include "pipeline/frame_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

struct Plan {
  std::size_t frames, first, last, ahead, workers;
};

class FrameScheduleTest : public ::testing::TestWithParam<Plan> {
 protected:
  /// Runs all jobs, so many at once, in a random order; asserts what has to hold at every step. `is_done(t)`: frames
  /// that were repaired before. Returns the frames in the order in which they were handed on.
  template <class IsDone>
  std::vector<std::size_t> run(const Plan& plan, unsigned seed, IsDone&& is_done) {
    FrameSchedule schedule(plan.frames, plan.first, plan.last, plan.ahead);
    std::mt19937 random(seed);
    std::vector<FrameSchedule::Job> running;
    std::set<std::size_t> finished;
    std::vector<std::size_t> handed_on;
    repaired_.clear();
    for (;;) {
      while (schedule.may_open()) schedule.open(is_done(schedule.next_to_open()));
      while (running.size() < plan.workers) {
        const auto job = schedule.begin();
        if (!job) break;
        for (const auto& other : running) EXPECT_NE(other.frame, job->frame) << "two jobs of one frame at once";
        if (job->is_repair) {
          const std::size_t start = schedule.start_of(job->frame);
          EXPECT_TRUE(start == job->frame || repaired_.contains(start));
        }
        for (std::size_t s = FrameSchedule::begin_around(job->frame); s < schedule.end_around(job->frame); ++s) {
          const bool is_there = job->is_repair || !schedule.is_wanted(job->frame) || repaired_.contains(s);
          EXPECT_TRUE(is_there) << "frame " << job->frame << " begins without " << s;
        }
        running.push_back(*job);
      }
      if (running.empty()) {
        EXPECT_TRUE(schedule.is_over()) << "nothing can begin, and nothing runs";
        return handed_on;
      }
      const std::size_t k = random() % running.size();
      const FrameSchedule::Job job = running[k];
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(k));
      schedule.end(job);
      if (job.is_repair) {
        EXPECT_TRUE(repaired_.insert(job.frame).second) << "frame " << job.frame << " is repaired twice";
      } else {
        EXPECT_TRUE(finished.insert(job.frame).second);
      }
      while (const auto t = schedule.hand_on()) {
        EXPECT_TRUE(finished.contains(*t));
        handed_on.push_back(*t);
      }
      EXPECT_LE(schedule.next_to_open(), schedule.handed_on() + plan.ahead) << "too many frames are under way";
    }
  }

  std::set<std::size_t> repaired_;  // frames
};

std::vector<std::size_t> range(std::size_t first, std::size_t last) {
  std::vector<std::size_t> all;
  for (std::size_t t = first; t < last; ++t) all.push_back(t);
  return all;
}

TEST_P(FrameScheduleTest, hands_every_frame_on_in_order) {
  const Plan plan = GetParam();
  const std::size_t last = std::min(plan.last, plan.frames);
  for (unsigned seed = 0; seed < 20; ++seed)
    EXPECT_EQ(run(plan, seed, [](std::size_t) { return false; }), range(plan.first, last)) << seed;
  for (const std::size_t t : repaired_) {
    EXPECT_GE(t, deciding_frames(plan.first, plan.frames).first);
    EXPECT_LT(t, deciding_frames(last - 1, plan.frames).last);
  }
}

TEST_P(FrameScheduleTest, repairs_only_what_frames_not_done_need) {
  const Plan plan = GetParam();
  const std::size_t last = std::min(plan.last, plan.frames);
  const auto is_done = [](std::size_t t) { return t % 64 != 7; };
  for (unsigned seed = 0; seed < 20; ++seed) EXPECT_EQ(run(plan, seed, is_done), range(plan.first, last));
  for (const std::size_t t : repaired_) {
    bool is_needed = false;
    for (std::size_t wanted = plan.first; wanted < last; ++wanted)
      is_needed |= !is_done(wanted) && t >= deciding_frames(wanted, plan.frames).first &&
                   t < deciding_frames(wanted, plan.frames).last;
    EXPECT_TRUE(is_needed) << t;
  }
}

TEST(FrameSchedule, repairs_start_outward_from_key_frames) {
  const FrameSchedule schedule(22, 0, 22, 1);
  for (std::size_t t = 0; t < 22; ++t) {
    std::size_t from = t, steps = 0;
    for (; schedule.start_of(from) != from; from = schedule.start_of(from)) ++steps;
    EXPECT_EQ(from, key_frame_of(t, 22)) << t;
    EXPECT_EQ(from % key_frame_distance, 0u) << t;
    EXPECT_LE(steps, key_frame_distance / 2) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, FrameScheduleTest,
                         testing::Values(Plan{1, 0, 1, 2, 1}, Plan{40, 0, 40, 4, 2}, Plan{40, 10, 30, 2, 3},
                                         Plan{40, 38, 99, 16, 8}, Plan{5, 0, 5, 1, 4}, Plan{90, 3, 90, 24, 3}));

}  // namespace
}  // namespace unsnarl
