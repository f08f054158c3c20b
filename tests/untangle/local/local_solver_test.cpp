#include "untangle/local/local_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "contact/blocking_pairs.h"
#include "scene/shapes.h"
#include "scene/trajectory.h"

namespace unsnarl {
namespace {

using shapes::Shape;

// The border of the grid shapes made of n x n cells held: free vertices have to come first.
Patch with_held_border(const Shape& shape, Index n) {
  Shape sorted;
  std::vector<Index> id(shape.points.size());
  Index free_count = 0;
  const Index row = n + 1;
  for (const bool border : {false, true}) {
    for (std::size_t v = 0; v < shape.points.size(); ++v) {
      const Index i = static_cast<Index>(v) / row % row, j = static_cast<Index>(v) % row;
      if ((i == 0 || j == 0 || i == n || j == n) != border) continue;
      id[v] = static_cast<Index>(sorted.points.size());
      sorted.points.push_back(shape.points[v]);
    }
    if (!border) free_count = static_cast<Index>(sorted.points.size());
  }
  std::vector<Triangle> obstacles;
  for (const Triangle& t : shape.triangles) {
    const Triangle s = {id[t[0]], id[t[1]], id[t[2]]};
    (std::min({s[0], s[1], s[2]}) < free_count ? sorted.triangles : obstacles).push_back(s);
  }
  const Index active_count = static_cast<Index>(sorted.triangles.size());
  sorted.triangles.insert(sorted.triangles.end(), obstacles.begin(), obstacles.end());
  Patch patch = shapes::patch_of(sorted);
  patch.free_count = free_count;
  patch.active_count = active_count;
  return patch;
}

constexpr LocalSettings shallow = {LocalMethod::shallow, SheetMotion::slide, 0.1, 1, 60};
constexpr LocalSettings slide = {LocalMethod::contour, SheetMotion::slide, 0.1, 2, 60};
constexpr LocalSettings steeper = {LocalMethod::contour, SheetMotion::steeper, 0.1, 2, 60};
constexpr LocalSettings offset = {LocalMethod::contour, SheetMotion::offset, 0.1, 2, 60};
constexpr LocalSettings free_crossings = {LocalMethod::contour, SheetMotion::free, 0.1, 2, 60};
const LocalSettings every_method[] = {shallow, slide, steeper, offset, free_crossings};

TEST(LocalSolver, each_method_clears_a_shallow_crossing) {
  for (const LocalSettings& strategy : every_method) {
    SCOPED_TRACE(static_cast<int>(strategy.method) * 10 + static_cast<int>(strategy.motion));
    Patch patch = with_held_border(shapes::crossing_bumps(12, 0.3), 12);
    const Positions start = patch.x;
    ASSERT_FALSE(shapes::pairs_at(start, patch.triangles).empty());
    const LocalResult result = solve_locally(patch, strategy);
    ASSERT_TRUE(result.clean);
    EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
    EXPECT_FALSE(has_squeezed_face(patch, start, patch.x, LocalOptions{}.area_floor));
    EXPECT_GT(result.iterations, 0);
    const Positions moved = patch.x - start;
    EXPECT_DOUBLE_EQ(result.displacement, moved.leftCols(patch.free_count).colwise().norm().maxCoeff());
    EXPECT_TRUE((moved.rightCols(patch.x.cols() - patch.free_count).array() == 0).all()) << "held vertices moved";
    // The crossing is 0.3 deep, halved between the two; they must not move much more than that.
    EXPECT_LT(result.displacement, 0.5);
  }
}

// Long tries look for pairs now and then only, and are clean at the end all the same.
TEST(LocalSolver, long_tries_follow_the_pairs_that_they_know) {
  std::size_t looks[2] = {};
  for (const bool follow : {false, true}) {
    Patch patch = with_held_border(shapes::crossing_bumps(12, 0.3), 12);
    Trajectory trajectory;
    patch.trajectory = &trajectory;
    LocalOptions options;
    options.patience = 1000;
    if (!follow) options.recount_distance = 0;
    const LocalResult result =
        solve_locally(patch, {LocalMethod::contour, SheetMotion::slide, 0.0005, 2, 10}, {}, options);
    ASSERT_TRUE(result.clean);
    EXPECT_TRUE(shapes::pairs_at(patch.x, patch.triangles).empty());
    EXPECT_GT(result.iterations, 2 * options.give_up_after);
    looks[follow] = trajectory.iterations.size();
  }
  EXPECT_LT(1.5 * static_cast<double>(looks[1]), static_cast<double>(looks[0]));
}

TEST(LocalSolver, exactly_coincident_sheets_are_parted) {
  const Shape sheet = shapes::bumpy_sheet(6, 0.5);
  Patch patch = with_held_border(Shape(sheet).add(sheet, {0, 0, 0}), 6);
  // Held borders that coincide stay; only what can be parted is asked for.
  std::vector<IntersectingPair> held;
  for (const IntersectingPair& pair : IntersectionFinder(patch.triangles, patch.active_count).find(patch.x)) {
    const auto touches_border = [&](Index t) {
      return std::max({patch.triangles[t][0], patch.triangles[t][1], patch.triangles[t][2]}) >= patch.free_count;
    };
    if (touches_border(pair.a) && touches_border(pair.b)) held.push_back(pair);
  }
  const LocalResult result = solve_locally(patch, slide, held);
  ASSERT_TRUE(result.clean);
  EXPECT_TRUE(blocking_pairs(IntersectionFinder(patch.triangles, patch.active_count).find(patch.x), held).empty());
}

TEST(LocalSolver, failure_keeps_the_state_with_the_fewest_pairs) {
  const Patch original = with_held_border(shapes::crossing_bumps(12, 2.5), 12);
  LocalOptions options;
  options.patience = 2;
  for (LocalSettings strategy : every_method) {
    strategy.step = 0.01;  // two small steps do not do
    strategy.locality = 0.3;
    strategy.max_iterations = 2;
    Patch patch = original;
    const LocalResult result = solve_locally(patch, strategy, {}, options);
    EXPECT_FALSE(result.clean);
    const std::size_t left = shapes::pairs_at(patch.x, patch.triangles).size();
    EXPECT_EQ(result.pairs_left, left);
    EXPECT_LE(left, shapes::pairs_at(original.x, original.triangles).size());
    EXPECT_TRUE(patch.x.rightCols(patch.x.cols() - patch.free_count) ==
                original.x.rightCols(patch.x.cols() - patch.free_count));
  }
  Patch stopped = original;
  EXPECT_FALSE(solve_locally(stopped, slide, {}, {}, [] { return true; }).clean);
  EXPECT_TRUE(stopped.x == original.x);
}

TEST(LocalSolver, what_only_squeezing_could_clear_is_no_success) {
  Patch patch = with_held_border(shapes::crossing_bumps(12, 0.3), 12);
  LocalOptions options;
  options.area_floor = 1.5;  // no face may be smaller than one and a half times what it was: impossible
  const Positions start = patch.x;
  EXPECT_FALSE(solve_locally(patch, slide, {}, options).clean);
  EXPECT_TRUE(patch.x == start);
}

TEST(LocalSolver, tolerated_pairs_are_let_be) {
  Shape shape = shapes::crossing_bumps(12, 0.3);
  Patch alone = with_held_border(shape, 12);
  // A needle through a square far away; both are obstacles' neighbours and free to move, but nobody's business here.
  Patch patch = alone;
  const Shape other = shapes::crossed_squares();
  const Index old_free = patch.free_count, old_active = patch.active_count;
  const Index extra = static_cast<Index>(other.points.size());
  Positions x(3, patch.x.cols() + extra);
  x.leftCols(old_free) = alone.x.leftCols(old_free);
  for (Index v = 0; v < extra; ++v) x.col(old_free + v) = other.points[v] + Vec3(40, 0, 0);
  x.rightCols(alone.x.cols() - old_free) = alone.x.rightCols(alone.x.cols() - old_free);
  const auto shifted = [&](Index v) { return v < old_free ? v : v + extra; };
  for (Triangle& t : patch.triangles) t = {shifted(t[0]), shifted(t[1]), shifted(t[2])};
  std::vector<Triangle> added;
  for (const Triangle& t : other.triangles) added.push_back({t[0] + old_free, t[1] + old_free, t[2] + old_free});
  patch.triangles.insert(patch.triangles.begin() + old_active, added.begin(), added.end());
  patch.x = patch.rest = x;
  patch.free_count += extra;
  patch.active_count += static_cast<Index>(added.size());

  const auto is_foreign = [&](const IntersectingPair& pair) {
    return pair.a >= old_active && pair.b < old_active + static_cast<Index>(added.size());
  };
  std::vector<IntersectingPair> foreign;
  for (const IntersectingPair& pair : shapes::pairs_at(patch.x, patch.triangles))
    if (is_foreign(pair)) foreign.push_back(pair);
  ASSERT_FALSE(foreign.empty());

  Patch tried = patch;
  ASSERT_TRUE(solve_locally(tried, slide, foreign).clean);
  const auto left = shapes::pairs_at(tried.x, tried.triangles);
  EXPECT_TRUE(std::all_of(left.begin(), left.end(), is_foreign));
  EXPECT_FALSE(left.empty()) << "the tolerated pairs were worked on";
}

TEST(LocalSolver, shrinking_keeps_the_smallest_clean_displacement) {
  Patch patch = shapes::patch_of(shapes::bumpy_sheet(2, 0));
  patch.free_count = 5;
  const Positions start = patch.x;
  Positions whole = start;
  whole.leftCols(5).array() += 32;
  for (const double needed : {0.5, 5.0, 10.5, 31.5}) {
    patch.x = whole;
    shrink_displacement(patch, start, 5, [&](const Positions& x) { return x(0, 0) - start(0, 0) >= needed; });
    EXPECT_DOUBLE_EQ(patch.x(0, 0) - start(0, 0), std::ceil(needed));
    EXPECT_TRUE(patch.x.rightCols(4) == start.rightCols(4));
  }
  patch.x = whole;
  shrink_displacement(patch, start, 5, [](const Positions&) { return false; });
  EXPECT_TRUE(patch.x == whole);
  shrink_displacement(patch, start, 0, [](const Positions&) { return true; });
  EXPECT_TRUE(patch.x == whole);
}

}  // namespace
}  // namespace unsnarl
