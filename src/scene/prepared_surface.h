#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/scale.h"
#include "geometry/types.h"
#include "mesh/adjacency.h"
#include "mesh/components.h"
#include "mesh/triangulation.h"
#include "mesh/weld_map.h"
#include "scene/allowed_parts.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Everything that is decided once, from the input, and holds for every later state of it. Positions are scaled by a
/// power of two if those of the input are so large or small that products of lengths would over- or underflow.
struct PreparedSurface {
  WeldMap weld_map;
  Triangulation triangulation;
  Triangulation other_diagonals;  ///< of the quads; empty unless FindOptions::both_diagonals
  AllowedParts allowed;           ///< what may pass through each other
  std::vector<Index> part_of;     ///< of the triangles, among these parts
  Scale scale;                    ///< of all positions x of welded vertices; in(a coordinate of the file)
  Positions rest;                 ///< of the welded vertices

  std::span<const Triangle> triangles() const { return triangulation.triangles; }
  /// Of the triangles; those of two groups of vertices pass too (see Passing).
  Passing passing(std::span<const Index> group_of_vertex = {}) const {
    return Passing(group_of_vertex, part_of, allowed.passing);
  }
  /// Positions of the file's vertices -> of the welded ones (the first of each), at this scale.
  Positions gather(std::span<const double> positions) const { return gather(positions, scale); }
  /// The same at another scale.
  Positions gather(std::span<const double> positions, const Scale& other) const;
  /// The input's positions, where welded vertices that differ from rest replace the vertices of the file.
  std::vector<double> scatter(std::span<const double> input, const Positions& x) const;
  /// Diagonal of the bounding box of the file's vertices at these positions, at this scale.
  double diagonal_of(std::span<const double> positions) const;
  /// All vertices of the file that are one lie at one position.
  bool seams_are_closed(std::span<const double> positions) const;
};

/// Throws std::invalid_argument where the surface makes no sense (see require_valid), or an option is out of range.
PreparedSurface prepare(const SurfaceView& surface, const FindOptions& options);

/// The surface as a program sees it that reads it at other positions (3 n doubles): welded as before, but with polygons
/// triangulated by the new positions. Nothing if that is the same triangulation. `options`: those it was prepared with.
std::optional<PreparedSurface> cut_anew(const SurfaceView& surface, const PreparedSurface& prepared,
                                        const FindOptions& options, std::span<const double> positions);

/// Pairs of triangles -> pairs of the faces that they are pieces of (`polygon`, of each triangle), sorted, each once,
/// in the class of its first occurrence.
std::vector<IntersectingPair> pairs_of_faces(std::span<const Index> polygon, std::span<const IntersectingPair> pairs);

/// Pairs of faces of both, sorted, each once, in the class that comes first.
std::vector<IntersectingPair> unite_face_pairs(std::vector<IntersectingPair> pairs,
                                               std::span<const IntersectingPair> others);

}  // namespace unsnarl
