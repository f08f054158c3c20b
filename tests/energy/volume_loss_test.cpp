#include "energy/volume_loss.h"

#include <gtest/gtest.h>

#include "energy/energy_checks.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

// A regular tetrahedron and a smaller one elsewhere, normals outward.
const std::vector<Triangle> large_one = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
const std::vector<Triangle> small_one = {{4, 5, 6}, {4, 6, 7}, {4, 7, 5}, {5, 7, 6}};

Positions two_tetrahedra() {
  Positions x(3, 8);
  x.leftCols(4) << 1, -1, 1, -1, 1, -1, -1, 1, 1, 1, -1, -1;
  x.rightCols(4) = (0.5 * x.leftCols(4)).colwise() + Vec3(5, 0, 0);
  return x;
}

VolumeLoss::Surface closed(const Positions& rest, const std::vector<Triangle>& triangles) {
  return {triangles, signed_volume(rest, triangles), total_area(rest, triangles)};
}

Positions shrunk(const Positions& x, double factor) {
  Positions result = x;
  for (const Index start : {0, 4}) {
    const Vec3 middle = x.middleCols(start, 4).rowwise().mean();
    result.middleCols(start, 4) = (factor * (x.middleCols(start, 4).colwise() - middle)).colwise() + middle;
  }
  return result;
}

TEST(VolumeLoss, sets_in_below_the_least_share) {
  const Positions rest = two_tetrahedra();
  const VolumeLoss energy(rest, {closed(rest, large_one), closed(rest, small_one)}, 0.5);
  const double volume = signed_volume(rest, large_one), area = total_area(rest, large_one);
  EXPECT_EQ(total_value(energy, shrunk(rest, std::cbrt(0.51))), 0);
  EXPECT_EQ(total_value(energy, shrunk(rest, 1.5)), 0);
  EXPECT_TRUE(linearise_all(energy, shrunk(rest, std::cbrt(0.51)), 1).hessian.dense.empty());
  EXPECT_NEAR(energy.value(shrunk(rest, std::cbrt(0.4)), 0), 0.5 * std::pow(0.1 * volume, 2) / area, 1e-12);
  // A surface that is half as large costs as much less as a length to the fourth power.
  const Positions x = shrunk(rest, 0.5);
  EXPECT_NEAR(energy.value(x, 0), 16 * energy.value(x, 1), 1e-12);
}

TEST(VolumeLoss, normals_that_point_inward_bound_a_hollow) {
  const Positions rest = two_tetrahedra();
  std::vector<Triangle> inward = large_one;
  for (Triangle& t : inward) std::swap(t[1], t[2]);
  const VolumeLoss outward_energy(rest, {closed(rest, large_one)}, 0.9),
      inward_energy(rest, {closed(rest, inward)}, 0.9);
  const Positions x = shrunk(rest, 0.7);
  EXPECT_GT(outward_energy.value(x, 0), 0);
  EXPECT_NEAR(inward_energy.value(x, 0), outward_energy.value(x, 0), 1e-12);
}

TEST(VolumeLoss, a_piece_stands_for_the_whole) {
  const Positions rest = two_tetrahedra();
  VolumeLoss::Surface piece = closed(rest, large_one);
  piece.triangles.pop_back();  // the one without vertex 0
  Positions x = rest;
  x.col(0) = -0.2 * rest.col(0);
  const VolumeLoss whole(rest, {closed(rest, large_one)}, 0.9), of_piece(rest, {piece}, 0.9);
  EXPECT_GT(whole.value(x, 0), 0);
  EXPECT_NEAR(of_piece.value(x, 0), whole.value(x, 0), 1e-12);
}

TEST(VolumeLoss, derivatives_agree_with_finite_differences) {
  const Positions rest = two_tetrahedra();
  const VolumeLoss energy(rest, {closed(rest, large_one), closed(rest, small_one)}, 0.9);
  const Positions x = shrunk(rest, 0.6) + 0.1 * random_positions(1, 8);
  expect_derivatives(energy, x, 1e-6, 1e-6);
}

TEST(VolumeLoss, hessian_is_gauss_newton) {
  const Positions rest = two_tetrahedra();
  const VolumeLoss energy(rest, {closed(rest, large_one)}, 0.9);
  const Positions x = shrunk(rest, 0.8);
  const Linearised at = linearise_all(energy, x, 2);
  // E = s loss^2 / 2: its gradient g = s loss l has the Gauss-Newton Hessian s l l^T = g g^T / (2 E).
  const Eigen::VectorXd g = at.gradient.reshaped();
  EXPECT_LT((dense(at.hessian, 8) - g * g.transpose() / (2 * at.value)).norm(), 1e-12);
}

}  // namespace
}  // namespace unsnarl
