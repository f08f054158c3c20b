#include "energy/minkowski_penalty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "energy/uniform.h"

namespace unsnarl {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 random_point(std::mt19937& generator) {
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}
Corners random_triangle(std::mt19937& generator, double size = 1) {
  Corners t;
  for (Vec3& p : t) p = size * random_point(generator);
  return t;
}

// How far A must move along the unit vector n to lie on the far side of B.
double depth_along(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& n) {
  double lowest = 1e300, highest = -1e300;
  for (const Vec3& p : a) lowest = std::min(lowest, n.dot(p));
  for (const Vec3& p : b) highest = std::max(highest, n.dot(p));
  return highest - lowest;
}

// The least depth over all directions: a coarse sphere of them, then a pattern search around the best few.
double sampled_depth(std::span<const Vec3> a, std::span<const Vec3> b) {
  const int count = 4000;
  std::vector<std::pair<double, Vec3>> samples;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z), angle = i * 2.399963229728653;
    const Vec3 n(r * std::cos(angle), r * std::sin(angle), z);
    samples.emplace_back(depth_along(a, b, n), n);
  }
  std::sort(samples.begin(), samples.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  double best = samples[0].first;
  for (int s = 0; s < 20; ++s) {
    auto [depth, n] = samples[s];
    for (double step = 0.05; step > 1e-9; step *= 0.5) {
      for (bool improved = true; improved;) {
        improved = false;
        const Vec3 side = (std::abs(n[0]) < 0.6 ? Vec3::UnitX() : Vec3::UnitY()).cross(n).normalized();
        const Vec3 other = n.cross(side);
        for (int k = 0; k < 16; ++k) {
          const double angle = k * M_PI / 8;
          const Vec3 trial = (n + step * (std::cos(angle) * side + std::sin(angle) * other)).normalized();
          const double d = depth_along(a, b, trial);
          if (d < depth - 1e-12) depth = d, n = trial, improved = true;
        }
      }
    }
    best = std::min(best, depth);
  }
  return best;
}

TEST(TrianglePenetration, depth_is_the_least_over_all_directions) {
  std::mt19937 generator(1);
  int overlapping = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Corners a = random_triangle(generator), b = random_triangle(generator);
    const Penetration p = triangle_penetration(a, b, 0);
    if (p.depth <= 0) continue;
    ++overlapping;
    const double sampled = sampled_depth(a, b);
    EXPECT_LE(p.depth, sampled + 1e-9);
    EXPECT_NEAR(p.depth, sampled, 1e-5);
    EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
    EXPECT_NEAR(depth_along(a, b, p.normal), p.depth, 1e-12);
  }
  EXPECT_GT(overlapping, 5);
}

TEST(TrianglePenetration, separated_triangles_have_none) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Corners a = random_triangle(generator);
    Corners b = random_triangle(generator);
    for (Vec3& p : b) p += Vec3(3, 0, 0);
    EXPECT_LE(triangle_penetration(a, b, 0).depth, 0);
    EXPECT_LE(triangle_penetration(a, b, 0.5).depth, 0);
  }
}

TEST(TrianglePenetration, moving_by_the_depth_separates) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 300; ++trial) {
    Corners a = random_triangle(generator);
    const Corners b = random_triangle(generator);
    const Penetration p = triangle_penetration(a, b, 0);
    if (p.depth <= 0) continue;
    for (Vec3& q : a) q += p.depth * (1 + 1e-9) * p.normal;
    EXPECT_LE(triangle_penetration(a, b, 0).depth, 1e-12);
  }
}

void expect_gradient(const Corners& a, const Corners& b, double margin, double tolerance) {
  const Penetration p = triangle_penetration(a, b, margin);
  ASSERT_GT(p.depth, 0);
  EXPECT_NEAR(p.weight_a[0] + p.weight_a[1] + p.weight_a[2], 1, 1e-9);
  EXPECT_NEAR(p.weight_b[0] + p.weight_b[1] + p.weight_b[2], 1, 1e-9);
  const double step = 1e-7;
  for (int corner = 0; corner < 3; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool of_a : {true, false}) {
        const auto at = [&](double offset) {
          Corners a_moved = a, b_moved = b;
          (of_a ? a_moved : b_moved)[corner][axis] += offset;
          return triangle_penetration(a_moved, b_moved, margin).depth;
        };
        const double numeric = (at(step) - at(-step)) / (2 * step);
        const double analytic = of_a ? -p.normal[axis] * p.weight_a[corner] : p.normal[axis] * p.weight_b[corner];
        EXPECT_NEAR(numeric, analytic, tolerance);
      }
    }
  }
}

