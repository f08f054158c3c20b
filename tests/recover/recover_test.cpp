#include "recover/recover.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <random>

#include "contact/contact_candidates.h"
#include "contact/intersection_finder.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// A triangulated grid of n x n vertices per sheet, border fixed, all else free; positions are set by the caller.
struct Sheets {
  int n;
  Patch patch;
  std::vector<Index> slot;  // (sheet, i, j) -> vertex

  Sheets(int size, int sheets) : n(size) {
    std::vector<int> order;
    for (const bool border : {false, true}) {
      for (int k = 0; k < sheets * n * n; ++k) {
        const int i = k / n % n, j = k % n;
        if ((i == 0 || j == 0 || i == n - 1 || j == n - 1) == border) order.push_back(k);
      }
      if (!border) patch.free_count = static_cast<Index>(order.size());
    }
    slot.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) slot[order[k]] = static_cast<Index>(k);
    std::vector<Triangle> obstacles;
    for (int s = 0; s < sheets; ++s) {
      for (int i = 0; i + 1 < n; ++i) {
        for (int j = 0; j + 1 < n; ++j) {
          add({at(s, i, j), at(s, i + 1, j), at(s, i + 1, j + 1)}, obstacles);
          add({at(s, i, j), at(s, i + 1, j + 1), at(s, i, j + 1)}, obstacles);
        }
      }
    }
    patch.active_count = static_cast<Index>(patch.triangles.size());
    patch.triangles.insert(patch.triangles.end(), obstacles.begin(), obstacles.end());
    patch.edge_length = 1;
    patch.rest.resize(3, static_cast<Index>(slot.size()));
    patch.x.resize(3, static_cast<Index>(slot.size()));
  }
  Index at(int s, int i, int j) const { return slot[(s * n + i) * n + j]; }
  void add(const Triangle& t, std::vector<Triangle>& obstacles) {
    const bool active = t[0] < patch.free_count || t[1] < patch.free_count || t[2] < patch.free_count;
    (active ? patch.triangles : obstacles).push_back(t);
  }
};

/// Two sheets whose bumps run through each other by `depth` at rest and lie `gap` apart at the start.
Patch crossing_bumps(int n, double depth, double gap) {
  Sheets sheets(n, 2);
  for (int s = 0; s < 2; ++s) {
    const double side = s ? -1 : 1;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double cx = i - 0.5 * (n - 1), cy = j - 0.5 * (n - 1);
        const Index v = sheets.at(s, i, j);
        const double bump = v < sheets.patch.free_count ? std::exp(-(cx * cx + cy * cy) / 4) : 0;
        const Vec3 base(i + (s ? 0.31 : 0), j + (s ? 0.17 : 0), -side);
        sheets.patch.rest.col(v) = base + Vec3(0, 0, side * (1 + 0.5 * depth) * bump);
        sheets.patch.x.col(v) = base + Vec3(0, 0, side * (1 - 0.5 * gap) * bump);
      }
    }
  }
  return sheets.patch;
}

/// A flat sheet whose rest shape is crumpled by seeded noise: neighbours fold over each other there.
Patch crumpled_sheet(int n, double noise, std::uint64_t seed) {
  Sheets sheets(n, 1);
  std::mt19937_64 engine(seed);
  const auto random = [&] { return noise * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sheets.patch.x.col(sheets.at(0, i, j)) = Vec3(i, j, 0);
  sheets.patch.rest = sheets.patch.x;
  for (Index v = 0; v < sheets.patch.free_count; ++v) sheets.patch.rest.col(v) += Vec3(random(), random(), random());
  return sheets.patch;
}

/// Three sheets 1e-9 apart within their fixed borders, crumpled at rest, every second vertex 1e-9 away from an opposite
/// edge of its star: needles that are hemmed in from all sides.
Patch needles_between_sheets(int n, std::uint64_t seed) {
  constexpr double tiny = 1e-9;
  Sheets sheets(n, 3);
  std::mt19937_64 engine(seed);
  const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Index v = sheets.at(s, i, j);
        const bool is_free = v < sheets.patch.free_count;
        sheets.patch.rest.col(v) = sheets.patch.x.col(v) = Vec3(i, j, s * (is_free ? tiny : 0.1));
        if (!is_free) continue;
        sheets.patch.rest.col(v) += 0.6 * Vec3(random(), random(), random());
        if (i % 2 != 0 || j % 2 != 0) continue;
        const bool right = random() > -0.5;  // the two edges that cross its squares
        sheets.patch.x.col(v).head(2) += (0.5 - tiny) * Eigen::Vector2d(right ? 1 : -1, right ? -1 : 1);
      }
  return sheets.patch;
}

