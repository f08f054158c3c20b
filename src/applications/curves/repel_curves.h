#pragma once

#include <functional>

#include "applications/curves/crossings.h"
#include "energy/gaussian_contact.h"

namespace unsnarl {

/// How deep two segments overlap: the distance of the origin to the boundary of A - B, a parallelogram (paper §3.2,
/// with segments in the plane for triangles in space). The normals of both segments are the candidates.
struct SegmentPenetration {
  double depth = 0;              ///< > 0: they cross; moving a by depth * normal separates them
  Vec2 normal = Vec2::Zero();    ///< unit
  Vec2 weight_a = Vec2::Zero();  /// d(depth)/d(a_i) = -normal weight_a[i]; sums to 1
  Vec2 weight_b = Vec2::Zero();  /// d(depth)/d(b_i) = +normal weight_b[i]; sums to 1
};
SegmentPenetration segment_penetration(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1);

struct RepelOptions {
  int max_iterations = 200;  ///< Iterations of L-BFGS, at most (unit: iterations)
  /// Weight of the Gaussian energy (unit: weight of the penalty over the mean edge length)
  double gaussian = 1;
  /// Weight of the change of edges, which keeps them from being drawn out (no unit)
  double elastic = 0.05;
  double step_rel = 0.01;  ///< Longest motion of a vertex in an iteration (unit: bounding-box diagonal)
  /// With more points the Gaussian energy is left out, since it sums over all pairs (unit: points)
  Index most_points = 3000;
  double least_bandwidth = 2;  ///< Bandwidth of the Gaussian energy, at least (unit: mean edges)
  /// Bandwidth of the Gaussian energy, at most (unit: bounding-box diagonal)
  double most_bandwidth_rel = 0.05;
  /// The bandwidth is looked for by pairs of points closer than this (unit: bounding-box diagonal)
  double seen_rel = 0.1;
  int starts = 5;  ///< Starts from which the bandwidth is looked for (unit: starts)
  /// Segments count as this much deeper than they are, so that they do not end touching (unit: mean edges)
  double overshoot = 0.05;
  /// Shorter edges resist change no harder than one of this length (unit: mean edges)
  double least_edge = 0.01;
  /// The weight of a pair is zero where its points are no farther apart along the curve (unit: mean edges)
  double nearest_samples = 3;
};

/// The pairs of vertices of the Gaussian self-contact energy of curves (paper eq. (1)): weight w(s, t) ds dt, with w
/// the distance along the curve over its largest value, 1 for points of different curves.
std::vector<GaussianContact<2>::Pair> contact_pairs(const CurveNet& net, double nearest);

/// Minimises Gaussian self-contact energy + segment penalty + elastic energy from state.x until nothing crosses. For
/// crossings that cannot be switched because points are fixed or joined. The result is kept only if fewer segments
/// meet. Returns the crossings that are left.
std::vector<SegmentPair> repel_curves(const CurveNet& net, CurveState& state, const RepelOptions& options,
                                      const std::function<bool()>& stop);

}  // namespace unsnarl
