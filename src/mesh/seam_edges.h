#pragma once

#include <span>

#include "geometry/types.h"
#include "mesh/coincident_faces.h"
#include "mesh/open_sides.h"
#include "mesh/union_find.h"

namespace unsnarl {

/// The treatment of open edges at one place where several pairings are possible, or none.
enum class Ambiguous { keep_apart, weld };

/// Welds the open edges that lie at one place (see mesh/weld_map.h). `welded` joins vertices that become one, `shells`
/// those that are connected, at first through faces. `class_of`: the position class of each vertex.
void weld_seam_edges(std::span<const OpenSide> open, std::span<const Index> class_of, const CoincidentFaces& coincident,
                     Ambiguous ambiguous, UnionFind& shells, UnionFind& welded);

}  // namespace unsnarl
