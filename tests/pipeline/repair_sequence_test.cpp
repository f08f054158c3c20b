#include "unsnarl/sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "scene/shapes.h"
#include "unsnarl/certify.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

TEST(RepairSequence, progress_is_told_in_the_thread_of_the_caller) {
  const Surface surface = shapes::crossing_bumps(8, 0.3).surface();
  SequenceSource source;
  source.corners = surface.corners;
  source.offsets = surface.offsets;
  source.frames = 12;
  source.positions = [&](std::size_t) { return surface.positions; };
  const std::thread::id here = std::this_thread::get_id();
  std::vector<double> told;
  Context context;
  context.on_progress = [&](const Context::Progress& progress) {
    EXPECT_EQ(std::this_thread::get_id(), here);
    EXPECT_EQ(progress.phase, "frames");
    told.push_back(progress.fraction);
  };
  std::size_t taken = 0;
  const auto reports = repair_sequence(
      source, {}, [&](FrameResult&&) { ++taken; }, &context);
  EXPECT_EQ(taken, 12u);
  EXPECT_EQ(reports.size(), 12u);
  ASSERT_EQ(told.size(), 12u);
  EXPECT_EQ(told.back(), 1);
  EXPECT_TRUE(context.on_progress) << "the caller's";
}

/// Two tubes that are pushed through each other farther and farther, frame by frame, around more than one key frame.
std::vector<Surface> tubes_in_motion() {
  std::vector<Surface> frames;
  for (std::size_t t = 0; t < key_frame_distance + 4; ++t)
    frames.push_back(
        make_sample("crossing_tubes", 20, {{"radius", 0.3}, {"offset", 0.56 - 0.005 * static_cast<double>(t)}}));
  return frames;
}

std::vector<FrameResult> repaired(const std::vector<Surface>& frames, int threads) {
  SequenceSource source;
  source.corners = frames[0].corners;
  source.offsets = frames[0].offsets;
  source.frames = frames.size();
  source.positions = [&](std::size_t t) { return frames[t].positions; };
  SequenceOptions options;
  options.repair.find.threads = threads;
  std::vector<FrameResult> results;
  repair_sequence(source, options, [&](FrameResult&& result) { results.push_back(std::move(result)); });
  return results;
}

TEST(RepairSequence, frames_that_start_from_others_are_embedded_by_the_same_bytes_on_any_threads) {
  const std::vector<Surface> frames = tubes_in_motion();
  const std::vector<FrameResult> results = repaired(frames, 1);
  ASSERT_EQ(results.size(), frames.size());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    EXPECT_GT(results[t].report.before.total(), 0u) << t;
    EXPECT_EQ(results[t].report.status, Status::embedded) << t;
    EXPECT_TRUE(certify(frames[t], results[t].positions).embedded()) << t;
  }
  for (const int threads : {2, 4}) {
    const std::vector<FrameResult> others = repaired(frames, threads);
    ASSERT_EQ(others.size(), frames.size());
    for (std::size_t t = 0; t < frames.size(); ++t) EXPECT_EQ(others[t].positions, results[t].positions) << t;
  }
}

// The surface hardly turns, so that corrections are compared as they are.
TEST(RepairSequence, no_correction_jumps) {
  const std::vector<Surface> frames = tubes_in_motion();
  const std::vector<FrameResult> results = repaired(frames, 1);
  const auto jump = [&](std::size_t t) {
    double most = 0;
    for (std::size_t k = 0; k < frames[t].positions.size(); ++k) {
      const double here = results[t].positions[k] - frames[t].positions[k];
      most = std::max(most, std::abs(here - (results[t - 1].positions[k] - frames[t - 1].positions[k])));
    }
    return most / results[t].report.diagonal;
  };
  for (std::size_t t = 1; t < frames.size(); ++t) EXPECT_LT(jump(t), 0.005) << t;
}

TEST(RepairSequence, what_stands_still_is_repaired_alike) {
  const std::vector<Surface> frames(6, tubes_in_motion().back());
  const std::vector<FrameResult> results = repaired(frames, 1);
  ASSERT_EQ(results.size(), frames.size());
  EXPECT_GT(results[0].report.before.total(), 0u);
  for (const FrameResult& result : results)
    for (std::size_t k = 0; k < result.positions.size(); ++k)
      EXPECT_NEAR(result.positions[k], results[0].positions[k], 1e-5 * result.report.diagonal);
}

}  // namespace
}  // namespace unsnarl
