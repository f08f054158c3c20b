// History and frames of whole repairs, and the file they go to.
#include "unsnarl/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/shapes.h"
#include "scene/trajectory.h"
#include "unsnarl/repair.h"
#include "unsnarl/report_json.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

// Four places in conflict, two of them near each other.
Surface several_conflicts() {
  Shape shape;
  for (int k = 0; k < 4; ++k) shape.add(shapes::crossing_bumps(9, 0.2 + 0.1 * k), {9.5 * k, 0.3 * k, 0});
  return shape.surface();
}

RepairResult recorded(const Surface& surface, int frames, int threads = 0) {
  RepairOptions options;
  options.record.history = true;
  options.record.frames = frames;
  options.find.threads = threads;
  return repair(surface, options);
}

// Positions of the input plus all displacements until and with this frame.
std::vector<double> positions_at(const Surface& surface, std::span<const RecordedFrame> frames, std::size_t frame) {
  std::vector<double> positions = surface.positions;
  for (std::size_t f = 0; f <= frame; ++f)
    for (std::size_t i = 0; i < frames[f].vertices.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = 3 * static_cast<std::size_t>(frames[f].vertices[i]) + k;
        positions[at] = surface.positions[at] + frames[f].displacements[3 * i + k];
      }
  return positions;
}

TEST(Recording, does_not_change_the_result) {
  for (const Surface& surface : {several_conflicts(), make_sample("folded_sheet", 24)}) {
    const RepairResult plain = repair(surface), with = recorded(surface, 20);
    EXPECT_TRUE(plain.positions == with.positions);
    EXPECT_TRUE(plain.report.history.empty());
    EXPECT_TRUE(plain.frames.empty());
    EXPECT_FALSE(with.report.history.empty());
    EXPECT_FALSE(with.frames.empty());
  }
}

TEST(Recording, is_the_same_at_any_number_of_threads) {
  const Surface surface = several_conflicts();
  const RepairResult one = recorded(surface, 40, 1);
  ASSERT_GE(one.report.history.size(), 4u);
  const std::string expected = recording_json(one, surface);
  for (const int threads : {2, 4}) EXPECT_EQ(recording_json(recorded(surface, 40, threads), surface), expected);
}

TEST(Recording, frames_lead_from_the_input_to_the_result) {
  const Surface surface = several_conflicts();
  const RepairResult result = recorded(surface, 1000);
  const std::vector<RecordedFrame>& frames = result.frames;
  ASSERT_GT(frames.size(), 5u);
  EXPECT_EQ(frames.front().phase, "input");
  EXPECT_TRUE(frames.front().vertices.empty());
  EXPECT_EQ(frames.front().pairs, result.report.before.total());
  EXPECT_EQ(frames.back().phase, "result");
  EXPECT_EQ(frames.back().pairs, 0u);
  std::set<std::string> phases;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    phases.insert(frames[f].phase);
    EXPECT_EQ(frames[f].displacements.size(), 3 * frames[f].vertices.size());
    EXPECT_TRUE(std::is_sorted(frames[f].vertices.begin(), frames[f].vertices.end()));
    Surface moment = surface;
    moment.positions = positions_at(surface, frames, f);
    const std::vector<IntersectingPair> pairs = find_intersections(moment);
    EXPECT_EQ(pairs.size(), frames[f].pairs) << "frame " << f;
    EXPECT_EQ(pairs.empty(), frames[f].intersecting.empty()) << "frame " << f;
    // Recovery never leaves the embedded set.
    EXPECT_TRUE(frames[f].phase != "recover" || pairs.empty());
  }
  EXPECT_EQ(phases, (std::set<std::string>{"input", "untangle", "recover", "result"}));
  const std::vector<double> end = positions_at(surface, frames, frames.size() - 1);
  for (std::size_t i = 0; i < end.size(); ++i) EXPECT_NEAR(end[i], result.positions[i], 1e-14 * 30);
}