std::size_t intersections(const Patch& patch, const Positions& x) {
  IntersectionFinder finder(patch.triangles, patch.active_count);
  return finder.find(x).size();
}

/// Least distance between primitives of triangles that share no vertex, by brute force over all stencils.
double gap_of(const Patch& patch, double radius) {
  ContactCandidates candidates(patch.triangles, static_cast<Index>(patch.x.cols()));
  std::vector<std::uint8_t> moves(static_cast<std::size_t>(patch.x.cols()), 0);
  std::fill(moves.begin(), moves.begin() + patch.free_count, std::uint8_t{1});
  std::vector<NearStencil> stencils;
  MotionBounds standing;
  standing.reset(static_cast<Index>(patch.x.cols()));
  candidates.gather(patch.x, std::vector<double>(moves.size(), radius), standing, moves, stencils);
  double gap = radius;
  for (const NearStencil& s : stencils) {
    if (!candidates.are_neighbours(s.stencil)) gap = std::min(gap, s.distance);
  }
  return gap;
}

double rms_to_rest(const Patch& patch, const Positions& x) {
  return std::sqrt((x - patch.rest).leftCols(patch.free_count).squaredNorm() / patch.free_count);
}

int flipped_faces(const Patch& patch) {
  int flipped = 0;
  for (Index k = 0; k < patch.active_count; ++k) {
    const Triangle& t = patch.triangles[k];
    const auto normal = [&](const Positions& x) {
      return Vec3(Vec3(x.col(t[1]) - x.col(t[0])).cross(Vec3(x.col(t[2]) - x.col(t[0]))));
    };
    flipped += normal(patch.rest).dot(normal(patch.x)) < 0;
  }
  return flipped;
}

RecoverOptions with_gap(double gap) {
  RecoverOptions options;
  options.min_gap = gap;
  return options;
}

TEST(Recover, crossing_sheets_end_against_each_other) {
  for (double start_gap : {1e-3, 1e-12, 1e-17}) {
    Patch patch = crossing_bumps(14, 0.4, start_gap);
    ASSERT_GT(intersections(patch, patch.rest), 0u);
    if (intersections(patch, patch.x) > 0) continue;  // 1e-17 cannot be written everywhere
    const Positions start = patch.x;
    const RecoverResult result = recover(patch, with_gap(1e-4));
    EXPECT_EQ(intersections(patch, patch.x), 0u);
    EXPECT_GE(gap_of(patch, 1), 1e-4);
    EXPECT_GE(result.min_gap, 1e-4);
    EXPECT_EQ(result.closed, 0);
    EXPECT_TRUE(result.moved);
    EXPECT_LT(rms_to_rest(patch, patch.x), 0.5 * rms_to_rest(patch, start));
    EXPECT_EQ(flipped_faces(patch), 0);
    // Vertices far from the contact are at rest to the last bit; fixed ones never moved.
    Index at_rest_count = 0;
    for (Index v = 0; v < patch.free_count; ++v) {
      const bool at_rest = patch.x.col(v) == patch.rest.col(v);
      at_rest_count += at_rest;
      if ((patch.rest.col(v).head<2>() - Eigen::Vector2d(6.5, 6.5)).norm() > 5) {
        EXPECT_TRUE(at_rest);
      }
    }
    EXPECT_EQ(at_rest_count, result.at_rest);
    EXPECT_GT(at_rest_count, patch.free_count * 8 / 10);
    for (Index v = patch.free_count; v < patch.x.cols(); ++v) EXPECT_EQ(patch.x.col(v), start.col(v));
  }
}

