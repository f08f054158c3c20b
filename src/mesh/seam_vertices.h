#pragma once

#include <span>

#include "geometry/types.h"
#include "mesh/coincident_faces.h"
#include "mesh/open_sides.h"
#include "mesh/union_find.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Steps (c), (d) and (e) of identify: glues single vertices at equal positions. Arguments as for glue_seam_edges,
/// which comes before.
void glue_seam_vertices(const SurfaceView& surface, std::span<const OpenSide> boundary, std::span<const Index> class_of,
                        const CoincidentFaces& coincident, UnionFind& shells, UnionFind& glued);

}  // namespace unsnarl
