#include "contact/distances.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

#include "contact/dice.h"

namespace unsnarl {
namespace {

Positions columns(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Positions x(3, 4);
  x << a, b, c, d;
  return x;
}

/// Least distance over a grid of parameters: never below the true one.
double sampled_distance(StencilKind kind, const Positions& x, int n) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i) {
    const double s = static_cast<double>(i) / n;
    if (kind == StencilKind::vertex_edge) {
      best = std::min(best, (x.col(0) - (1 - s) * x.col(1) - s * x.col(2)).norm());
      continue;
    }
    for (int j = 0; j <= n; ++j) {
      const double t = static_cast<double>(j) / n;
      Vec3 difference;
      if (kind == StencilKind::edge_edge) {
        difference = (1 - s) * x.col(0) + s * x.col(1) - (1 - t) * x.col(2) - t * x.col(3);
      } else {
        if (i + j > n) break;
        difference = x.col(0) - (1 - s - t) * x.col(1) - s * x.col(2) - t * x.col(3);
      }
      best = std::min(best, difference.norm());
    }
  }
  return best;
}

const StencilKind kinds[] = {StencilKind::vertex_face, StencilKind::edge_edge, StencilKind::vertex_edge};

Stencil stencil_of(StencilKind kind) {
  return {kind, {0, 1, 2, kind == StencilKind::vertex_edge ? -1 : 3}};
}

void expect_consistent(const Stencil& stencil, const Positions& x) {
  const Closest c = closest(stencil, x);
  Vec3 difference = Vec3::Zero();
  double first = 0, second = 0;
  const int split = stencil.kind == StencilKind::edge_edge ? 2 : 1;
  for (int i = 0; i < stencil.size(); ++i) {
    difference += c.weights[i] * x.col(stencil.v[i]);
    (i < split ? first : second) += c.weights[i];
    if (i < split) {
      EXPECT_GE(c.weights[i], 0);
    } else {
      EXPECT_LE(c.weights[i], 0);
    }
  }
  const double size = x.cwiseAbs().maxCoeff() + 1e-300;
  EXPECT_NEAR(first, 1, 1e-12);
  EXPECT_NEAR(second, -1, 1e-12);
  EXPECT_NEAR(difference.norm(), c.distance, 1e-9 * size);
  if (c.distance > 1e-6 * size) {
    EXPECT_NEAR((difference / c.distance - c.direction).norm(), 0, 1e-6);
  }
  EXPECT_NEAR(std::sqrt(squared_distance(stencil, x)), c.distance, 1e-15 * size);
}

TEST(Distances, agree_with_sampling_in_generic_position) {
  Dice dice(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Positions x = columns(dice.vector(), dice.vector(), dice.vector(), dice.vector());
    for (StencilKind kind : kinds) {
      const double distance = closest(stencil_of(kind), x).distance;
      const double sampled = sampled_distance(kind, x, 60);
      EXPECT_LE(distance, sampled + 1e-12);
      EXPECT_GE(distance, sampled - 0.12);  // the grid's spacing
      expect_consistent(stencil_of(kind), x);
    }
  }
}

TEST(Distances, agree_with_sampling_on_tiny_lattices_where_degenerate_cases_rule) {
  Dice dice(2);
  for (int trial = 0; trial < 4000; ++trial) {
    const Positions x = columns(dice.lattice(1), dice.lattice(1), dice.lattice(1), dice.lattice(1));
    for (StencilKind kind : kinds) {
      const double distance = closest(stencil_of(kind), x).distance;
      const double sampled = sampled_distance(kind, x, 12);
      ASSERT_LE(distance, sampled + 1e-12) << x;
      ASSERT_GE(distance, sampled - 0.25) << x;
      expect_consistent(stencil_of(kind), x);
    }
  }
}

TEST(Distances, no_piece_of_a_boundary_is_nearer) {
  Dice dice(7);
  for (int trial = 0; trial < 20000; ++trial) {
    const Vec3 a = dice.vector(), b = dice.vector(), c = dice.vector();
    // Thin ones and nearly parallel ones too.
    const double thin = trial % 4 == 0 ? 1e-3 : 1;
    const Vec3 d = trial % 2 == 0 ? Vec3(c + (b - a) + thin * dice.vector()) : dice.vector();
    const double edges = closest_edge_edge(a, b, c, d).distance;
    const double least_edges = std::min({closest_vertex_edge(a, c, d).distance, closest_vertex_edge(b, c, d).distance,
                                         closest_vertex_edge(c, a, b).distance, closest_vertex_edge(d, a, b).distance});
    ASSERT_LE(edges, least_edges * (1 + 1e-12));
    const double face = closest_vertex_face(a, b, c, d).distance;
    const double least_face = std::min({closest_vertex_edge(a, b, c).distance, closest_vertex_edge(a, c, d).distance,
                                        closest_vertex_edge(a, d, b).distance});
    ASSERT_LE(face, least_face * (1 + 1e-12));
  }
}