// Round-off hides a gap here, which is not opened first, so that no step can be told from a collision. All else returns
// to rest. (It did on these sheets before such vertices were held, too; on bodies of 428k faces it did not.)
TEST(Recover, touching_faces_hold_up_nothing_else) {
  Sheets sheets(20, 2);
  Patch& patch = sheets.patch;
  const auto along = [](double x, double y) { return Vec3(x, y, 0.31 * x + 0.57 * y); };
  for (int s = 0; s < 2; ++s)
    for (int i = 0; i < sheets.n; ++i)
      for (int j = 0; j < sheets.n; ++j)
        patch.rest.col(sheets.at(s, i, j)) = s ? Vec3(along(i + 0.31, j + 0.17) + Vec3(0, 0, 1.3)) : along(i, j);
  patch.x = patch.rest;
  for (int i = 2; i < 8; ++i)
    for (int j = 2; j < 8; ++j) patch.x.col(sheets.at(0, i, j)) += along(0.2, 0.1);
  for (int i = 3; i < 5; ++i)
    for (int j = 3; j < 5; ++j) {
      const Index v = sheets.at(1, i, j);
      double below = patch.x(2, v) - 1.4, above = patch.x(2, v);
      for (double middle; (middle = 0.5 * (below + above)) > below && middle < above;) {
        patch.x(2, v) = middle;
        (intersections(patch, patch.x) > 0 ? below : above) = middle;
      }
      patch.x(2, v) = patch.rest(2, v) = above;
    }
  for (int i = 12; i < 16; ++i)
    for (int j = 12; j < 16; ++j) patch.x(2, sheets.at(1, i, j)) += 0.7;
  ASSERT_EQ(intersections(patch, patch.x), 0u);
  RecoverOptions options = with_gap(1e-4);
  options.open_rounds = 0;
  recover(patch, options);
  EXPECT_EQ(intersections(patch, patch.x), 0u);
  for (int i = 10; i < 18; ++i)
    for (int j = 10; j < 18; ++j)
      EXPECT_LT((patch.x - patch.rest).col(sheets.at(1, i, j)).norm(), 1e-3) << i << ' ' << j;
}

TEST(Recover, a_gap_near_the_wanted_one_is_kept) {
  // The final activation distance is forced down to the wanted gap: contacts end between one and two gaps apart, and
  // lists gathered there must not allow for less.
  Patch patch = crossing_bumps(12, 0.8, 0.1);
  RecoverOptions options = with_gap(0.02);
  options.least_gaps = 1.5;
  recover(patch, options);
  recover(patch, options);
  EXPECT_GE(gap_of(patch, 1), 0.02);
  EXPECT_LT(gap_of(patch, 1), 0.04);
}

TEST(Recover, embedded_rest_is_reached_exactly) {
  Patch patch = crossing_bumps(12, -0.5, 0.9);
  ASSERT_EQ(intersections(patch, patch.rest), 0u);
  const RecoverResult result = recover(patch, with_gap(1e-5));
  EXPECT_EQ(patch.x, patch.rest);
  EXPECT_EQ(result.at_rest, patch.free_count);
}

/// A strip of four free faces, at rest at the origin; at the start elsewhere and rotated.
Patch strip_away(const Vec3& shift, double angle) {
  Patch patch;
  patch.free_count = 6;
  patch.active_count = 4;
  patch.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  patch.rest.resize(3, 6);
  patch.rest << 0, 0.1, 1, 1.1, 2, 2.1,  //
      0, 1, 0, 1, 0, 1,                  //
      0, 0, 0.2, 0.2, 0.1, 0.3;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  patch.x = (turn * patch.rest).colwise() + shift;
  patch.edge_length = 1;
  return patch;
}

