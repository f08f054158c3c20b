#include "unsnarl/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "applications/curves/curve_net.h"
#include "applications/curves/segment_tree.h"
#include "oracle/crossings_by_brute_force.h"

namespace unsnarl {
namespace {

Curve closed(std::vector<double> points) {
  return {.points = std::move(points), .closed = true, .fixed = {}, .name = {}};
}
Curve open(std::vector<double> points) {
  return {.points = std::move(points), .closed = false, .fixed = {}, .name = {}};
}
Curve circle(double x, double y, double r, int n) {
  Curve curve{.points = {}, .closed = true, .fixed = {}, .name = {}};
  for (int k = 0; k < n; ++k) {
    const double t = 2 * std::numbers::pi * k / n;
    curve.points.insert(curve.points.end(), {x + r * std::cos(t), y + r * std::sin(t)});
  }
  return curve;
}
Curve figure_eight(int n) {
  Curve curve{.points = {}, .closed = true, .fixed = {}, .name = {}};
  for (int k = 0; k < n; ++k) {
    const double t = 2 * std::numbers::pi * (k + 0.3) / n;
    curve.points.insert(curve.points.end(), {std::sin(2 * t), 2 * std::sin(t)});
  }
  return curve;
}

/// Untangles, and has the oracle say that nothing crosses.
CurveResult untangled(const std::vector<Curve>& curves, const CurveOptions& options = {}) {
  CurveResult result = untangle_curves(curves, options);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_EQ(oracle::count_crossings(result.curves, result.report.joints), 0U);
  return result;
}

TEST(FindCrossings, agrees_with_the_oracle_on_lattice_points) {
  // Few places, so that touching and overlapping segments are the rule.
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Curve chaos = random_closed_curve("chaos", seed, 8 + static_cast<int>(seed % 9));
    for (double& c : chaos.points) c = std::floor(4 * c);
    std::vector<Curve> curves{chaos};
    try {
      check_curves(curves);
    } catch (const std::invalid_argument&) {
      continue;  // two equal points in a row
    }
    EXPECT_EQ(find_crossings(curves).size(), oracle::count_crossings(curves, {})) << seed;
  }
}

TEST(FindCrossings, shared_ends_of_a_joint_do_not_count) {
  const std::vector<Curve> curves{open({0, 0, 1, 0}), open({1, 0, 1, 1}), open({1, 0, 2, 0})};
  EXPECT_EQ(find_crossings(curves).size(), 3U);
  const std::vector<CurveJoint> joints{{{0, 1}, {1, 0}, {2, 0}}};
  EXPECT_TRUE(find_crossings(curves, joints).empty());
}

TEST(FindCrossings, points_of_a_joint_that_are_apart_are_two) {
  const double just_below = -1e-15;
  const std::vector<Curve> curves{open({-1, 0, 0, 0, 1, 0}), open({0, just_below, 0, 1})};
  const std::vector<CurveJoint> joints{{{0, 1}, {1, 0}}};
  EXPECT_EQ(find_crossings(curves, joints).size(), 2U);
  EXPECT_EQ(oracle::count_crossings(curves, joints), 2U);
}

TEST(FindCrossings, folded_segments_meet) {
  EXPECT_EQ(find_crossings(std::vector<Curve>{open({0, 0, 2, 0, 1, 0})}).size(), 1U);
  EXPECT_EQ(find_crossings(std::vector<Curve>{open({0, 0, 1, 0, 2, 0})}).size(), 0U);
}

TEST(FindCrossings, holds_where_doubles_cannot_tell) {
  // The end of the second segment is one unit in the last place beside the first, on either side.
  const double y = 0.5, up = std::nextafter(y, 1), down = std::nextafter(y, 0);
  EXPECT_EQ(find_crossings(std::vector<Curve>{open({0, 0, 1, 1}), open({0.5, y, 1, 0})}).size(), 1U);
  EXPECT_EQ(find_crossings(std::vector<Curve>{open({0, 0, 1, 1}), open({0.5, up, 1, 0})}).size(), 1U);
  EXPECT_EQ(find_crossings(std::vector<Curve>{open({0, 0, 1, 1}), open({0.5, down, 1, 0})}).size(), 0U);
}

TEST(UntangleCurves, a_figure_eight_opens_and_keeps_its_drawing) {
  const CurveResult result = untangled({figure_eight(400)});
  EXPECT_EQ(result.report.crossings_before, 1U);
  EXPECT_LT(result.report.distance_max_rel, 0.01);
  EXPECT_GT(result.report.turned_points, 0U);
  EXPECT_LT(result.report.displacement_max_rel, 0.5);
}

TEST(UntangleCurves, random_closed_curves_of_every_kind_end_simple) {
  for (const std::string_view kind : random_curve_kinds())
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(std::string(kind) + " " + std::to_string(seed));
      const int points = 100 + static_cast<int>(seed) * 18;
      const CurveResult result = untangled({random_closed_curve(kind, seed, points)});
      EXPECT_LT(result.report.distance_mean_rel, 0.01);
    }
}

