#include "energy/arap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <random>

#include "energy/uniform.h"

namespace unsnarl {
namespace {

struct Grid {
  std::vector<Triangle> triangles;
  Positions rest;
};

// A bumpy grid of n x n vertices.
Grid make_grid(Index n, std::mt19937& generator) {
  Grid grid;
  grid.rest.resize(3, n * n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) grid.rest.col(i * n + j) = Vec3(i, j, 0.3 * uniform(generator));
  }
  for (Index i = 0; i + 1 < n; ++i) {
    for (Index j = 0; j + 1 < n; ++j) {
      grid.triangles.push_back({i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1});
      grid.triangles.push_back({i * n + j, (i + 1) * n + j + 1, i * n + j + 1});
    }
  }
  return grid;
}

Positions shaken(const Positions& x, double by, std::mt19937& generator) {
  Positions result = x;
  for (Index i = 0; i < x.cols(); ++i) {
    for (int axis = 0; axis < 3; ++axis) result(axis, i) += by * uniform(generator);
  }
  return result;
}

double value_of(Arap& energy, const Positions& x) {
  Positions unused = Positions::Zero(3, x.cols());
  return energy.value_and_gradient(x, unused);
}

TEST(ClosestRotation, agrees_with_the_singular_value_decomposition) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 2000; ++trial) {
    Eigen::Matrix3d s;
    for (int i = 0; i < 9; ++i) s(i) = uniform(generator);
    if (trial % 4 == 1) s.col(2) = s.col(0) + s.col(1);                       // flat stars: rank 2
    if (trial % 4 == 2) s = s * Eigen::Vector3d(1, 1e-3, 1e-6).asDiagonal();  // slivers
    if (trial % 4 == 3) s *= 1e-9;
    const Eigen::Matrix3d r = closest_rotation(s);
    EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Vector3d sigma = svd.singularValues();
    EXPECT_NEAR((r.transpose() * s).trace() / s.norm(), (sigma[0] + sigma[1] + sign * sigma[2]) / s.norm(), 1e-11);
  }
}

TEST(ClosestRotation, degenerate_input_still_gives_a_rotation) {
  for (const Eigen::Matrix3d& s :
       {Eigen::Matrix3d(Eigen::Matrix3d::Zero()), Eigen::Matrix3d(Vec3(1, 2, 3) * Vec3(3, -1, 1).transpose()),
        Eigen::Matrix3d(-Eigen::Matrix3d::Identity())}) {
    const Eigen::Matrix3d r = closest_rotation(s);
    EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1, 1e-12);
  }
}

TEST(Arap, rigid_motions_cost_nothing) {
  std::mt19937 generator(2);
  const Grid grid = make_grid(5, generator);
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  const Positions moved = (r * grid.rest).colwise() + Vec3(4, -5, 6);
  Arap energy(grid.triangles, grid.rest, 25);
  Positions gradient = Positions::Zero(3, 25);
  EXPECT_NEAR(energy.value_and_gradient(moved, gradient), 0, 1e-20);
  EXPECT_NEAR(gradient.norm(), 0, 1e-10);
  EXPECT_NEAR((energy.rotation(7) - r).norm(), 0, 1e-10);
}

TEST(Arap, gradient_matches_finite_differences) {
  std::mt19937 generator(3);
  const Grid grid = make_grid(5, generator);
  for (const Index free_count : {25, 15}) {
    Arap energy(grid.triangles, grid.rest, free_count);
    const Positions x = shaken(grid.rest, 0.4, generator);
    Positions gradient = Positions::Zero(3, 25);
    energy.value_and_gradient(x, gradient, 3);
    for (Index i = 0; i < 25; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        Positions up = x, down = x;
        up(axis, i) += 1e-6;
        down(axis, i) -= 1e-6;
        EXPECT_NEAR(3 * (value_of(energy, up) - value_of(energy, down)) / 2e-6, gradient(axis, i), 1e-6);
      }
    }
  }
}

TEST(Arap, scales_as_length_squared) {
  std::mt19937 generator(4);
  const Grid grid = make_grid(5, generator);
  const Positions x = shaken(grid.rest, 0.4, generator);
  Arap energy(grid.triangles, grid.rest, 25), scaled(grid.triangles, 8 * grid.rest, 25);
  EXPECT_NEAR(value_of(scaled, 8 * x), 64 * value_of(energy, x), 1e-9);
}

TEST(Arap, fixed_surroundings_do_not_turn) {
  std::mt19937 generator(5);
  const Grid grid = make_grid(4, generator);
  Arap energy(grid.triangles, grid.rest, 8);
  value_of(energy, shaken(grid.rest, 0.5, generator));
  for (Index i = 8; i < 16; ++i) EXPECT_TRUE(energy.rotation(i).isIdentity(0));
}

}  // namespace
}  // namespace unsnarl
