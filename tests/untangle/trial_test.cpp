#include "untangle/trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "mesh/areas.h"
#include "scene/shapes.h"

namespace unsnarl {
namespace {

using shapes::Shape;

/// Two sheets that run through each other, the upper one free, and what strategies lift it by.
class Sheets {
 public:
  Sheets() : scene(half_fixed()), index(scene) {
    pairs = index.find_pairs();
    is_due.assign(static_cast<std::size_t>(scene.vertex_count()), 1);
    is_rejected.assign(static_cast<std::size_t>(scene.vertex_count()), 0);
  }

  /// The trial, run, of a strategy that lifts what is free by this height.
  Trial lifted(double height, const TrialOptions& options = {}, double reach = 100) {
    strategy = {"lifting", select_whole_components(reach), [this, height](Patch& patch, const Task& given) {
                  told = given;
                  patch.x.row(2).leftCols(patch.free_count).array() += height;
                  return 3;
                }};
    std::vector<Selection> selections = strategy.select({scene, pairs, pairs, is_due, is_rejected, [this]() -> auto& {
                                                           return parts ? *parts : parts.emplace(scene);
  }});
Trial trial = make_trial(strategy, std::move(selections.front()));
PatchProgress progress;
run_trial(trial, scene, index, options, {}, progress);
return trial;
}  // namespace

static Scene half_fixed() {
  const Shape shape = shapes::crossing_bumps(12, 1.5);
  std::vector<std::uint8_t> fixed(shape.points.size(), 0);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(fixed.size() / 2), std::uint8_t{1});
  return make_scene(shape.positions(), shape.triangles, fixed);
}

Scene scene;
SceneIndex index;
std::vector<IntersectingPair> pairs;
std::vector<std::uint8_t> is_due, is_rejected;
std::optional<ConnectedParts> parts;
Strategy strategy;
Task told;
};  // namespace unsnarl

TEST(Trial, counts_the_pairs_before_and_after) {
  Sheets sheets;
  const Trial trial = sheets.lifted(5);
  EXPECT_EQ(trial.before.total, sheets.pairs.size());
  EXPECT_TRUE(trial.is_clean());
  EXPECT_EQ(trial.resolved(), sheets.pairs.size());
  EXPECT_EQ(trial.iterations, 3);
  EXPECT_NEAR(largest_motion(trial), 5, 1e-12);
  EXPECT_NEAR(largest_distance(trial), 5, 1e-12);
  EXPECT_TRUE(sheets.scene.x == sheets.scene.rest) << "the surface stays";
  EXPECT_LE(sheets.told.few_enough, kept_at_once * static_cast<double>(sheets.pairs.size()));
}

TEST(Trial, a_state_that_is_not_finite_is_given_up) {
  Sheets sheets;
  const Trial trial = sheets.lifted(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(trial.patch.x == trial.start);
  EXPECT_EQ(trial.left.total, trial.before.total);
}

TEST(Trial, asks_whether_a_clean_candidate_is_accepted) {
  Sheets sheets;
  int asked = 0;
  TrialOptions options;
  options.accept = [&](Patch&) { return ++asked > 1; };
  EXPECT_TRUE(sheets.lifted(5, options).is_rejected);
  EXPECT_FALSE(sheets.lifted(5, options).is_rejected);
  EXPECT_FALSE(sheets.lifted(-0.5, options).is_rejected);
  EXPECT_EQ(asked, 2) << "not about one that leaves pairs";
  EXPECT_EQ(sheets.told.few_enough, 0u) << "what leaves pairs would be dropped";
}

TEST(Trial, a_stopped_one_changes_nothing) {
  Sheets sheets;
  TrialOptions options;
  options.stop = [] { return true; };
  const Trial trial = sheets.lifted(5, options);
  EXPECT_EQ(trial.iterations, 0);
  EXPECT_FALSE(trial.left.fell_from(trial.before));
}

TEST(Trial, is_outdated_once_its_vertices_have_moved) {
  Sheets sheets;
  const Trial trial = sheets.lifted(5);
  EXPECT_TRUE(is_current(trial, sheets.scene));
  sheets.scene.x.col(0) += Vec3(1, 0, 0);
  EXPECT_TRUE(is_current(trial, sheets.scene)) << "that one is not free";
  sheets.scene.x.col(trial.selection.free.back()) += Vec3(1, 0, 0);
  EXPECT_FALSE(is_current(trial, sheets.scene));
}

TEST(Trial, counts_what_it_meets_now) {
  Sheets sheets;
  Trial trial = sheets.lifted(5);
  ASSERT_TRUE(trial.is_clean());
  // The fixed sheet goes where the free one is now.
  const Index half = sheets.scene.vertex_count() / 2;
  sheets.scene.x.row(2).leftCols(half).array() += 4;
  sheets.index.update();
  put_among_obstacles(trial, sheets.scene, sheets.index);
  EXPECT_FALSE(trial.is_clean());
}

TEST(Trial, looking_farther_recovers_clean_candidates) {
  Sheets sheets;
  Trial clean = sheets.lifted(5, {}, 0.1), crossing = sheets.lifted(0.3, {}, 0.1);
  int recovered = 0;
  const auto recover = [&](Patch& patch) {
    ++recovered;
    patch.x.row(2).leftCols(patch.free_count).array() -= 1;
  };
  look_farther(clean, sheets.scene, sheets.index, recover);
  EXPECT_NEAR(largest_distance(clean), 4, 1e-12);
  // Faces with held vertices count by a part of their squared motion.
  double of_free_faces = 0, of_all = 0;
  for (Index t = 0; t < clean.patch.active_count; ++t) {
    const Triangle& face = clean.patch.triangles[t];
    const double most = 4.0 * 4.0 * triangle_area(clean.patch.rest, face);
    of_all += most;
    if (std::all_of(face.begin(), face.end(), [&](Index v) { return v < clean.patch.free_count; }))
      of_free_faces += most;
  }
  ASSERT_GT(of_free_faces, 0);
  EXPECT_GE(clean.distance, of_free_faces * (1 - 1e-9));
  EXPECT_LE(clean.distance, of_all * (1 + 1e-9));
  look_farther(crossing, sheets.scene, sheets.index, recover);
  EXPECT_EQ(recovered, 1);
}

TEST(Trial, what_was_freed_by_depth_is_recovered_around_what_moved) {
  Sheets sheets;
  Trial trial = sheets.lifted(5);
  EXPECT_EQ(to_be_recovered(trial, sheets.scene), trial.selection.free);
  trial.selection.depth = 4;
  trial.patch.x = trial.start;
  EXPECT_TRUE(to_be_recovered(trial, sheets.scene).empty());
  trial.patch.x.col(0) += Vec3(1, 0, 0);
  const std::vector<Index> some = to_be_recovered(trial, sheets.scene);
  EXPECT_GT(some.size(), 1u);
  EXPECT_LT(some.size(), trial.selection.free.size());
}

}  // namespace
}  // namespace unsnarl
