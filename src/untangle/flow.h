#pragma once

#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/shared_constants.h"

namespace unsnarl {

/// Constants of flow(). h is the patch's edge length.
struct FlowOptions {
  /// Weight of the metric's zeroth-order term: 30 keeps forces local, 1 moves whole limbs. (Flows with 30, ratios of
  /// distances and adaptive bandwidths left ten of 186 meshes 11 % farther.)
  double locality = 1;
  /// Weight of the penalty. Large ones lock sheets against each other: 1 solved 15 of 21 meshes, 4 only 10. Where it
  /// grew on stalls with few pairs left, 15 meshes took half as much time again, and ended no closer.
  double lambda_minkowski = 0.3;
  double margin = penalty_margin;
  double spacing_edges = 2;    ///< h: least spacing of the clusters ...
  double spacing_rel = 0.012;  ///< ... and of the diagonal: steps and clusters must not shrink with h on fine meshes
  double bandwidth = 2;        ///< spacings: of the Gaussian
  double cutoff = 2.2;         ///< bandwidths: exp(-4.8) = 0.8 % of the force at 0 is left out
  double vertex_trim = 0.1;    ///< of the shared corner of one-vertex pairs: took 52, 18, 6 of them to 0
  double jitter = symmetry_jitter;
  double accept_motion = 0.02;        ///< h: the line search stops halving here and takes the step: E_M is not smooth
  int stall_iterations = 12;          ///< without ...
  double stall_drop = 0.15;           ///< ... this relative drop of the number of pairs: the clusters grow
  double spacing_growth = 1.6;        ///< of the clusters, on a stall
  double max_spacing_rel = 0.25;      ///< of the diagonal: how coarse the clusters may get; it ends on the stall after
  double area_floor = squeezed_area;  ///< of its area at rest
  int bisections = bisections_back;
  double candidate_reach = 0.25;  ///< h: motion until the candidate pairs are gathered anew
};

struct FlowResult {
  bool clean = false;  ///< no active triangle intersects another (but for the tolerated pairs), none is squeezed
  int iterations = 0;
  std::size_t pairs_left = 0;  ///< in patch.x
};

/// Moves the free vertices of patch.x, starting from patch.rest, until the exact detector finds no pair of any class on
/// the active triangles: the shape-level untangling of the paper (§3.3, eq. (11)) on clusters of vertices,
///   E = E_G + lambda_minkowski h E_M + E_ARAP, every term length squared, all but adjacent clusters repel (§3.5.2),
/// by L-BFGS in the metric 2 (L + locality A/S): L the Laplacian of ARAP's weights, A/S the vertices' shares of the
/// area. (Trefoil tube: 226 pairs left after 299 iterations in the plain metric, none after 9 in this one.)
/// Whenever the pairs have halved, the local contour method tries to take away the rest: it clears in a few steps what
/// the flow would still chase after 100 iterations.
/// It ends: between two stalls the pairs fall by a share, and on a stall the clusters grow, up to a bound.
/// Fixed vertices and obstacles repel but stand still. Pairs of faces on the same three vertices and `tolerated` pairs
/// (sorted, of patch triangles) are let be. Where it fails, patch.x is the state with the fewest pairs. `stop` is asked
/// once an iteration; true ends the flow as a failure.
FlowResult flow(Patch& patch, const std::function<bool()>& stop = {}, std::span<const IntersectingPair> tolerated = {},
                const FlowOptions& options = {});

}  // namespace unsnarl
