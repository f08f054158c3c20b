#include "untangle/candidates.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

/// A scene of four vertices, and candidates that move the first of them.
Scene small_scene() {
  return shapes::scene_of(shapes::bumpy_sheet(1, 0));
}

struct Given {
  Index first_vertex = 0;
  double motion = 1, bound = 2;
  std::size_t before = 10, left = 0, disjoint_before = 0, disjoint_left = 0;
};

Trial trial_of(const Scene& scene, const Given& given) {
  Trial trial;
  trial.selection.region.core = {given.first_vertex};
  trial.selection.free = {given.first_vertex};
  trial.selection.bound = trial.reach = given.bound;
  trial.patch.free_count = 1;
  trial.start = trial.patch.rest = trial.patch.x = scene.x.col(given.first_vertex);
  trial.patch.x(0, 0) += given.motion;
  trial.before.total = given.before;
  trial.before.disjoint = given.disjoint_before;
  trial.left.total = given.left;
  trial.left.disjoint = given.disjoint_left;
  trial.distance = given.motion;
  return trial;
}

TEST(Judge, keeps_what_leaves_few_pairs_and_remembers_what_leaves_fewer) {
  const Scene scene = small_scene();
  const auto verdict = [&](const Given& given) { return judge(trial_of(scene, given), false, nullptr); };
  EXPECT_EQ(verdict({.left = 0}), Verdict::keep);
  EXPECT_EQ(verdict({.before = 100, .left = 9}), Verdict::keep);
  EXPECT_EQ(verdict({.before = 100, .left = 10}), Verdict::remember);
  EXPECT_EQ(verdict({.left = 9}), Verdict::remember);
  EXPECT_EQ(verdict({.left = 10}), Verdict::drop);
  EXPECT_EQ(verdict({.left = 5, .disjoint_before = 1, .disjoint_left = 2}), Verdict::drop) << "more disjoint pairs";
}

TEST(Judge, drops_what_is_not_accepted) {
  const Scene scene = small_scene();
  Trial trial = trial_of(scene, {});
  trial.is_rejected = true;
  EXPECT_EQ(judge(trial, true, nullptr), Verdict::drop);
  EXPECT_EQ(judge(trial_of(scene, {.left = 1}), true, nullptr), Verdict::drop);
  EXPECT_EQ(judge(trial_of(scene, {.left = 1}), false, nullptr), Verdict::remember);
}

TEST(Judge, compares_what_went_far_or_has_a_rival) {
  const Scene scene = small_scene();
  const Trial near = trial_of(scene, {.motion = 1}), far = trial_of(scene, {.motion = 3});
  EXPECT_EQ(judge(near, false, &far), Verdict::compare);
  EXPECT_EQ(judge(far, false, nullptr), Verdict::compare);
}

TEST(Judge, of_two_that_went_far_only_the_nearer_waits) {
  const Scene scene = small_scene();
  const Trial far = trial_of(scene, {.motion = 3}), farther = trial_of(scene, {.motion = 4});
  EXPECT_EQ(judge_far(far, nullptr), Verdict::wait);
  EXPECT_EQ(judge_far(far, &farther), Verdict::wait);
  EXPECT_EQ(judge_far(farther, &far), Verdict::drop);
  EXPECT_EQ(judge_far(far, &far), Verdict::drop) << "as far";
  EXPECT_EQ(judge_far(trial_of(scene, {.motion = 1}), &far), Verdict::keep) << "within its bound after all";
  EXPECT_EQ(judge_far(trial_of(scene, {.motion = 3, .left = 1}), nullptr), Verdict::drop) << "far, and leaves pairs";
  EXPECT_EQ(judge_far(trial_of(scene, {.motion = 1, .left = 1}), &far), Verdict::drop);
  EXPECT_EQ(judge_far(trial_of(scene, {.motion = 1, .left = 5}), nullptr), Verdict::remember);
}

