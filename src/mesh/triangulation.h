#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// How the polygons of a surface were cut; part of the report, since a result holds for this cut.
struct CutStatistics {
  std::size_t triangles = 0;             ///< polygons with three corners, taken as they are
  std::size_t quads = 0;                 ///< polygons with four corners
  std::size_t quads_other_diagonal = 0;  ///< of these: cut from the second corner, since the first diagonal folds
  std::size_t clipped = 0;               ///< polygons with more corners, cut by ear clipping
  std::size_t forced_ears = 0;           ///< ears cut although none was convex and empty (twisted polygons)
  std::size_t too_small = 0;             ///< polygons with fewer than three corners: no triangle
  std::size_t dropped = 0;               ///< triangles with a repeated vertex left out: an edge or corner of another

  /// One sentence for a person; names only what occurs.
  std::string describe() const;
};

/// A surface cut into triangles.
struct Triangulation {
  std::vector<Triangle> triangles;  ///< of welded vertices (or file vertices, if no map was given)
  std::vector<Index> polygon;       ///< face of the surface that each triangle comes from, ascending
  CutStatistics statistics;
};

/// Cuts every polygon once, by the positions given: a quad along the diagonal from its first corner, or along the other
/// where that one folds and the other does not; a larger polygon by ear clipping in its mean plane, as it is often
/// concave. `vertex_of` (file vertex -> welded vertex, see WeldMap) renames the corners after the cut. Empty: no
/// renaming.
///
/// A triangle with a repeated vertex is a segment or a point. Where that is an edge or a corner of a triangle with
/// area, whatever meets it intersects that one too: it is left out and counted.
///
/// Precondition: valid ids, finite coordinates. The result does not depend on the number of threads.
Triangulation triangulate(const SurfaceView& surface, std::span<const Index> vertex_of = {});

/// The other way to cut the quads that can be cut either way: along the diagonal from the second corner, where neither
/// diagonal folds. Same precondition; statistics stay empty.
Triangulation triangulate_other_diagonals(const SurfaceView& surface, std::span<const Index> vertex_of = {});

}  // namespace unsnarl