TEST(Recording, regions_that_do_not_overlap_move_at_the_same_time) {
  // Two equal conflicts, far apart: hardly more frames than one of them alone.
  Shape one = shapes::crossing_bumps(9, 0.3), two = one;
  two.add(one, {64, 0, 0});
  const RepairResult alone = recorded(one.surface(), 1000), both = recorded(two.surface(), 1000);
  EXPECT_EQ(both.report.regions.size(), 2 * alone.report.regions.size());
  // But for the coarser coordinates of the one farther out.
  EXPECT_LT(both.frames.size(), alone.frames.size() + 4);
  const std::int32_t half = static_cast<std::int32_t>(one.points.size());
  bool together = false;
  for (const RecordedFrame& frame : both.frames)
    together |= !frame.vertices.empty() && frame.vertices.front() < half && frame.vertices.back() >= half;
  EXPECT_TRUE(together);
}

TEST(Recording, fewer_frames_are_every_second_one_and_end_the_same) {
  const Surface surface = several_conflicts();
  const RepairResult all = recorded(surface, 1000);
  for (const int most : {2, 3, 5, 8}) {
    const RepairResult few = recorded(surface, most);
    EXPECT_LE(few.frames.size(), static_cast<std::size_t>(most));
    EXPECT_EQ(few.frames.back().phase, "result");
    // Every frame that was kept is one of all.
    std::set<std::vector<double>> moments;
    for (std::size_t f = 0; f < all.frames.size(); ++f) moments.insert(positions_at(surface, all.frames, f));
    for (std::size_t f = 0; f < few.frames.size(); ++f)
      EXPECT_TRUE(moments.contains(positions_at(surface, few.frames, f))) << "frame " << f << " of " << most;
  }
}

TEST(Recording, history_follows_the_regions) {
  const RepairResult result = recorded(several_conflicts(), 0);
  EXPECT_TRUE(result.frames.empty());
  std::size_t untangled = 0, recovered = 0;
  for (const RegionHistory& history : result.report.history) {
    ASSERT_FALSE(history.iterations.empty());
    if (history.phase == "untangle") {
      ++untangled;
      const RegionReport& region = result.report.regions.at(history.region);
      EXPECT_EQ(history.strategy, region.strategy);
      EXPECT_EQ(history.iterations.back().pairs, 0u);
      EXPECT_GT(history.iterations.front().pairs, 0u);
    } else {
      ++recovered;
      EXPECT_EQ(history.phase, "recover");
      for (const IterationRecord& iteration : history.iterations) {
        EXPECT_EQ(iteration.pairs, 0u);
        EXPECT_GE(iteration.step, 0);
        EXPECT_TRUE(std::isnan(iteration.min_gap) || iteration.min_gap > 0);
        EXPECT_TRUE(std::isfinite(iteration[EnergyTerm::arap]) && std::isfinite(iteration[EnergyTerm::barrier]));
        EXPECT_TRUE(std::isnan(iteration[EnergyTerm::gaussian]));
      }
    }
  }
  EXPECT_EQ(untangled, result.report.regions.size());
  EXPECT_GT(recovered, 0u);
}

TEST(Recording, flow_and_paper_have_all_their_energies) {
  const Surface surface = shapes::crossing_bumps(5, 0.3).surface();
  RepairOptions options;
  options.record.history = true;
  options.paper.emplace();
  options.recover = false;
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.report.history.size(), 1u);
  const RegionHistory& history = result.report.history[0];
  EXPECT_EQ(history.strategy, "paper");
  ASSERT_GT(history.iterations.size(), 1u);
  for (const EnergyTerm term : {EnergyTerm::gaussian, EnergyTerm::minkowski, EnergyTerm::arap})
    EXPECT_TRUE(std::isfinite(history.iterations[1][term]));
  EXPECT_GT(history.iterations[1].step, 0);
}

TEST(Recording, shows_copies_of_welded_vertices_together) {
  // Every corner a vertex of its own, as in STL.
  const Surface whole = shapes::crossing_bumps(8, 0.3).surface();
  Surface soup;
  for (const std::int32_t v : whole.corners) {
    soup.corners.push_back(static_cast<std::int32_t>(soup.corners.size()));
    soup.positions.insert(soup.positions.end(), &whole.positions[3 * v], &whole.positions[3 * v] + 3);
  }
  const RepairResult result = recorded(soup, 30);
  ASSERT_EQ(result.status, Status::embedded);
  for (std::size_t f = 0; f < result.frames.size(); ++f) {
    const std::vector<double> positions = positions_at(soup, result.frames, f);
    std::map<std::int32_t, std::size_t> first;
    for (std::size_t c = 0; c < whole.corners.size(); ++c) {
      const auto [at, is_new] = first.emplace(whole.corners[c], c);
      EXPECT_TRUE(std::equal(&positions[3 * c], &positions[3 * c] + 3, &positions[3 * at->second]));
    }
  }
}

