#include "energy/ipc_barrier.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "energy/energy_checks.h"

namespace unsnarl {
namespace {

TEST(IpcBarrier, function_and_derivatives) {
  EXPECT_EQ(barrier(1), 0);
  EXPECT_EQ(barrier(1.5), 0);
  EXPECT_EQ(barrier_derivative(1.5), 0);
  EXPECT_TRUE(std::isinf(barrier(0)));
  EXPECT_TRUE(std::isinf(barrier(-1)));
  for (double y : {1e-3, 0.01, 0.2, 0.5, 0.9, 0.999}) {
    const double step = 1e-6 * y;
    EXPECT_GT(barrier(y), 0);
    EXPECT_LT(barrier_derivative(y), 0);
    EXPECT_GT(barrier_second_derivative(y), 0);
    EXPECT_NEAR((barrier(y + step) - barrier(y - step)) / (2 * step), barrier_derivative(y),
                1e-6 * (1 + std::abs(barrier_derivative(y))));
    EXPECT_NEAR((barrier_derivative(y + step) - barrier_derivative(y - step)) / (2 * step),
                barrier_second_derivative(y), 1e-5 * (1 + barrier_second_derivative(y)));
  }
}

TEST(IpcBarrier, mollifier_is_smooth) {
  EXPECT_EQ(mollifier(0, 0.1), 0);
  EXPECT_EQ(mollifier(0.1, 0.1), 1);
  EXPECT_EQ(mollifier(0.2, 0.1), 1);
  EXPECT_NEAR(mollifier_derivative(0.1 - 1e-9, 0.1), 0, 1e-6);
  const double difference = (mollifier(0.05 + 1e-6, 0.1) - mollifier(0.05 - 1e-6, 0.1)) / 2e-6;
  EXPECT_NEAR(difference, mollifier_derivative(0.05, 0.1), 1e-8);
}

BarrierStencil stencil(StencilKind kind, double separation, double activation, double mollifier_threshold = 0) {
  return {{kind, {0, 1, 2, kind == StencilKind::vertex_edge ? -1 : 3}}, separation, activation, mollifier_threshold};
}

void expect_barrier_gradient(const BarrierStencil& s, const Positions& x) {
  const IpcBarrier energy{{s}};
  const Linearised at = linearise_all(energy, x, 1);
  ASSERT_EQ(at.hessian.rank_ones.size(), 1u);
  EXPECT_GE(at.hessian.rank_ones[0].stiffness, 0);  // rank one with a factor of this sign: positive semidefinite
  expect_derivatives(energy, x, 1e-7, 1e-4 * (1 + at.gradient.norm()));
  // No force on the whole: translations cost nothing.
  EXPECT_LT(at.gradient.rowwise().sum().norm(), 1e-10 * (1 + at.gradient.norm()));
}

TEST(IpcBarrier, gradient_of_vertex_over_face_edge_and_corner) {
  Positions x(3, 4);
  for (const Vec3& p : {Vec3(0.3, 0.3, 0.05), Vec3(0.5, -0.03, 0.04), Vec3(-0.03, -0.03, 0.02)}) {
    x << p, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0);
    expect_barrier_gradient(stencil(StencilKind::vertex_face, 0, 0.1), x);
    expect_barrier_gradient(stencil(StencilKind::vertex_face, 0.02, 0.1), x);
    expect_barrier_gradient(stencil(StencilKind::vertex_edge, 0.001, 0.5), x);
  }
}

TEST(IpcBarrier, gradient_of_crossing_and_nearly_parallel_edges) {
  Positions x(3, 4);
  x << Vec3(-1, 0, 0), Vec3(1, 0.1, 0), Vec3(0, -1, 0.05), Vec3(0.1, 1, 0.07);
  expect_barrier_gradient(stencil(StencilKind::edge_edge, 0.01, 0.1, 1e-3 * 16), x);
  x << Vec3(-1, 0, 0), Vec3(1, 0.001, 0), Vec3(-1, -0.02, 0.05), Vec3(1, 0.03, 0.05);
  expect_barrier_gradient(stencil(StencilKind::edge_edge, 0.01, 0.1, 1e-3 * 16), x);
  // Exactly parallel: the mollifier is zero, with zero slope in the distance.
  x << Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0.05), Vec3(1, 0, 0.05);
  const BarrierStencil s = stencil(StencilKind::edge_edge, 0.01, 0.1, 1e-3 * 16);
  EXPECT_EQ(IpcBarrier{{s}}.value(x, 0), 0);
}

TEST(IpcBarrier, zero_beyond_activation_and_infinite_at_separation) {
  Positions x(3, 4);
  x << Vec3(0.3, 0.3, 0.2), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0);
  const BarrierStencil far = stencil(StencilKind::vertex_face, 0.01, 0.1);
  const Linearised at = linearise_all(IpcBarrier{{far}}, x, 1);
  EXPECT_EQ(at.value, 0);
  EXPECT_TRUE(at.hessian.rank_ones.empty());
  const BarrierStencil closed = stencil(StencilKind::vertex_face, 0.2, 0.4);
  EXPECT_TRUE(std::isinf(IpcBarrier{{closed}}.value(x, 0)));
}

TEST(IpcBarrier, force_depends_on_the_ratio_alone) {
  // Scaled positions and lengths: the energy scales as length, the force not at all.
  Positions x(3, 4);
  x << Vec3(0.3, 0.3, 0.05), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0);
  const BarrierStencil s = stencil(StencilKind::vertex_face, 0.01, 0.1);
  const BarrierStencil scaled = stencil(StencilKind::vertex_face, 0.05, 0.5);
  const Linearised one = linearise_all(IpcBarrier{{s}}, x, 1);
  const Linearised five = linearise_all(IpcBarrier{{scaled}}, 5 * x, 1);
  EXPECT_NEAR(five.value, 5 * one.value, 1e-12);
  EXPECT_LT((five.gradient - one.gradient).norm(), 1e-12);
}

}  // namespace
}  // namespace unsnarl