/// The star polygon {n/k}.
Curve star(int n, int k) {
  Curve curve{.points = {}, .closed = true, .fixed = {}, .name = {}};
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i * k / n;
    curve.points.insert(curve.points.end(), {std::cos(t), std::sin(t)});
  }
  return curve;
}

TEST(UntangleCurves, long_segments_keep_their_drawing) {
  for (const Curve& curve : {star(5, 2), star(13, 5), star(31, 11), random_closed_curve("chaos", 2, 12)}) {
    const CurveResult result = untangled({curve});
    EXPECT_GT(result.report.crossings_before, 4U);
    EXPECT_EQ(result.report.drawing_lost, 0);
    EXPECT_LT(result.report.drawing_distance_max_rel, 0.004);
    EXPECT_LT(result.report.distance_max_rel, 0.004);
    EXPECT_TRUE(result.curves[0].closed);
    EXPECT_EQ(result.curves[0].size(), curve.size() + result.report.inserted_points);
    // The corners are where they were.
    for (std::size_t k = 0; k < curve.size(); ++k) {
      bool found = false;
      for (std::size_t i = 0; i < result.curves[0].size(); ++i)
        found |= std::hypot(result.curves[0].points[2 * i] - curve.points[2 * k],
                            result.curves[0].points[2 * i + 1] - curve.points[2 * k + 1]) < 0.01;
      EXPECT_TRUE(found) << k;
    }
  }
}

TEST(UntangleCurves, strands_that_are_moved_keep_the_points_and_the_report_says_what_is_lost) {
  const CurveResult result = untangled({star(13, 5)}, {.move_strands = true});
  EXPECT_EQ(result.curves[0].size(), 13U);
  EXPECT_GT(result.report.drawing_lost, 0.5);
  EXPECT_GT(result.report.drawing_distance_max_rel, 0.1);
}

TEST(UntangleCurves, crowded_circles_exchange_their_parts) {
  std::vector<Curve> circles;
  for (int k = 0; k < 30; ++k)
    circles.push_back(circle(std::fmod(0.618 * k, 1), std::fmod(0.414 * k, 1), 0.1 + 0.005 * k, 24));
  const CurveResult result = untangled(circles);
  EXPECT_GT(result.report.crossings_before, 100U);
  EXPECT_EQ(result.report.drawing_lost, 0);
  EXPECT_EQ(result.curves.size(), circles.size());
}

TEST(UntangleCurves, three_circles_stay_three_closed_curves) {
  const CurveResult result = untangled({circle(0, 0, 1, 60), circle(1, 0, 1, 60), circle(0.5, 0.8, 1, 60)});
  EXPECT_LT(result.report.drawing_distance_max_rel, 0.004);
  for (const Curve& curve : result.curves) EXPECT_TRUE(curve.closed);
}

TEST(UntangleCurves, fixed_points_stay_with_their_curves) {
  std::vector<Curve> curves{circle(0, 0, 1, 60), circle(1, 0, 1, 60)};
  for (Curve& curve : curves) curve.fixed.assign(60, 0);
  curves[0].fixed[30] = curves[1].fixed[0] = 1;
  const CurveResult result = untangled(curves);
  for (std::size_t c = 0; c < 2; ++c) {
    const std::size_t k = c == 0 ? 30 : 0;
    bool found = false;
    for (std::size_t i = 0; i < result.curves[c].size(); ++i)
      found |= result.curves[c].points[2 * i] == curves[c].points[2 * k] &&
               result.curves[c].points[2 * i + 1] == curves[c].points[2 * k + 1] && result.curves[c].fixed[i] != 0;
    EXPECT_TRUE(found) << c;
  }
}

TEST(UntangleCurves, what_does_not_cross_comes_back_unchanged) {
  const std::vector<Curve> curves{circle(0, 0, 1, 50), circle(0, 0, 2, 50), open({3, 0, 4, 1})};
  const CurveResult result = untangled(curves);
  for (std::size_t c = 0; c < curves.size(); ++c) EXPECT_EQ(result.curves[c].points, curves[c].points);
}

TEST(UntangleCurves, far_from_a_crossing_points_are_bit_identical) {
  Curve wave{.points = {}, .closed = false, .fixed = {}, .name = {}};
  for (int k = 0; k <= 400; ++k) wave.points.insert(wave.points.end(), {k * 0.1, std::sin(k * 0.1)});
  const Curve bump = open({35, 5, 35, 0.0, 35.2, -0.7, 35.4, 0.0, 35.4, 5});
  const CurveResult result = untangled({wave, bump});
  EXPECT_GT(result.report.crossings_before, 0U);
  for (std::size_t k = 0; k < 2 * 200; ++k) EXPECT_EQ(result.curves[0].points[k], wave.points[k]);
}