TEST(Judge, what_turns_a_component_inside_out_waits_for_any_other) {
  const Scene scene = small_scene();
  Trial turned = trial_of(scene, {.motion = 1});
  turned.is_inside_out = true;
  const Trial far = trial_of(scene, {.motion = 3});
  EXPECT_EQ(judge(turned, false, nullptr), Verdict::compare);
  EXPECT_EQ(judge_far(turned, nullptr), Verdict::wait);
  EXPECT_EQ(judge_far(far, &turned), Verdict::wait) << "in its place";
  EXPECT_EQ(judge_far(turned, &far), Verdict::drop);
}

TEST(Candidates, that_wait_are_taken_nearest_first) {
  const Scene scene = small_scene();
  Candidates candidates;
  candidates.wait(trial_of(scene, {.first_vertex = 0, .motion = 5}), scene);
  candidates.wait(trial_of(scene, {.first_vertex = 1, .motion = 3}), scene);
  candidates.wait(trial_of(scene, {.first_vertex = 2, .motion = 4}), scene);
  candidates.wait(trial_of(scene, {.first_vertex = 1, .motion = 2}), scene);  // in place of the one before
  const auto distances = [](const std::vector<Trial>& trials) {
    std::vector<double> found;
    for (const Trial& trial : trials) found.push_back(trial.distance);
    return found;
  };
  const auto is_due = [](const Trial& trial) { return trial.selection.region.core[0] != 2; };
  EXPECT_EQ(distances(candidates.take_waiting(is_due)), (std::vector<double>{2, 5}));
  const auto any = [](const Trial&) { return true; };
  EXPECT_EQ(distances(candidates.take_waiting(any)), std::vector<double>{4});
  EXPECT_TRUE(candidates.take_waiting(any).empty());
}

TEST(Candidates, that_are_outdated_are_no_rivals) {
  Scene scene = small_scene();
  Candidates candidates;
  candidates.wait(trial_of(scene, {.first_vertex = 1}), scene);
  EXPECT_NE(candidates.rival({{1}, {}}, scene), nullptr);
  EXPECT_EQ(candidates.rival({{2}, {}}, scene), nullptr);
  scene.x(0, 1) += 1;
  EXPECT_EQ(candidates.rival({{1}, {}}, scene), nullptr);
}

TEST(Candidates, the_one_that_resolves_most_is_remembered) {
  const Scene scene = small_scene();
  Candidates candidates;
  candidates.remember(trial_of(scene, {.before = 10, .left = 6}), scene);
  candidates.remember(trial_of(scene, {.before = 20, .left = 10}), scene);
  candidates.remember(trial_of(scene, {.before = 10, .left = 5}), scene);
  std::vector<std::size_t> kept;
  const auto keep = [&](Trial& trial) { kept.push_back(trial.resolved()); };
  const auto any = [](const Trial&) { return true; };
  candidates.take_best(0.5, any, scene, keep);
  EXPECT_TRUE(kept.empty()) << "it leaves half";
  candidates.take_best(
      0.51, [](const Trial&) { return false; }, scene, keep);
  EXPECT_TRUE(kept.empty()) << "it is not due";
  candidates.take_best(0.51, any, scene, keep);
  EXPECT_EQ(kept, std::vector<std::size_t>{10});
  candidates.take_best(1, any, scene, keep);
  EXPECT_EQ(kept.size(), 1u) << "it was taken out";
}

TEST(Candidates, that_are_remembered_are_replaced_once_they_are_outdated) {
  Scene scene = small_scene();
  Candidates candidates;
  candidates.remember(trial_of(scene, {.before = 20, .left = 1}), scene);
  scene.x(0, 0) += 1;
  candidates.remember(trial_of(scene, {.before = 20, .left = 10}), scene);
  std::vector<std::size_t> kept;
  candidates.take_best(
      1, [](const Trial&) { return true; }, scene, [&](Trial& trial) { kept.push_back(trial.resolved()); });
  EXPECT_EQ(kept, std::vector<std::size_t>{10});
}

}  // namespace
}  // namespace unsnarl
