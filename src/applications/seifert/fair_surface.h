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
  /// Weight of the curvature, the integral of H^2 times a squared edge of the level, against the area; H as it is with
  /// the metric held, so that vertices move by a linear equation. Of 24 links of the table, 577 edges were folded by
  /// more than 90 degrees without it, 356, 284, 210 and 173 with 0.25, 0.5, 1 and 2, at areas x 0.997, 0.995, 0.990 and
  /// 0.993, in the same time. With 4 and 8 areas grow. The whole gradient, which holds thin tubes open, made no
  /// difference on 12 of them, since it needs 8 and more, with which they are 6 % larger.
  double curvature = 2;
  /// Gap to keep between sheets / edge length of the level. A sixth of an edge shows as two sheets in a picture.
  double gap_of_edge = 0.3;
};

/// Shrinks the area of an embedded surface with fixed boundary, remeshing to triangles of about this edge length, and
/// keeps it embedded in every step: vertices go to where the area of the triangles around them (the mean curvature flow
/// of U. Pinkall and K. Polthier, "Computing Discrete Minimal Surfaces and Their Conjugates", 1993) and the curvature
/// are least, and along the surface to the middle of their neighbours. Sheets that meet stay apart by a gap.
/// `progress`: called once a sweep with the part that is done, in [0, 1]. `goes_on`: asked all the time; false: stop.
SpanningMesh fair(SpanningMesh mesh, Index boundary_count, double edge, const FairOptions& options,
                  const std::function<void(double)>& progress, const std::function<bool()>& goes_on);

}  // namespace unsnarl