TEST(TrianglePenetration, gradient_matches_finite_differences) {
  std::mt19937 generator(4);
  int tested = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Corners a = random_triangle(generator), b = random_triangle(generator);
    if (triangle_penetration(a, b, 0).depth <= 1e-3) continue;
    ++tested;
    expect_gradient(a, b, 0, 1e-5);
  }
  EXPECT_GT(tested, 20);
}

TEST(TrianglePenetration, weights_are_inside_the_triangles_when_they_overlap) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 400; ++trial) {
    const Corners a = random_triangle(generator), b = random_triangle(generator);
    const Penetration p = triangle_penetration(a, b, 0);
    if (p.depth <= 1e-9) continue;
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(p.weight_a[k], -1e-7);
      EXPECT_GE(p.weight_b[k], -1e-7);
    }
  }
}

TEST(TrianglePenetration, scales_linearly_and_is_symmetric) {
  std::mt19937 generator(6);
  for (int trial = 0; trial < 100; ++trial) {
    Corners a = random_triangle(generator), b = random_triangle(generator);
    const Penetration p = triangle_penetration(a, b, 0), swapped = triangle_penetration(b, a, 0);
    if (p.depth <= 0) continue;
    EXPECT_NEAR(p.depth, swapped.depth, 1e-12);
    for (Vec3& q : a) q *= 8;
    for (Vec3& q : b) q *= 8;
    EXPECT_NEAR(triangle_penetration(a, b, 0).depth, 8 * p.depth, 1e-12);
  }
}

TEST(TrianglePenetration, coplanar_neighbours_side_by_side_are_no_contact) {
  const Corners a{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const Corners b{Vec3(1.5, 0, 0), Vec3(2.5, 0, 0), Vec3(1.5, 1, 0)};
  EXPECT_LE(triangle_penetration(a, b, 0.1).depth, 0);
  Corners c = b;
  for (Vec3& p : c) p[0] -= 0.45;  // 0.05 away: closer than the margin
  EXPECT_NEAR(triangle_penetration(a, c, 0.1).depth, 0.05, 1e-12);
  const Corners above{Vec3(0, 0, 0.03), Vec3(1, 0, 0.03), Vec3(0, 1, 0.03)};
  EXPECT_NEAR(triangle_penetration(a, above, 0.1).depth, 0.07, 1e-12);
}

TEST(TrianglePenetration, degenerate_triangles_are_segments) {
  const Corners needle{Vec3(0.25, 0.25, -1), Vec3(0.25, 0.25, 0.1), Vec3(0.25, 0.25, 0)};
  const Corners face{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const Penetration p = triangle_penetration(needle, face, 0);
  EXPECT_NEAR(p.depth, 0.1, 1e-12);
  EXPECT_NEAR(p.normal[2], -1, 1e-12);
  const Corners point{Vec3(5, 5, 5), Vec3(5, 5, 5), Vec3(5, 5, 5)};
  EXPECT_LE(triangle_penetration(point, point, 0).depth, 0);
}

TEST(PolygonPenetration, agrees_with_triangles_and_with_sampling) {
  std::mt19937 generator(7);
  for (int trial = 0; trial < 100; ++trial) {
    const Corners a = random_triangle(generator), b = random_triangle(generator);
    std::array<double, 3> wa{}, wb{};
    const PolygonPenetration p = polygon_penetration(a, b, 0.02, wa, wb);
    const Penetration q = triangle_penetration(a, b, 0.02);
    EXPECT_EQ(p.depth, q.depth);
    if (p.depth > 0) {
      EXPECT_EQ(wa, q.weight_a);
    }
  }
  const std::vector<Vec3> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  std::vector<Vec3> pentagon;
  for (int i = 0; i < 5; ++i) pentagon.emplace_back(0.3 * std::cos(1.2566 * i), 0.1, 0.2 + 0.3 * std::sin(1.2566 * i));
  std::vector<double> wa(4), wb(5);
  const PolygonPenetration p = polygon_penetration(square, pentagon, 0, wa, wb);
  EXPECT_NEAR(p.depth, sampled_depth(square, pentagon), 1e-5);
  Vec3 foot_a = Vec3::Zero(), foot_b = Vec3::Zero();
  for (int i = 0; i < 4; ++i) foot_a += wa[i] * square[i];
  for (int i = 0; i < 5; ++i) foot_b += wb[i] * pentagon[i];
  EXPECT_NEAR((foot_b - foot_a - p.depth * p.normal).norm(), 0, 1e-12);
}

void expect_energy_gradient(MinkowskiPenalty& energy, const Positions& x, double tolerance) {
  Positions gradient = Positions::Zero(3, x.cols());
  const double value = energy.value_and_gradient(x, gradient, 2.5);
  EXPECT_GT(value, 0);
  for (Index i = 0; i < x.cols(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](double offset) {
        Positions moved = x, unused = Positions::Zero(3, x.cols());
        moved(axis, i) += offset;
        return energy.value_and_gradient(moved, unused, 2.5);
      };
      EXPECT_NEAR((at(1e-7) - at(-1e-7)) / 2e-7, gradient(axis, i), tolerance);
    }
  }
}

TEST(TrianglePenetration, hints_change_nothing_but_the_cost) {
  std::mt19937 generator(9);
  for (int trial = 0; trial < 500; ++trial) {
    const Corners a = random_triangle(generator), b = random_triangle(generator);
    const double margin = trial % 2 ? 0.1 : 0;
    const Penetration plain = triangle_penetration(a, b, margin);
    for (int start = 0; start < 256; start += 3) {
      std::uint8_t hint = static_cast<std::uint8_t>(start);
      const Penetration hinted = triangle_penetration(a, b, margin, &hint);
      ASSERT_EQ(hinted.depth > 0, plain.depth > 0);
      if (plain.depth <= 0) {
        continue;
      }
      ASSERT_EQ(hinted.depth, plain.depth);
      ASSERT_EQ(hinted.weight_a, plain.weight_a);
    }
  }
}

TEST(MinkowskiPenalty, one_vertex_pairs_have_the_right_gradient) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 0, 4}};
  std::mt19937 generator(8);
  int tested = 0;
  for (int trial = 0; trial < 400 && tested < 20; ++trial) {
    Positions x(3, 5);
    for (Index i = 0; i < 5; ++i) x.col(i) = random_point(generator);
    MinkowskiPenalty energy(triangles, {});
    energy.pairs = {{0, 1}};
    if (energy.evaluate(x, 0, 1).depth < 1e-2) continue;
    ++tested;
    expect_energy_gradient(energy, x, 1e-4);
  }
  EXPECT_EQ(tested, 20);
}

