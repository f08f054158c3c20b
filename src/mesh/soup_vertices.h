#pragma once

#include <span>

#include "geometry/types.h"
#include "mesh/coincident_faces.h"
#include "mesh/union_find.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Welds the vertices of a soup (no vertex has two faces) that still lie on open edges after weld_seam_edges and have
/// equal positions, except where two coincident faces would share them. Arguments as for weld_seam_edges.
void weld_soup_vertices(const SurfaceView& surface, std::span<const Index> class_of, const CoincidentFaces& coincident,
                        UnionFind& welded);

}  // namespace unsnarl