/// Adds a fixed triangle.
void add_obstacle(Patch& patch, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Index n = static_cast<Index>(patch.x.cols());
  for (Positions* x : {&patch.x, &patch.rest}) {
    x->conservativeResize(3, n + 3);
    x->rightCols(3) << a, b, c;
  }
  patch.triangles.push_back({n, n + 1, n + 2});
}

TEST(Recover, a_part_far_away_with_a_free_path_returns_to_its_place) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    Patch patch = strip_away(Vec3(120, -150, 60), angle);  // 201 edge lengths
    const RecoverResult result = recover(patch, with_gap(1e-5));
    EXPECT_EQ(patch.x, patch.rest) << angle;
    EXPECT_EQ(result.at_rest, 6);
  }
}

TEST(Recover, a_part_far_away_comes_as_near_as_what_is_in_its_place_allows) {
  Patch patch = strip_away(Vec3(0, 0, 200), 0.4);
  add_obstacle(patch, Vec3(-9, -9, 0.15), Vec3(9, -9, 0.15), Vec3(0, 9, 0.15));
  ASSERT_GT(intersections(patch, patch.rest), 0u);
  recover(patch, with_gap(1e-5));
  EXPECT_EQ(intersections(patch, patch.x), 0u);
  EXPECT_LT(rms_to_rest(patch, patch.x), 0.4);
}

// One vertex that wants to go far does not shorten the steps of a part that hangs nowhere together with it.
TEST(Recover, a_far_part_does_not_hold_up_another) {
  Patch patch = strip_away(Vec3(0, 0, 200), 0.4);
  const Patch near = strip_away(Vec3(0, 0, 3), 0.2);
  const Vec3 apart(50, 0, 0);
  Patch both;
  both.free_count = 12;
  both.active_count = 8;
  both.edge_length = 1;
  both.triangles = patch.triangles;
  for (const Triangle& t : near.triangles) both.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  both.rest.resize(3, 12);
  both.x.resize(3, 12);
  both.rest << patch.rest, near.rest.colwise() + apart;
  both.x << patch.x, near.x.colwise() + apart;
  add_obstacle(both, Vec3(-9, -9, 0.15), Vec3(9, -9, 0.15), Vec3(0, 9, 0.15));
  recover(both, with_gap(1e-5));
  EXPECT_EQ(both.x.middleCols(6, 6), both.rest.middleCols(6, 6));
}

TEST(Recover, nothing_to_do) {
  Patch patch = crossing_bumps(8, -0.5, 0.9);
  patch.x = patch.rest;
  const RecoverResult result = recover(patch, with_gap(1e-5));
  EXPECT_FALSE(result.moved);
  EXPECT_EQ(patch.x, patch.rest);
  Patch empty;
  EXPECT_FALSE(recover(empty).moved);
}

TEST(Recover, neighbours_do_not_fold_through_each_other) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Patch patch = crumpled_sheet(12, 0.8, seed);
    ASSERT_GT(intersections(patch, patch.rest), 0u);
    const Positions start = patch.x;
    const RecoverResult result = recover(patch, with_gap(1e-5));
    EXPECT_EQ(intersections(patch, patch.x), 0u) << "seed " << seed;
    EXPECT_GE(gap_of(patch, 1), 1e-5);
    EXPECT_LT(rms_to_rest(patch, patch.x), 0.5 * rms_to_rest(patch, start));
    EXPECT_GT(result.at_rest, 0);
  }
}

TEST(Recover, folded_neighbour_opens_no_farther_than_it_must) {
  // One corner folded flat over the next face at rest, at the start bent up.
  Sheets sheets(4, 1);
  Patch& patch = sheets.patch;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) patch.x.col(sheets.at(0, i, j)) = Vec3(i, j, 0);
  patch.rest = patch.x;
  patch.rest.col(sheets.at(0, 1, 1)) = Vec3(2.25, 1.75, 0);  // across the diagonal (1, 1)-(2, 2), (2, 1) and beyond
  ASSERT_GT(intersections(patch, patch.rest), 0u);
  const double before = rms_to_rest(patch, patch.x);
  recover(patch, with_gap(1e-5));
  EXPECT_EQ(intersections(patch, patch.x), 0u);
  EXPECT_LT(rms_to_rest(patch, patch.x), before);
}