TEST(UntangleCurves, sets_of_curves_come_apart) {
  std::vector<Curve> rings;
  for (int k = 0; k < 9; ++k) rings.push_back(circle(1.3 * (k % 3), 1.3 * (k / 3), 0.9, 80));
  const CurveResult result = untangled(rings);
  EXPECT_LT(result.report.distance_max_rel, 0.02);
  std::vector<Curve> sticks;
  for (int k = 0; k < 12; ++k) {
    const double t = std::numbers::pi * k / 12;
    sticks.push_back(open({std::cos(t), std::sin(t), 0.1 * k, 0.02 * k, -std::cos(t), -std::sin(t)}));
  }
  untangled(sticks);
}

TEST(UntangleCurves, copies_and_common_borders_are_drawn_in_a_little) {
  const CurveResult copies = untangled({circle(0, 0, 1, 40), circle(0, 0, 1, 40)});
  EXPECT_LT(copies.report.displacement_max_rel, 0.01);
  const CurveResult map = untangled({closed({0, 0, 1, 0, 1, 1, 0, 1}), closed({1, 0, 2, 0, 2, 1, 1, 1})});
  EXPECT_LT(map.report.displacement_max_rel, 0.01);
}

TEST(UntangleCurves, shared_ends_stay_shared) {
  const std::vector<Curve> theta{open({0, 0, 2, 3, 5, 3, 8, 3, 10, 0}),
                                 open({0, 0, 2, 4, 3, 1, 5, -1, 7, 1, 8, 4, 10, 0}), open({0, 0, 5, -5, 10, 0})};
  const CurveResult result = untangled(theta);
  ASSERT_EQ(result.report.joints.size(), 2U);
  for (const CurveJoint& joint : result.report.joints) {
    ASSERT_EQ(joint.size(), 3U);
    for (const auto& [c, k] : joint)
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_EQ(result.curves[c].points[2 * k + axis], result.curves[joint[0][0]].points[2 * joint[0][1] + axis]);
  }
}

TEST(UntangleCurves, at_junction_gets_a_point_and_stays) {
  const std::vector<Curve> curves{open({0, 0, 10, 0}), open({5, 0, 5, 4, 2, 4, 2, -1})};
  const CurveResult result = untangled(curves, {.move_strands = true});
  EXPECT_EQ(result.report.inserted_points, 1U);
  ASSERT_EQ(result.curves[0].size(), 3U);
  EXPECT_EQ(result.curves[0].points[2], result.curves[1].points[0]);
  EXPECT_EQ(result.curves[0].points[3], result.curves[1].points[1]);
}

TEST(UntangleCurves, curves_shorter_than_a_junction_are_not_joined) {
  // Both ends of the short one are within 1e-9 of the diagonal of one point.
  const std::vector<Curve> curves{open({0, 0, 1e12, 0}), open({1, 2, 2, 4})};
  const CurveResult result = untangled(curves);
  EXPECT_TRUE(result.report.joints.empty());
  EXPECT_EQ(result.curves[1].points, curves[1].points);
}

TEST(UntangleCurves, fixed_points_do_not_move) {
  std::vector<Curve> curves{circle(0, 0, 1, 60), circle(1.2, 0, 1, 60)};
  curves[0].fixed.assign(60, 1);
  const CurveResult result = untangled(curves);
  EXPECT_EQ(result.curves[0].points, curves[0].points);
  EXPECT_NE(result.curves[1].points, curves[1].points);

  std::vector<Curve> waves{open({0, 0, 1, 1, 2, 1, 3, 1, 4, 0}), open({0, 1, 1, 0.8, 2, 0.8, 3, 0.8, 4, 1})};
  const CurveResult held = untangled(waves, {.fix_ends = true});
  for (std::size_t c = 0; c < 2; ++c)
    for (const std::size_t k : {0, 1}) {
      EXPECT_EQ(held.curves[c].points[k], waves[c].points[k]);
      EXPECT_EQ(held.curves[c].points[held.curves[c].points.size() - 2 + k], waves[c].points[8 + k]);
    }
}

TEST(UntangleCurves, fixed_curves_that_cross_are_an_obstruction_and_the_rest_is_repaired) {
  std::vector<Curve> curves{open({0, 0, 10, 10}), open({0, 10, 10, 0}), figure_eight(100)};
  curves[0].fixed.assign(2, 1);
  curves[1].fixed.assign(2, 1);
  for (std::size_t k = 0; k < curves[2].points.size(); k += 2) curves[2].points[k] += 20;
  const CurveResult result = untangle_curves(curves);
  EXPECT_EQ(result.status, Status::obstructed);
  ASSERT_EQ(result.report.fixed.size(), 1U);
  EXPECT_EQ(result.report.fixed[0], (CurveCrossing{0, 0, 1, 0}));
  EXPECT_EQ(result.report.left, result.report.fixed);
  EXPECT_EQ(oracle::count_crossings(result.curves, {}), 1U);
}

