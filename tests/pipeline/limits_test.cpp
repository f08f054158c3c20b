// Limits of time, memory and displacement: what was reached is kept, nothing is worse than the input, the status is
// true.
#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <string>
#include <thread>

#include "pipeline/judged.h"
#include "scene/shapes.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

using shapes::Shape;

void expect_true_and_not_worse(const Surface& surface, const RepairResult& result) {
  const std::size_t left = judged(surface, result.positions).size();
  EXPECT_EQ(result.report.after.total(), left);
  EXPECT_LE(left, judged(surface, surface.positions).size());
  // Where memory ran out a result is not the one that it would be, embedded or not.
  if (result.status == Status::memory_limit) return;
  EXPECT_EQ(result.status == Status::embedded, left == 0) << to_string(result.status);
}

class InPhase : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Limits, InPhase, testing::Values("untangle", "recover", "certify"),
                         [](const auto& info) { return info.param; });

/// Runs until `phase` and there waits for the limit, or gives up.
RepairResult repair_until(const std::string& phase, const Surface& surface, RepairOptions options, bool out_of_memory) {
  Context context;
  const auto begin = std::chrono::steady_clock::now();
  context.on_progress = [&](const Context::Progress& progress) {
    if (progress.phase != phase) return;
    if (out_of_memory) throw std::bad_alloc();
    std::this_thread::sleep_until(begin + std::chrono::duration<double>(options.time_limit_s + 0.01));
  };
  return repair(surface, options, &context);
}

TEST_P(InPhase, the_time_limit_ends_the_work) {
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  RepairOptions options;
  options.time_limit_s = 0.3;
  const RepairResult result = repair_until(GetParam(), surface, options, false);
  EXPECT_TRUE(result.status == Status::time_limit || result.status == Status::embedded) << to_string(result.status);
  expect_true_and_not_worse(surface, result);
  if (GetParam() == "untangle") {
    EXPECT_EQ(result.status, Status::time_limit);
  }
}

TEST_P(InPhase, memory_that_runs_out_loses_nothing) {
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  const RepairResult result = repair_until(GetParam(), surface, {}, true);
  EXPECT_TRUE(result.status == Status::memory_limit || result.status == Status::embedded) << to_string(result.status);
  expect_true_and_not_worse(surface, result);
}

TEST(Limits, time_that_is_over_before_the_work_begins) {
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  RepairOptions options;
  options.time_limit_s = 1e-9;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::time_limit);
  EXPECT_TRUE(result.positions == surface.positions);
  expect_true_and_not_worse(surface, result);
}

TEST(Limits, no_vertex_moves_farther_than_allowed) {
  const Surface surface = shapes::crossing_bumps(10, 0.4).surface();
  const double needed = repair(surface).report.displacement_max_rel;
  for (const double share : {1e-3, 0.3, 0.7, 0.9, 1.5}) {
    SCOPED_TRACE(share);
    RepairOptions options;
    options.max_displacement_rel = share * needed;
    const RepairResult result = repair(surface, options);
    EXPECT_LE(result.report.displacement_max_rel, options.max_displacement_rel);
    EXPECT_TRUE(result.status == Status::embedded || result.status == Status::displacement_exceeded);
    expect_true_and_not_worse(surface, result);
    if (share > 1) {
      EXPECT_EQ(result.status, Status::embedded);
    }
    if (share < 0.1) {
      EXPECT_EQ(result.status, Status::displacement_exceeded);
    }
  }
}

TEST(Limits, what_needs_no_more_than_the_allowed_displacement_is_repaired) {
  Shape shape = shapes::crossing_bumps(10, 0.1);
  const std::size_t shallow = shape.points.size();
  shape.add(shapes::crossing_bumps(10, 1.2), {30, 0, 0});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.max_displacement_rel = 0.2 / repair(surface).report.diagonal;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::displacement_exceeded) << to_string(result.status);
  EXPECT_LE(result.report.displacement_max_rel, options.max_displacement_rel);
  expect_true_and_not_worse(surface, result);
  Surface first = surface;
  first.corners.resize(surface.corners.size() / 2);
  EXPECT_EQ(judged(first, result.positions).size(), 0u) << "the shallow crossing could be resolved";
  EXPECT_TRUE(std::equal(surface.positions.begin() + static_cast<std::ptrdiff_t>(3 * shallow), surface.positions.end(),
                         result.positions.begin() + static_cast<std::ptrdiff_t>(3 * shallow)));
}

}  // namespace
}  // namespace unsnarl
