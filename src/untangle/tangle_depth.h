#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"

namespace unsnarl {

/// The connected components of a scene; cheaper to find than Components, which know more.
struct ConnectedParts {
  explicit ConnectedParts(const Scene& scene);
  std::vector<Index> of_vertex;
  Index count = 0;
};

/// How deep a conflict is, in edges of the mesh. If a surface runs through another one, the intersecting faces, with
/// the vertices `core` (ascending), enclose a region of it. The depth is the largest number of edges between a vertex
/// of an enclosed region and those faces, but at most half the length of the loop around the region, which may leave
/// sideways. 0: nothing is enclosed. Only what is connected to the core counts. The cost follows the surroundings as
/// wide as the second deepest of the regions into which the faces cut a connected surface.
int tangle_depth(const Scene& scene, const ConnectedParts& parts, std::span<const Index> core);

}  // namespace unsnarl
