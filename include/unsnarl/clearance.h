#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "unsnarl/intersections.h"
#include "unsnarl/report.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// How much room a surface leaves between its faces: what programs that mesh volumes or simulate contact ask for. Faces
/// that may pass through each other (FindOptions::allowed) are no two faces here, but at an edge.
struct Clearance {
  /// Smallest angle between two faces at an edge, in degrees, in [0, 180]: 0 where they are folded onto each other, 180
  /// where they are flat. Exact up to one rounding at the end: no edge has a smaller one. Faces without area do not
  /// count, nor do those on the same three vertices. 180 where no edge has two faces.
  double dihedral_deg = 180;
  std::array<std::int32_t, 2> dihedral_faces = {-1, -1};  ///< the two; -1: there are none
  /// Smallest distance of two faces that share no vertex, in the units of the positions; computed in double precision.
  /// 0 where faces intersect, infinite where there are no such faces.
  double gap = std::numeric_limits<double>::infinity();
  std::array<std::int32_t, 2> gap_faces = {-1, -1};  ///< the two; -1: there are none, or faces intersect
  /// The same of faces of different components.
  double component_gap = std::numeric_limits<double>::infinity();
  std::array<std::int32_t, 2> component_gap_faces = {-1, -1};
};

/// Measures `positions` (3 n doubles, vertex order of `input`) of the input's faces, which are welded and cut into
/// triangles as the input is. is_embedded: that no two faces intersect there is known, and not looked for again; else
/// false. Throws std::invalid_argument as certify() does.
Clearance measure_clearance(const SurfaceView& input, std::span<const double> positions,
                            const FindOptions& options = {}, bool is_embedded = false);

/// The smallest gap between two sheets of a surface without self-intersections (see GapReport), as a repair with this
/// RepairOptions::min_gap_rel measures it that leaves all as it is. asked_rel: a finite number >= 0. Throws
/// std::invalid_argument as find_intersections does, and where asked_rel is out of range.
GapReport measure_gap(const SurfaceView& surface, double asked_rel, const FindOptions& options = {});

}  // namespace unsnarl
