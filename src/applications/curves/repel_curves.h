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
  int max_iterations = 200;  ///< of L-BFGS
  double gaussian = 1;       ///< weight of the Gaussian energy, against the penalty over the mean edge length
  double elastic = 0.05;     ///< weight of the change of edges: keeps them from being drawn out
  double step_rel = 0.01;    ///< largest motion of a vertex in an iteration / diagonal
  Index most_points = 3000;  ///< beyond it the Gaussian sum over all pairs is left out: it needs 4.5 million
  /// Bandwidth of the Gaussian energy: at least so many mean edges, at most a part of the diagonal; looked for from so
  /// many starts, by pairs of points closer than `seen_rel` of the diagonal.
  double least_bandwidth = 2, most_bandwidth_rel = 0.05, seen_rel = 0.1;
  int starts = 5;
  double overshoot = 0.05;     ///< mean edges that segments count as deeper than they are, so as not to end touching
  double least_edge = 0.01;    ///< mean edges: shorter ones resist change no harder than one of this length
  double nearest_samples = 3;  ///< mean edges along the curve within which the weight of a pair is zero
};

/// The pairs of vertices of the Gaussian self-contact energy of curves (paper eq. (1)): weight w(s, t) ds dt, with w
/// the distance along the curve over its largest value, 1 for points of different curves.
std::vector<GaussianContact<2>::Pair> contact_pairs(const CurveNet& net, double nearest);

/// Minimises Gaussian self-contact energy + segment penalty + elastic energy from state.x until nothing crosses: for
/// what cannot be switched because its points are fixed or joined. The result is kept only where fewer segments meet.
/// Returns the crossings left.
std::vector<SegmentPair> repel_curves(const CurveNet& net, CurveState& state, const RepelOptions& options,
                                      const std::function<bool()>& stop);

}  // namespace unsnarl