TEST(UntangleCurves, what_cannot_be_resolved_is_not_made_worse) {
  // Both ends of both fixed: the way around an end is not taken.
  const std::vector<Curve> curves{open({0, 0, 10, 10}), open({0, 10, 4, 6, 6, 4, 10, 0})};
  const CurveResult result = untangle_curves(curves, {.fix_ends = true});
  EXPECT_EQ(result.status, Status::no_progress);
  EXPECT_LE(result.report.crossings_after, result.report.crossings_before);
}

TEST(UntangleCurves, is_the_same_on_every_run_and_in_every_place) {
  const Curve star = random_closed_curve("star", 4, 500);
  const CurveResult once = untangled({star}), twice = untangled({star});
  EXPECT_EQ(once.curves[0].points, twice.curves[0].points);
  // By powers of two, so that no digit is lost.
  Curve large = star;
  for (double& c : large.points) c *= 1024;
  const CurveResult scaled = untangled({large});
  EXPECT_EQ(scaled.report.turned_points, once.report.turned_points);
  EXPECT_NEAR(scaled.report.displacement_mean_rel, once.report.displacement_mean_rel, 1e-6);
}

TEST(UntangleCurves, opened_crossings_keep_a_gap) {
  const CurveResult result = untangled({figure_eight(400)}, {.gap_rel = 0.01});
  const CurveNet net = make_net(result.curves, {}, false);
  double narrowest = std::numeric_limits<double>::infinity();
  const Index n = net.vertex_count();
  for (Index v = 0; v < n; ++v)
    for (Index w = 0; w < v; ++w)
      if (std::min(v - w, n - v + w) > 40) narrowest = std::min(narrowest, (net.rest.col(v) - net.rest.col(w)).norm());
  EXPECT_GT(narrowest, 0.005 * result.report.diagonal);
}

TEST(UntangleCurves, can_be_cancelled_and_limited) {
  Context context;
  context.cancel();
  const std::vector<Curve> curves{random_closed_curve("noise", 1, 2000)};
  const CurveResult cancelled = untangle_curves(curves, {}, &context);
  EXPECT_EQ(cancelled.status, Status::cancelled);
  const CurveResult limited = untangle_curves(curves, {.time_limit_s = 1e-9});
  EXPECT_EQ(limited.status, Status::time_limit);
  EXPECT_LE(limited.report.crossings_after, limited.report.crossings_before);
}

TEST(UntangleCurves, progress_never_goes_back) {
  Context context;
  double last = -1;
  context.on_progress = [&](const Context::Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
  };
  untangle_curves(std::vector<Curve>{random_closed_curve("walk", 2, 900)}, {}, &context);
  EXPECT_GE(last, 0);
}

std::string refusal(const std::vector<Curve>& curves, const CurveOptions& options = {}) {
  try {
    untangle_curves(curves, options);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(UntangleCurves, refuses_what_makes_no_sense_and_names_the_place) {
  const auto says = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(says(refusal({open({0, 0, 1, 1}), open({0, 0, 1, 1, 1, 1})}), "curve 1: points 1 and 2 are equal"));
  EXPECT_TRUE(says(refusal({closed({0, 0, 1, 1, 2, 0, 0, 0})}), "does not repeat its first point"));
  EXPECT_TRUE(says(refusal({open({0, 0, 1, std::numeric_limits<double>::infinity()})}), "coordinate of point 1"));
  EXPECT_TRUE(says(refusal({open({0, 0})}), "has 1 points"));
  EXPECT_TRUE(says(refusal({open({0, 0, 1})}), "has 3 coordinates"));
  Curve flags = open({0, 0, 1, 1});
  flags.fixed = {1};
  flags.name = "the border";
  EXPECT_TRUE(says(refusal({flags}), "the border has 2 points, but 1 flags"));
  EXPECT_TRUE(says(refusal({open({0, 0, 1, 1})}, {.gap_rel = 0}), "gap_rel"));
}

TEST(RandomClosedCurve, is_the_same_for_a_seed_and_refuses_others) {
  EXPECT_EQ(random_closed_curve("walk", 3, 100).points, random_closed_curve("walk", 3, 100).points);
  EXPECT_NE(random_closed_curve("walk", 3, 100).points, random_closed_curve("walk", 4, 100).points);
  EXPECT_THROW(random_closed_curve("knot", 3, 100), std::invalid_argument);
  EXPECT_THROW(random_closed_curve("walk", 3, 2), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
