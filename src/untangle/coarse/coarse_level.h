#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/progressive_mesh.h"
#include "recover/recover_options.h"
#include "scene/patch.h"
#include "scene/scene.h"
#include "scene/scene_index.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// A patch on its way from coarse to fine.
struct CoarseMesh {
  ProgressiveMesh mesh;
  Positions x;  ///< of the patch's vertices; those of removed ones mean nothing

  /// The patch as it is. Faces of tolerated pairs (of patch triangles) are on every level the same.
  CoarseMesh(const Patch& patch, std::span<const IntersectingPair> tolerated);
};

/// Simplifies the mesh until it has so many active faces, or as few as it can have. Returns how many it has.
std::size_t coarsen(CoarseMesh& coarse, const Patch& patch, double faces, const std::function<bool()>& stop);

/// The part (Patch::part_of) of each face of a mesh that the patch was made into; empty where the patch has none.
std::vector<Index> parts_of(const ProgressiveMesh& mesh, const Patch& patch);

/// A coarse mesh as it is now, as a scene of its own.
struct CoarseLevel {
  Scene scene;
  std::vector<Index> vertices;  ///< of the patch
};
CoarseLevel make_level(const CoarseMesh& coarse, const Patch& patch);

/// The coarse mesh takes the positions of the level.
void take_over(const CoarseLevel& level, CoarseMesh& coarse);

/// Those of a level's pairs that need not be resolved, sorted: the patch's `tolerated` ones, and where nothing may
/// move.
std::vector<IntersectingPair> tolerated_on(const CoarseLevel& level, std::span<const IntersectingPair> pairs,
                                           const CoarseMesh& coarse, std::span<const IntersectingPair> tolerated);

/// Recovers all that is not at rest, and some rings around it.
void recover_level(CoarseLevel& level, SceneIndex& index, const RecoverOptions& options,
                   const std::function<bool()>& stop);

}  // namespace unsnarl