TEST(MinkowskiPenalty, folds_open) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
  Positions x(3, 4);
  x.col(0) = Vec3(0, 0, 0);
  x.col(1) = Vec3(1, 0, 0);
  x.col(2) = Vec3(0.4, 1, 0);
  x.col(3) = Vec3(0.5, 0.8, 0.01);
  MinkowskiOptions options;
  options.margin = 0.1;
  MinkowskiPenalty energy(triangles, options);
  energy.pairs = {{0, 1}};
  expect_energy_gradient(energy, x, 1e-6);
  x.col(3) = Vec3(0.5, 1.3, -0.02);  // the other apex is the lower one
  expect_energy_gradient(energy, x, 1e-6);
  x.col(3) = Vec3(0.5, 0.8, 0.2);  // open enough
  EXPECT_LE(energy.evaluate(x, 0, 1).depth, 0);
  x.col(3) = Vec3(0.5, -0.8, 0.0);  // unfolded
  EXPECT_LE(energy.evaluate(x, 0, 1).depth, 0);
  x.col(3) = Vec3(0.5, 0.8, 0.0);  // exactly flat: a definite side
  const Penetration flat = energy.evaluate(x, 0, 1);
  EXPECT_NEAR(flat.depth, 0.1, 1e-12);
  EXPECT_NEAR(std::abs(flat.normal[2]), 1, 1e-12);
}

TEST(MinkowskiPenalty, same_three_vertices_contribute_nothing) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 0}};
  Positions x(3, 3);
  x << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  MinkowskiOptions options;
  options.margin = 0.1;
  MinkowskiPenalty energy(triangles, options);
  energy.pairs = {{0, 1}};
  Positions gradient = Positions::Zero(3, 3);
  EXPECT_EQ(energy.value_and_gradient(x, gradient), 0);
  EXPECT_TRUE(gradient.isZero(0));
}

}  // namespace
}  // namespace unsnarl
