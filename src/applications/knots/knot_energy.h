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
  /// Exponent of the energy, between 4, where knots can be pulled tight without an end, and 5, where it is infinite for
  /// polygons as they get finer (no unit)
  static constexpr double beta = 4.5;
  /// Weight of the evenness of edges: if one gets longer than the distance between strands, these slip through between
  /// middles; a larger weight slows descent [E203] (no unit)
  double evenness = 1000;
  /// Edges with at least three others between them that are nearer than this are kept apart by a barrier, since the
  /// energy of middles does not see their ends (unit: mean edge length)
  double barrier_reach = 1;
  double barrier_weight = 100;  ///< Weight of that barrier [E204] (no unit)

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
  // Not LLT: the size of the processor's cache decides the order of its sums.
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace unsnarl
