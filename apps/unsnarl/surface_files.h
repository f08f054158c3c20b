#pragma once

#include <span>
#include <string>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/intersections.h"

namespace unsnarl::app {

/// A new file with nothing but the surface; coordinates with the fewest digits that give the double back.
/// groups: names of the components in the order of their first faces, the last for all further ones. OBJ has them as
/// objects and as groups, GLB as nodes; others do not keep them. Formats: obj, off, ply (ASCII, double), glb
/// (triangles, 32 bits). Throws UsageError for others.
std::string surface_file(const SurfaceView& surface, Format format, const std::string& comment,
                         const std::vector<std::string>& groups = {});

/// A binary PLY for looking at: the surface at `positions`, faces coloured red where they intersect, orange where they
/// did before, grey elsewhere; the number of pairs that each face is in, before and after, as face properties; and how
/// far each vertex is from where it was in `surface`, a length, as a vertex property.
std::string highlight_file(const SurfaceView& surface, std::span<const double> positions,
                           const std::vector<IntersectingPair>& before, const std::vector<IntersectingPair>& after);

}  // namespace unsnarl::app