TEST(Recover, obstacles_stand_still) {
  // Only the lower sheet is free; the upper one is an obstacle whose bump it must stay under.
  Patch both = crossing_bumps(12, 1.2, 1e-12);
  Patch patch;
  {
    // Vertices of the lower sheet are those at integer x.
    std::vector<Index> order, fixed;
    for (Index v = 0; v < both.x.cols(); ++v) {
      const bool is_lower = both.x(0, v) == std::round(both.x(0, v));
      (is_lower && v < both.free_count ? order : fixed).push_back(v);
    }
    patch.free_count = static_cast<Index>(order.size());
    order.insert(order.end(), fixed.begin(), fixed.end());
    std::vector<Index> slot(order.size());
    patch.x.resize(3, both.x.cols());
    patch.rest.resize(3, both.x.cols());
    for (Index k = 0; k < both.x.cols(); ++k) {
      slot[order[k]] = k;
      patch.x.col(k) = both.x.col(order[k]);
      patch.rest.col(k) = k < patch.free_count ? both.rest.col(order[k]) : both.x.col(order[k]);
    }
    std::vector<Triangle> obstacles;
    for (const Triangle& t : both.triangles) {
      const Triangle f = {slot[t[0]], slot[t[1]], slot[t[2]]};
      const bool active = f[0] < patch.free_count || f[1] < patch.free_count || f[2] < patch.free_count;
      (active ? patch.triangles : obstacles).push_back(f);
    }
    patch.active_count = static_cast<Index>(patch.triangles.size());
    patch.triangles.insert(patch.triangles.end(), obstacles.begin(), obstacles.end());
    patch.edge_length = 1;
  }
  ASSERT_GT(intersections(patch, patch.rest), 0u);
  ASSERT_EQ(intersections(patch, patch.x), 0u);
  const Positions start = patch.x;
  const RecoverResult result = recover(patch, with_gap(1e-4));
  EXPECT_EQ(intersections(patch, patch.x), 0u);
  EXPECT_GE(gap_of(patch, 1), 1e-4);
  EXPECT_LT(rms_to_rest(patch, patch.x), rms_to_rest(patch, start));
  EXPECT_GT(result.at_rest, patch.free_count / 2);
  EXPECT_EQ(patch.x.rightCols(patch.x.cols() - patch.free_count), start.rightCols(patch.x.cols() - patch.free_count));
}

TEST(Recover, two_runs_give_the_same_bytes) {
  for (int kind = 0; kind < 2; ++kind) {
    const Patch patch = kind ? crumpled_sheet(12, 0.8, 5) : crossing_bumps(12, 0.4, 1e-12);
    Patch first = patch, second = patch;
    recover(first, with_gap(1e-5));
    recover(second, with_gap(1e-5));
    EXPECT_EQ(std::memcmp(first.x.data(), second.x.data(), sizeof(double) * first.x.size()), 0);
  }
}

TEST(Recover, scale_changes_nothing) {
  // By a power of two, so that no rounding differs.
  const Patch patch = crossing_bumps(10, 0.4, 1e-3);
  Patch one = patch, big = patch;
  big.x *= 1024;
  big.rest *= 1024;
  big.edge_length *= 1024;
  recover(one, with_gap(1e-5));
  recover(big, with_gap(1024e-5));
  EXPECT_LT((1024 * one.x - big.x).cwiseAbs().maxCoeff(), 1e-6 * 1024);
}

TEST(Recover, the_caller_can_stop_it) {
  Patch patch = crossing_bumps(12, 0.4, 1e-12);
  int asked = 0;
  const RecoverResult result = recover(patch, with_gap(1e-5), [&] { return ++asked > 3; });
  EXPECT_TRUE(result.stopped);
  EXPECT_LE(result.iterations, 4);
  EXPECT_EQ(intersections(patch, patch.x), 0u);
}

