#pragma once

#include <functional>

#include "applications/seifert/embedded_mesh.h"

namespace unsnarl {

struct FairOptions {
  /// Levels in which edges are refined, each half as long as the one before: on coarse meshes a sweep carries far
  /// (unit: levels)
  int levels = 3;
  /// Sweeps of the finest level; the one before has twice as many, and so on (unit: sweeps)
  int sweeps = 16;
  /// Sweeps between two remeshings, enough for triangles to settle (unit: sweeps)
  int sweeps_a_remeshing = 4;
  /// A step goes this far toward the minimum along a vertex's own way, beyond it as in successive over-relaxation; more
  /// lets coarse meshes oscillate (no unit)
  double over_relaxation = 1.4;
  /// Weight of the bends at edges against the area, where triangles are equilateral [E278] (no unit)
  double bending = 3;
  /// Gap to keep between sheets, wide enough that a picture shows two (unit: edge length of the level)
  double gap_of_edge = 0.3;
};

/// Shrinks the area of an embedded surface with fixed boundary, remeshing to triangles of about this edge length, and
/// keeps it embedded in every step: vertices go to where the area of the triangles around them (the mean curvature flow
/// of U. Pinkall and K. Polthier, "Computing Discrete Minimal Surfaces and Their Conjugates", 1993) and the bends
/// are least, and along the surface to the middle of their neighbours. Sheets that meet stay apart by a gap.
/// `progress`: called once a sweep with the part that is done, in [0, 1]. `goes_on`: asked all the time; false: stop.
SpanningMesh fair(SpanningMesh mesh, Index boundary_count, double edge, const FairOptions& options,
                  const std::function<void(double)>& progress, const std::function<bool()>& goes_on);

}  // namespace unsnarl
