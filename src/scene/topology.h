#pragma once

#include "mesh/adjacency.h"
#include "mesh/components.h"
#include "mesh/triangulation.h"
#include "mesh/weld_map.h"
#include "unsnarl/report.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Everything that RepairReport::topology holds. `vertices` counts welded ones; `duplicate_faces` the triangles
/// beyond the first of each group; `zero_area_faces` the faces of which no triangle has any area;
/// `duplicate_vertices` what WeldMap::merged counts.
Topology describe_topology(const SurfaceView& surface, const WeldMap& weld_map, const Triangulation& triangulation,
                           const EdgeTable& edges, const Components& components);

}  // namespace unsnarl