TEST(Recover, stopped_at_once_it_does_not_open_gaps) {
  Patch patch = crossing_bumps(12, 0.4, 0);
  patch.x.row(2) *= 1e-6;  // flat sheets almost upon each other
  const Index fixed = static_cast<Index>(patch.x.cols()) - patch.free_count;
  patch.rest.rightCols(fixed) = patch.x.rightCols(fixed);
  Patch stopped = patch;
  recover(stopped, with_gap(1e-5), [] { return true; });
  for (Index v = 0; v < patch.free_count; ++v)
    EXPECT_TRUE(stopped.x.col(v) == patch.x.col(v) || stopped.x.col(v) == patch.rest.col(v)) << v;
}

TEST(Recover, stops_within_a_step) {
  // So many looks at the clock, and where they end it: all leave an embedded state that was reached.
  Patch reference = crossing_bumps(12, 0.5, 0.05);
  int looks = 0;
  recover(reference, {}, [&] { return ++looks < 0; });
  ASSERT_GT(looks, 10);
  for (int last = 0; last < looks; last += 1 + looks / 20) {
    SCOPED_TRACE(last);
    Patch patch = crossing_bumps(12, 0.5, 0.05);
    int asked = 0;
    const RecoverResult result = recover(patch, {}, [&] { return asked++ >= last; });
    EXPECT_TRUE(result.stopped);
    EXPECT_LE(asked, last + 20) << "it ends soon";
    EXPECT_TRUE(IntersectionFinder(patch.triangles, patch.active_count).find(patch.x).empty());
  }
}

TEST(Recover, pairs_that_cannot_be_parted_are_no_obstacle) {
  // A duplicate of a free face: an intersecting pair before and after, and no other.
  Patch patch = crossing_bumps(12, 0.4, 1e-12);
  patch.triangles.insert(patch.triangles.begin(), patch.triangles[0]);
  ++patch.active_count;
  const std::size_t before = intersections(patch, patch.x);
  ASSERT_EQ(before, 1u);
  const Positions start = patch.x;
  recover(patch, with_gap(1e-5));
  EXPECT_EQ(intersections(patch, patch.x), before);
  EXPECT_LT(rms_to_rest(patch, patch.x), 0.5 * rms_to_rest(patch, start));
}

TEST(Recover, the_papers_variant_ends_where_more_steps_hardly_move) {
  const Patch patch = crossing_bumps(8, 0.4, 1e-3);
  RecoverOptions paper = RecoverOptions::paper();
  paper.min_gap = 1e-5;
  Patch ended = patch, by_all_steps = patch;
  const RecoverResult fewer = recover(ended, paper);
  paper.stop_activation = 0;
  const RecoverResult all = recover(by_all_steps, paper);
  EXPECT_EQ(intersections(ended, ended.x), 0u);
  EXPECT_LT(rms_to_rest(ended, ended.x), 0.5 * rms_to_rest(patch, patch.x));
  EXPECT_LT(fewer.iterations, all.iterations);
  EXPECT_LE(all.iterations, 500);
  EXPECT_EQ(all.solver_iterations, 0);
  const double motion = (ended.x - by_all_steps.x).colwise().norm().maxCoeff();
  EXPECT_LT(motion, 0.1 * paper.activation * mean_edge_length(patch.rest, patch.triangles));
}

TEST(Recover, opens_needles_that_are_hemmed_in) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Patch patch = needles_between_sheets(9, seed);
    ASSERT_EQ(intersections(patch, patch.x), 0u);
    RecoverOptions options;
    options.min_gap = 1e-5;
    const RecoverResult result = recover(patch, options, {});
    EXPECT_EQ(intersections(patch, patch.x), 0u);
    EXPECT_EQ(result.closed, 0) << seed << " " << result.min_gap;
    EXPECT_GE(result.min_gap, 1e-5);
  }
}

}  // namespace
}  // namespace unsnarl
