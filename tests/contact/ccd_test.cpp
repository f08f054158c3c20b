#include "contact/ccd.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "contact/dice.h"

namespace unsnarl {
namespace {

using Four = std::array<Vec3, 4>;
const Vec3 zero = Vec3::Zero();

double distance_at(StencilKind kind, const Four& x, const Four& p, double t) {
  Four moved;
  for (int i = 0; i < 4; ++i) moved[i] = x[i] + t * p[i];
  return std::sqrt(squared_distance(kind, moved));
}

TEST(Ccd, vertex_falls_on_face) {
  const Four x = {Vec3(0.25, 0.25, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const Four p = {Vec3(0, 0, -2), zero, zero, zero};
  const double t = time_of_impact(StencilKind::vertex_face, x, p, 0);
  EXPECT_LT(t, 0.5);
  EXPECT_GT(t, 0.4);  // a slack of 0.1 keeps a tenth of the distance
  const double kept = time_of_impact(StencilKind::vertex_face, x, p, 0.5);
  EXPECT_LT(kept, 0.25);
  EXPECT_GT(kept, 0.2);
}

TEST(Ccd, no_impact_is_a_full_step) {
  const Four x = {Vec3(0.25, 0.25, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_EQ(time_of_impact(StencilKind::vertex_face, x, {Vec3(0, 0, 5), zero, zero, zero}, 0), 1);     // away
  EXPECT_EQ(time_of_impact(StencilKind::vertex_face, x, {Vec3(0, 0, -0.5), zero, zero, zero}, 0), 1);  // too short
  EXPECT_EQ(time_of_impact(StencilKind::vertex_face, x, {zero, zero, zero, zero}, 0), 1);              // at rest
  const Vec3 all(0, 0, -9);
  EXPECT_EQ(time_of_impact(StencilKind::vertex_face, x, {all, all, all, all}, 0), 1);  // together
}

TEST(Ccd, parallel_edges_meet) {
  const Four x = {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const Four p = {Vec3(0, 0, -1), Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 0, 1)};
  const double t = time_of_impact(StencilKind::edge_edge, x, p, 0);
  EXPECT_LT(t, 0.5);
  EXPECT_GT(t, 0.4);
}

TEST(Ccd, grazing_stops_before_the_contact) {
  // The vertex passes exactly through a corner of the face.
  const Four x = {Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, -1, 0)};
  const double t = time_of_impact(StencilKind::vertex_face, x, {Vec3(2, 0, 0), zero, zero, zero}, 0);
  EXPECT_LT(t, 0.5);
  EXPECT_GT(t, 0.3);
}

TEST(Ccd, sliding_is_not_held_up) {
  for (double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Four x = {Vec3(0.2, 0.2, gap), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const Four slides = {Vec3(0.25, 0.25, 0), zero, zero, zero};
    EXPECT_EQ(time_of_impact(StencilKind::vertex_face, x, slides, 0.5 * gap), 1) << gap;
    // While it nears the face too, it goes as far as that allows.
    const Four nears = {Vec3(0.25, 0.25, -2 * gap), zero, zero, zero};
    const double t = time_of_impact(StencilKind::vertex_face, x, nears, 0);
    EXPECT_NEAR(t, 0.45, 0.01) << gap;  // a slack of 0.1 keeps a tenth of the distance
  }
}

TEST(Ccd, round_off_gaps_never_close_nor_return_zero) {
  for (double gap : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const Four x = {Vec3(0.3, 0.3, gap), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const Four p = {Vec3(0.1, 0.1, -1), zero, zero, zero};
    const double t = time_of_impact(StencilKind::vertex_face, x, p, 0.5 * gap);
    EXPECT_GT(t, 0);
    EXPECT_LT(t, gap);
    EXPECT_GT(distance_at(StencilKind::vertex_face, x, p, t), 0.5 * gap);
  }
}

TEST(Ccd, broken_precondition_does_not_move) {
  const Four x = {Vec3(0.3, 0.3, 1e-3), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const double t = time_of_impact(StencilKind::vertex_face, x, {Vec3(0, 0, -1), zero, zero, zero}, 1e-2);
  EXPECT_GT(t, 0);
  EXPECT_LT(t, 1e-300);
}

// Integer motions that meet exactly at time 1/2: the positions there are chosen first, in contact by construction.
TEST(Ccd, never_misses_a_known_hit_on_tiny_integers) {
  Dice dice(7);
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const bool edges = trial % 2;
    Four half;
    if (edges) {
      // Both segments run through one lattice point (or end there).
      const Vec3 at = dice.lattice(2), u = dice.lattice(2), v = dice.lattice(2);
      half = {at - dice.integer(0, 2) * u, at + dice.integer(0, 2) * u, at - dice.integer(0, 2) * v,
              at + dice.integer(0, 2) * v};
    } else {
      // The vertex is an integer combination a + i u + j v of a face (a, a + n u, a + n v), i + j <= n.
      const Vec3 a = dice.lattice(2), u = dice.lattice(2), v = dice.lattice(2);
      const int n = dice.integer(1, 3), i = dice.integer(0, n), j = dice.integer(0, n - i);
      half = {a + i * u + j * v, a, a + n * u, a + n * v};
    }
    Four x, p;
    for (int k = 0; k < 4; ++k) {
      p[k] = 2 * dice.lattice(3);
      x[k] = half[k] - 0.5 * p[k];
    }
    const StencilKind kind = edges ? StencilKind::edge_edge : StencilKind::vertex_face;
    const double start = std::sqrt(squared_distance(kind, x));
    if (!(start > 0)) continue;
    ++hits;
    const double t = time_of_impact(kind, x, p, 0);
    ASSERT_GT(t, 0);
    ASSERT_LT(t, 0.5);
  }
  EXPECT_GT(hits, 15000);
}

TEST(Ccd, keeps_the_separation_all_the_way) {
  Dice dice(8);
  for (int trial = 0; trial < 600; ++trial) {
    Four x, p;
    for (int k = 0; k < 4; ++k) {
      x[k] = dice.vector();
      p[k] = 2 * dice.vector();
    }
    for (StencilKind kind : {StencilKind::vertex_face, StencilKind::edge_edge, StencilKind::vertex_edge}) {
      const double start = std::sqrt(squared_distance(kind, x));
      const double separation = trial % 2 ? 0 : dice.unit() * 0.9 * start;
      const double t = time_of_impact(kind, x, p, separation);
      ASSERT_GT(t, 0);
      ASSERT_LE(t, 1);
      for (int k = 0; k <= 100; ++k) ASSERT_GT(distance_at(kind, x, p, t * k / 100), separation * (1 - 1e-12));
      // And it is no excuse for standing still: a stop means that contact would have come before long.
      if (t < 1 && separation == 0) {
        EXPECT_LT(distance_at(kind, x, p, t), 0.5 * start);
      }
    }
  }
}

// A row of vertices above a fixed floor; some fall through, some do not.
struct Row {
  Positions x, p;
  std::vector<SeparatedStencil> stencils;
};
Row row_above_floor() {
  Row row;
  row.x.resize(3, 7);
  row.p = Positions::Zero(3, 7);
  row.x.col(0) = Vec3(-10, -10, 0);
  row.x.col(1) = Vec3(20, -10, 0);
  row.x.col(2) = Vec3(-10, 20, 0);
  for (int k = 3; k < 7; ++k) {
    row.x.col(k) = Vec3(k - 3, 0, 1);
    row.p.col(k) = Vec3(0, 0, k % 2 ? -2 : 0.5);
    row.stencils.push_back({{StencilKind::vertex_face, {static_cast<Index>(k), 0, 1, 2}}, 0.01});
  }
  return row;
}

TEST(Ccd, global_filter_obeys_the_first_impact) {
  const Row row = row_above_floor();
  const double t = largest_step(row.stencils, row.x, row.p);
  EXPECT_LT(t, 0.5);
  EXPECT_GT(t, 0.4);
  EXPECT_EQ(largest_step({}, row.x, row.p), 1);
}

TEST(Ccd, vertex_filter_shortens_only_what_collides) {
  Row row = row_above_floor();
  const Positions wanted = row.p;
  filter_displacements(row.stencils, row.x, row.p, OnCollision::shorten);
  for (int k = 3; k < 7; ++k) {
    if (k % 2) {
      EXPECT_GT(row.x(2, k) + row.p(2, k), 0.01);
      EXPECT_LT(row.x(2, k) + row.p(2, k), 0.3);
    } else {
      EXPECT_EQ(row.p.col(k), wanted.col(k));
    }
  }
}

TEST(Ccd, vertex_filter_can_make_them_stay) {
  Row row = row_above_floor();
  const Positions wanted = row.p;
  filter_displacements(row.stencils, row.x, row.p, OnCollision::stay);
  for (int k = 3; k < 7; ++k) {
    if (k % 2) {
      EXPECT_TRUE(row.p.col(k).isZero(0));
    } else {
      EXPECT_EQ(row.p.col(k), wanted.col(k));
    }
  }
}

TEST(Ccd, vertex_filter_leaves_no_collision) {
  Dice dice(9);
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 12;
    Row row;
    row.x.resize(3, n);
    row.p.resize(3, n);
    for (int k = 0; k < n; ++k) {
      row.x.col(k) = dice.vector();
      row.p.col(k) = dice.vector();
    }
    for (int k = 0; k < 60; ++k) {
      std::array<Index, 4> v;
      for (int i = 0; i < 4; ++i) {
        do {
          v[i] = dice.integer(0, n - 1);
        } while (std::find(v.begin(), v.begin() + i, v[i]) != v.begin() + i);
      }
      const Stencil s{k % 2 ? StencilKind::edge_edge : StencilKind::vertex_face, v};
      const double distance = std::sqrt(squared_distance(s, row.x));
      row.stencils.push_back({s, 0.5 * distance});
    }
    for (OnCollision how : {OnCollision::shorten, OnCollision::stay}) {
      Positions p = row.p;
      filter_displacements(row.stencils, row.x, p, how);
      EXPECT_EQ(largest_step(row.stencils, row.x, p), 1);
    }
  }
}

}  // namespace
}  // namespace unsnarl
