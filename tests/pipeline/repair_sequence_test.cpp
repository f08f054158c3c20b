#include "unsnarl/sequence.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "scene/shapes.h"

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

}  // namespace
}  // namespace unsnarl
