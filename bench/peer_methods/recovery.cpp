#include "recovery.h"

#include <vector>

#include "mesh/areas.h"
#include "recover/recover.h"
#include "scene/patch.h"

namespace unsnarl::peers {

void recover_towards_rest(const PreparedSurface& prepared, Positions& x, const std::function<bool()>& stop) {
  Scene scene = make_scene(prepared.rest, prepared.triangulation.triangles,
                           std::vector<std::uint8_t>(prepared.weld_map.count, 0));
  std::vector<Index> free;
  for (Index v = 0; v < scene.vertex_count(); ++v)
    if (!scene.triangles_of_vertex[v].empty()) free.push_back(v);
  SceneIndex index(scene);
  Patch patch = cut_patch(scene, index, free, 0);
  patch.edge_length = mean_edge_length(scene.rest, scene.triangles);
  for (Index v = 0; v < patch.x.cols(); ++v) patch.x.col(v) = x.col(patch.vertices[v]);
  RecoverOptions options = RecoverOptions::paper();
  options.min_gap = 1e-6 * patch.rest.cwiseAbs().maxCoeff();  // a few units in the last place of float32
  recover(patch, options, stop);
  for (Index v = 0; v < patch.free_count; ++v) x.col(patch.vertices[v]) = patch.x.col(v);
}

}  // namespace unsnarl::peers