TEST(Distances, known_places) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_DOUBLE_EQ(closest_vertex_face({0.25, 0.25, 0.5}, a, b, c).distance, 0.5);      // over the interior
  EXPECT_DOUBLE_EQ(closest_vertex_face({0.5, -2, 0}, a, b, c).distance, 2);             // beside an edge
  EXPECT_DOUBLE_EQ(closest_vertex_face({-3, -4, 0}, a, b, c).distance, 5);              // beside a corner
  EXPECT_DOUBLE_EQ(closest_vertex_face({0, 0, 7}, a, b, c).distance, 7);                // above a corner
  EXPECT_DOUBLE_EQ(closest_vertex_face({0.5, 0, 1}, a, b, c).distance, 1);              // above an edge
  EXPECT_EQ(closest_vertex_face({0.25, 0.25, 0}, a, b, c).distance, 0);                 // in it
  EXPECT_DOUBLE_EQ(closest_vertex_face({0.5, 2, 0}, a, b, Vec3(2, 0, 0)).distance, 2);  // a face without area
  EXPECT_DOUBLE_EQ(closest_vertex_face({3, 4, 0}, a, a, a).distance, 5);                // a face that is a point
  EXPECT_DOUBLE_EQ(closest_edge_edge(a, b, {0.5, -1, 3}, {0.5, 1, 3}).distance, 3);
  EXPECT_DOUBLE_EQ(closest_edge_edge(a, b, {0.25, 2, 0}, {3, 2, 0}).distance, 2);  // parallel, overlapping
  EXPECT_DOUBLE_EQ(closest_edge_edge(a, b, {4, 4, 0}, {9, 4, 0}).distance, 5);     // parallel, apart
  EXPECT_DOUBLE_EQ(closest_edge_edge(a, b, {3, 0, 0}, {4, 0, 0}).distance, 2);     // on one line
  EXPECT_EQ(closest_edge_edge(a, b, {0.5, -1, 0}, {0.5, 1, 0}).distance, 0);       // crossing
  EXPECT_DOUBLE_EQ(closest_edge_edge(a, a, {3, 4, 0}, {3, 4, 0}).distance, 5);     // two points
}

TEST(Distances, tiny_gaps_keep_their_digits_far_from_the_origin) {
  // A gap of 2^-40 above a face whose coordinates are about 1000.
  const Vec3 offset(1000, 1000, 1000);
  const double gap = 0x1p-40;
  const Vec3 p = Vec3(0.25, 0.25, gap) + offset;
  const double written = p[2] - 1000;
  EXPECT_DOUBLE_EQ(closest_vertex_face(p, offset, offset + Vec3(1, 0, 0), offset + Vec3(0, 1, 0)).distance, written);
}

TEST(Distances, gradient_is_weight_times_direction) {
  Dice dice(3);
  const double step = 1e-6;
  int checked = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // Half of the trials flat or near a boundary, where the closest point changes its kind.
    Positions x = columns(dice.vector(), dice.vector(), dice.vector(), dice.vector());
    if (trial % 2) x.row(2) *= 1e-3;
    for (StencilKind kind : kinds) {
      const Stencil stencil = stencil_of(kind);
      const Closest c = closest(stencil, x);
      if (c.distance < 1e-2) continue;
      for (int i = 0; i < stencil.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          Positions plus = x, minus = x;
          plus(axis, i) += step;
          minus(axis, i) -= step;
          const double difference = (closest(stencil, plus).distance - closest(stencil, minus).distance) / (2 * step);
          ASSERT_NEAR(c.weights[i] * c.direction[axis], difference, 2e-3) << "kind " << static_cast<int>(kind);
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST(Distances, relabelling_and_rigid_motion_change_nothing) {
  Dice dice(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 a = dice.vector(), b = dice.vector(), c = dice.vector(), d = dice.vector();
    const double face = closest_vertex_face(a, b, c, d).distance;
    EXPECT_NEAR(closest_vertex_face(a, c, d, b).distance, face, 1e-13);
    EXPECT_NEAR(closest_vertex_face(a, d, c, b).distance, face, 1e-13);
    const double edge = closest_edge_edge(a, b, c, d).distance;
    EXPECT_NEAR(closest_edge_edge(d, c, b, a).distance, edge, 1e-13);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, dice.vector().normalized()).toRotationMatrix();
    const Vec3 shift = dice.vector();
    const auto moved = [&](const Vec3& p) { return Vec3(turn * p + shift); };
    EXPECT_NEAR(closest_vertex_face(moved(a), moved(b), moved(c), moved(d)).distance, face, 1e-13);
    EXPECT_NEAR(closest_edge_edge(moved(a), moved(b), moved(c), moved(d)).distance, edge, 1e-13);
  }
}

}  // namespace
}  // namespace unsnarl
