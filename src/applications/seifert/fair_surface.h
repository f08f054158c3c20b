#pragma once

#include <functional>

#include "applications/seifert/embedded_mesh.h"

namespace unsnarl {

struct FairOptions {
  /// Edges are refined in this many levels, each half as long as the one before: on coarse meshes a sweep carries far.
  int levels = 3;
  /// Sweeps of the finest level; the one before has twice as many, and so on.
  int sweeps = 16;
  int sweeps_a_remeshing = 4;  ///< enough for triangles to settle in between
  /// A step goes this far beyond the minimum along a vertex's own way, as in successive over-relaxation; more lets
  /// coarse meshes oscillate.
  double over_relaxation = 1.4;
  /// Gap to keep between sheets / edge length of the level. A sixth of an edge shows as two sheets in a picture.
  double gap_of_edge = 0.3;
};

/// Shrinks the area of an embedded surface with fixed boundary, remeshing to triangles of about this edge length, and
/// keeps it embedded in every step: vertices go to where the area of the triangles around them is least (the mean
/// curvature flow of U. Pinkall and K. Polthier, "Computing Discrete Minimal Surfaces and Their Conjugates", 1993),
/// and along the surface to the middle of their neighbours. Sheets that meet stay apart by a gap.
/// `progress`: called once a sweep with the part that is done, in [0, 1]. `goes_on`: asked all the time; false: stop.
SpanningMesh fair(SpanningMesh mesh, Index boundary_count, double edge, const FairOptions& options,
                  const std::function<void(double)>& progress, const std::function<bool()>& goes_on);

}  // namespace unsnarl
