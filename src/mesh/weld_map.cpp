#include "mesh/weld_map.h"

#include <numeric>

#include "mesh/coincident_faces.h"
#include "mesh/open_sides.h"
#include "mesh/position_classes.h"
#include "mesh/seam_edges.h"
#include "mesh/seam_vertices.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// See the declaration of identify for the steps.
std::vector<Index> glue_seams(const SurfaceView& surface, const std::vector<Index>& class_of) {
  UnionFind shells(surface.vertex_count()), glued(surface.vertex_count());
  for_each_side(surface, [&](Index, Index from, Index to) { shells.unite(from, to); });
  const std::vector<OpenSide> boundary = open_sides(surface, [](Index v) { return v; });
  const CoincidentFaces coincident(surface, class_of);
  glue_seam_edges(boundary, class_of, coincident, shells, glued);
  glue_seam_vertices(surface, boundary, class_of, coincident, shells, glued);
  return glued.dense_ids();
}

WeldMap from_classes(std::vector<Index> vertex_of) {
  WeldMap result;
  for (std::size_t v = 0; v < vertex_of.size(); ++v)
    if (vertex_of[v] == static_cast<Index>(result.first.size())) result.first.push_back(static_cast<Index>(v));
  result.count = static_cast<Index>(result.first.size());
  result.merged = vertex_of.size() - result.first.size();
  result.vertex_of = std::move(vertex_of);
  return result;
}

}  // namespace

WeldMap weld(const SurfaceView& surface, Weld weld, double tolerance) {
  switch (weld) {
    case Weld::none: {
      std::vector<Index> own(surface.vertex_count());
      std::iota(own.begin(), own.end(), Index{0});
      return from_classes(std::move(own));
    }
    case Weld::all: return from_classes(position_classes(surface.positions, tolerance));
    case Weld::seams: break;
  }
  return from_classes(glue_seams(surface, position_classes(surface.positions, tolerance)));
}

}  // namespace unsnarl
