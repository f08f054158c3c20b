#pragma once

#include <Eigen/Cholesky>

#include "geometry/types.h"

namespace unsnarl {

/// An energy of closed polygons that keeps parts apart that are near in space but not along the curve: the
/// tangent-point energy of G. Buck and J. Orloff, "A simple energy function for knots" (1995), with the exponents alpha
/// = 2 and beta,
///   E = sum over edges I, J that do not touch of l_I l_J |m_I - m_J|^(2 - beta) sin^2(T_I, m_I - m_J),
/// m being the middles of the edges, l their lengths and T their directions; times length^(beta - 4), so that size does
/// not matter; plus evenness * (n sum l^2 / length^2 - 1), which is 0 where all edges are equally long.
class KnotEnergy {
 public:
  /// Between 4, where knots can be pulled tight without an end, and 5, where it is infinite for polygons as they get
  /// finer.
  static constexpr double beta = 4.5;
  /// Keeps edges alike, so that none gets longer than the distance between strands, which would slip through between
  /// middles. With 10, a figure-eight of 96 points did, its longest edge forty times the shortest; with 30000, six
  /// kinks were not undone after 400 steps of plain descent, which took 160 with 3000.
  double evenness = 1000;
  /// Edges with three others between them, at least, that are nearer than this part of the mean edge length are kept
  /// apart by a barrier, of this weight: middles do not see what ends do. Without it, an unknot with six kinks got
  /// stuck with strands that almost touch; a tenth or ten times the weight need as many steps.
  double barrier_reach = 1, barrier_weight = 100;

  double operator()(const Positions& x) const;
  /// The gradient is written, one column a vertex.
  double operator()(const Positions& x, Positions& gradient) const;
};

/// The inner product of a Sobolev space of fractional order that fits the energy (C. Yu, H. Schumacher, K. Crane,
/// "Repulsive curves", 2021, section 4.2), on polygons: descent along the gradient that it defines does not depend on
/// how fine a polygon is, and takes large steps.
class KnotMetric {
 public:
  KnotMetric(const Positions& x, double evenness);
  /// The vectors whose inner products with all others are those of `v`; columns are vertices.
  Positions solve(const Positions& v) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace unsnarl
