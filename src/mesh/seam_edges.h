#pragma once

#include <span>

#include "geometry/types.h"
#include "mesh/coincident_faces.h"
#include "mesh/open_sides.h"
#include "mesh/union_find.h"

namespace unsnarl {

/// Step (b) of identify: glues boundary edges that lie at one place. `glued` joins vertices that become one, `shells`
/// those that hang together, at first through faces. `class_of`: the position class of each vertex.
void glue_seam_edges(std::span<const OpenSide> boundary, std::span<const Index> class_of,
                     const CoincidentFaces& coincident, UnionFind& shells, UnionFind& glued);

}  // namespace unsnarl
