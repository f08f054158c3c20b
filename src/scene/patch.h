#pragma once

#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/types.h"
#include "scene/scene.h"
#include "scene/scene_index.h"

namespace unsnarl {

struct PatchProgress;
class Trajectory;

/// A region as a small surface of its own: free triangles and the obstacles around them.
/// Every solver works on patches and knows nothing of the surface they come from.
struct Patch {
  /// Vertices [0, free_count) may move; the rest never do.
  Index free_count = 0;
  /// Triangles [0, active_count) have a free vertex; the rest are obstacles nearby.
  Index active_count = 0;
  Positions rest;                   ///< where the vertices are in the input; for fixed ones equal to x
  Positions x;                      ///< where they are now
  std::vector<Triangle> triangles;  ///< of vertices of the patch
  std::vector<Index> vertices;      ///< patch vertex -> vertex of the whole, ascending within the free and the fixed
  std::vector<Index> faces;         ///< patch triangle -> triangle of the whole, ascending within active and obstacles
  std::vector<Index> part_of;       ///< as Scene::part_of, of the patch's triangles
  const PassingParts* parts = nullptr;  ///< as Scene::parts
  Solids solids;                        ///< those of its active triangles, whole ones
  double edge_length = 0;               ///< h: mean edge of the intersecting faces at rest (or of all active ones)
  Trajectory* trajectory = nullptr;     ///< where solvers record their iterations, or null; not owned
  PatchProgress* progress = nullptr;    ///< where solvers report their progress, or null; not owned

  /// Which of its triangles pass through each other.
  Passing passing() const { return part_of.empty() ? Passing() : Passing({}, part_of, *parts); }
};

/// The active triangles of each of the patch's solids.
std::vector<std::vector<Triangle>> triangles_of_solids(const Patch& patch);

/// Whether a solid of which triangles are active is turned inside out: its volume has the other sign than at rest.
bool turns_a_solid_inside_out(const Patch& patch);

/// Cuts out the patch with these free vertices (ascending, none fixed). Obstacles: all triangles within `reach` (a
/// length) of the box of an active triangle, but those that pass through all active ones. `edge_length` is left to the
/// caller.
Patch cut_patch(const Scene& scene, const SceneIndex& index, std::span<const Index> free_vertices, double reach);

/// Box of everything that cut_patch could include with this reach.
Box patch_box(const Scene& scene, std::span<const Index> free_vertices, double reach);

/// Copies the free vertices' positions into the scene; copies none if one is not finite (squares of coordinates beyond
/// 2^500 overflow).
void paste_patch(const Patch& patch, Scene& scene, SceneIndex& index);

}  // namespace unsnarl
