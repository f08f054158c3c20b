#include "recover/objective.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "energy/energy_checks.h"

namespace unsnarl {
namespace {

/// A free fan of four faces with one fixed corner, and a fixed face below it.
Patch fan_over_face() {
  Patch patch;
  patch.free_count = 4;
  patch.active_count = 4;
  patch.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 6, 7}};
  patch.rest.resize(3, 8);
  patch.rest << 0, 1, 0, -1, 0, -4, 4, 0,  //
      0, 0, 1, 0, -1, -4, -4, 4,           //
      0.3, 0.2, 0, 0, 0.1, -0.5, -0.5, -0.5;
  patch.x = patch.rest;
  patch.edge_length = 1;
  return patch;
}

struct Assembled {
  explicit Assembled(const Patch& patch, const ObjectiveOptions& options = {})
      : edges(build_edges(patch.triangles)), objective(patch, edges, options, patch.edge_length) {
    std::vector<std::uint8_t> moves(static_cast<std::size_t>(patch.x.cols()), 0);
    for (Index v = 0; v < patch.free_count; ++v) moves[v] = 1;
    objective.restrict_to(MovingVertices(moves));
    objective.contacts() = {{{StencilKind::vertex_face, {3, 5, 6, 7}}, 0.01, 0.6},
                            {{StencilKind::edge_edge, {2, 3, 5, 6}}, 0.01, 5, 1e-3},
                            {{StencilKind::vertex_edge, {1, 0, 2, -1}}, 0.01, 0.9}};
  }
  Eigen::VectorXd gradient(const Positions& x) {
    Positions g(3, x.cols());
    Hessian hessian;
    objective.linearise(x, g, hessian);
    return g.leftCols(objective.moving().count()).reshaped();
  }
  Eigen::MatrixXd hessian(const Positions& x) {
    Positions g(3, x.cols());
    Hessian hessian;
    objective.linearise(x, g, hessian);
    const Index n = objective.moving().count();
    Eigen::MatrixXd result(3 * n, 3 * n);
    Eigen::Matrix3Xd unit(3, n), image(3, n);
    for (Index k = 0; k < 3 * n; ++k) {
      unit.setZero();
      unit(k % 3, k / 3) = 1;
      hessian.apply(unit, image);
      result.col(k) = image.reshaped();
    }
    return result;
  }
  void expect_derivatives(const Positions& x, double step, double tolerance) {
    Positions g(3, x.cols());
    Hessian matrix;
    const double value = objective.linearise(x, g, matrix);
    EXPECT_NEAR(value, objective.value(x), 1e-12 * value);
    const Index n = objective.moving().count();
    for (Index k = 0; k < 3 * n; ++k) {
      Positions plus = x, minus = x;
      plus(k % 3, k / 3) += step;
      minus(k % 3, k / 3) -= step;
      const double difference = (objective.value(plus) - objective.value(minus)) / (2 * step);
      EXPECT_NEAR(g(k % 3, k / 3), difference, tolerance) << k;
    }
    const Eigen::MatrixXd h = hessian(x);
    EXPECT_LT((h - h.transpose()).norm(), 1e-9 * h.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(h).eigenvalues()[0], 0);
  }

  EdgeTable edges;
  Objective objective;
};

TEST(Objective, derivatives_in_generic_positions) {
  const Patch patch = fan_over_face();
  Assembled assembled(patch);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Positions x = patch.rest;
    x.leftCols(4) += 0.15 * random_positions(seed, 4);
    assembled.expect_derivatives(x, 1e-6, 2e-3);
  }
}

TEST(Objective, derivatives_with_a_flipped_face_and_a_squeezed_one) {
  const Patch patch = fan_over_face();
  Assembled assembled(patch);
  Positions x = patch.rest;
  x.col(1) = Vec3(-0.4, 0.3, 0.2);  // across the edge (0, 2)
  assembled.expect_derivatives(x, 1e-6, 2e-3);
  ASSERT_GT(assembled.objective.terms()[EnergyTerm::orientation], 0);
  x = patch.rest;
  x.col(2) = 0.5 * (x.col(0) + x.col(1)) + Vec3(0.01, 0.03, 0);
  assembled.expect_derivatives(x, 1e-8, 2e-2);
}

TEST(Objective, hessian_is_that_of_the_parts_at_rest) {
  // At rest, with no contact, Gauss-Newton is exact.
  const Patch patch = fan_over_face();
  ObjectiveOptions options;
  options.rotation_damping = 0;
  Assembled assembled(patch, options);
  assembled.objective.contacts().clear();
  const double step = 1e-5;
  const Eigen::MatrixXd h = assembled.hessian(patch.rest);
  for (Index k = 0; k < h.cols(); ++k) {
    Positions plus = patch.rest, minus = patch.rest;
    plus(k % 3, k / 3) += step;
    minus(k % 3, k / 3) -= step;
    const Eigen::VectorXd difference = (assembled.gradient(plus) - assembled.gradient(minus)) / (2 * step);
    EXPECT_LT((h.col(k) - difference).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(Objective, terms_sum_to_the_value) {
  const Patch patch = fan_over_face();
  Assembled assembled(patch);
  Positions x = patch.rest;
  x.leftCols(4) += 0.2 * random_positions(3, 4);
  Positions g(3, x.cols());
  Hessian hessian;
  const double value = assembled.objective.linearise(x, g, hessian);
  const IterationRecord terms = assembled.objective.terms();
  double sum = 0;
  for (EnergyTerm term : {EnergyTerm::pull, EnergyTerm::arap, EnergyTerm::bending, EnergyTerm::orientation,
                          EnergyTerm::volume, EnergyTerm::barrier})
    sum += terms[term];
  EXPECT_NEAR(sum, value, 1e-12 * value);
}

TEST(Objective, the_penalty_of_flipped_faces_can_be_scaled) {
  const Patch patch = fan_over_face();
  Assembled assembled(patch);
  Positions x = patch.rest;
  x.col(1) = Vec3(-0.4, 0.3, 0.2);
  assembled.gradient(x);
  const double once = assembled.objective.terms()[EnergyTerm::orientation];
  assembled.objective.scale_flip_penalty(5);
  assembled.expect_derivatives(x, 1e-6, 2e-3);
  assembled.gradient(x);
  EXPECT_DOUBLE_EQ(assembled.objective.terms()[EnergyTerm::orientation], 5 * once);
}

TEST(Objective, runs_over_the_elements_of_moving_vertices) {
  const Patch patch = fan_over_face();
  Assembled assembled(patch);
  assembled.objective.contacts().clear();
  Positions x = patch.rest;
  x.leftCols(4) += 0.2 * random_positions(4, 4);
  std::vector<std::uint8_t> moves(8, 0);
  moves[2] = 1;
  assembled.objective.restrict_to(MovingVertices(moves));
  EXPECT_EQ(assembled.objective.moving().count(), 1);
  EXPECT_EQ(assembled.objective.triangles().size(), 2u);
  EXPECT_EQ(assembled.hessian(x).cols(), 3);
}

}  // namespace
}  // namespace unsnarl