TEST(Recording, nothing_to_do_is_two_equal_frames) {
  const Surface surface = shapes::bumpy_sheet(6, 1).surface();
  const RepairResult result = recorded(surface, 10);
  EXPECT_TRUE(result.report.history.empty());
  ASSERT_EQ(result.frames.size(), 2u);
  EXPECT_TRUE(result.frames[1].vertices.empty());
}

TEST(Recording, refuses_a_single_frame) {
  const Surface surface = shapes::bumpy_sheet(6, 1).surface();
  for (const int frames : {1, -1}) EXPECT_THROW(recorded(surface, frames), std::invalid_argument);
}

TEST(Recording, json_holds_what_the_result_holds) {
  const Surface surface = several_conflicts();
  const RepairResult result = recorded(surface, 12);
  const auto json = nlohmann::ordered_json::parse(recording_json(result, surface));
  EXPECT_EQ(json["schema"], "unsnarl-recording");
  EXPECT_EQ(json["schema_version"], recording_schema_version);
  EXPECT_EQ(json["vertices"], surface.view().vertex_count());
  ASSERT_EQ(json["frames"].size(), result.frames.size());
  ASSERT_EQ(json["history"].size(), result.report.history.size());
  for (std::size_t f = 0; f < result.frames.size(); ++f) {
    const RecordedFrame& frame = result.frames[f];
    EXPECT_EQ(json["frames"][f]["pairs"], frame.pairs);
    // Four bytes a value, in groups of three bytes to four digits.
    EXPECT_EQ(json["frames"][f]["vertices"].get<std::string>().size(), (4 * frame.vertices.size() + 2) / 3 * 4);
    EXPECT_EQ(json["frames"][f]["displacements"].get<std::string>().size(), (12 * frame.vertices.size() + 2) / 3 * 4);
  }
  for (std::size_t h = 0; h < result.report.history.size(); ++h) {
    const std::size_t iterations = result.report.history[h].iterations.size();
    for (const char* key : {"pairs", "step", "min_gap"}) EXPECT_EQ(json["history"][h][key].size(), iterations);
    for (const auto& [term, values] : json["history"][h]["energy"].items()) {
      EXPECT_FALSE(term.empty());
      EXPECT_EQ(values.size(), iterations) << term;
    }
  }
}

TEST(Trajectory, keeps_every_second_state_when_there_are_too_many) {
  Patch patch;
  patch.free_count = 1;
  patch.rest = patch.x = Positions::Zero(3, 1);
  Trajectory trajectory(4 * 3 * sizeof(double));
  patch.trajectory = &trajectory;
  for (int i = 0; i < 10; ++i) {
    patch.x(0, 0) = i;
    record(patch, patch.x, {});
  }
  EXPECT_EQ(trajectory.iterations.size(), 10u);
  std::vector<int> kept;
  for (const Trajectory::State& state : trajectory.states) {
    kept.push_back(state.iteration);
    EXPECT_EQ(state.x(0, 0), state.iteration);
    EXPECT_EQ(trajectory.iterations[state.iteration].step, state.iteration > 0 ? 1 : 0);
  }
  EXPECT_EQ(kept, (std::vector<int>{0, 4, 8}));
}

TEST(Trajectory, forgets_tries_that_were_given_up) {
  Patch patch;
  patch.free_count = 1;
  patch.rest = patch.x = Positions::Zero(3, 1);
  Trajectory trajectory(1000);
  patch.trajectory = &trajectory;
  record(patch, patch.x, {.pairs = 3});
  const Trajectory::Mark before = trajectory.mark();
  patch.x(0, 0) = 5;
  record(patch, patch.x, {.pairs = 7});
  trajectory.rewind(before);
  patch.x(0, 0) = 2;
  record(patch, patch.x, {.pairs = 2});
  ASSERT_EQ(trajectory.iterations.size(), 2u);
  EXPECT_EQ(trajectory.states.size(), 2u);
  EXPECT_EQ(trajectory.iterations[1].pairs, 2u);
  EXPECT_EQ(trajectory.iterations[1].step, 2);
}

}  // namespace
}  // namespace unsnarl
