#include "mesh/weld_map.h"

#include <numeric>

#include "mesh/coincident_faces.h"
#include "mesh/open_sides.h"
#include "mesh/position_classes.h"
#include "mesh/seam_edges.h"
#include "mesh/soup_vertices.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// No vertex has two faces: the ids say nothing about what is connected.
bool is_soup(const SurfaceView& surface) {
  std::vector<Index> face_of(surface.vertex_count(), -1);
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (Index v : surface.face(f)) {
      if (face_of[v] >= 0 && face_of[v] != static_cast<Index>(f)) return false;
      face_of[v] = static_cast<Index>(f);
    }
  return true;
}

/// The steps are those of the declaration of weld.
std::vector<Index> weld_seams(const SurfaceView& surface, const std::vector<Index>& class_of) {
  UnionFind shells(surface.vertex_count()), welded(surface.vertex_count());
  for_each_side(surface, [&](Index, Index from, Index to) { shells.unite(from, to); });
  const std::vector<OpenSide> open = open_sides(surface, [](Index v) { return v; });
  const CoincidentFaces coincident(surface, class_of);
  const bool soup = is_soup(surface);
  weld_seam_edges(open, class_of, coincident, soup ? Ambiguous::weld : Ambiguous::keep_apart, shells, welded);
  if (soup) weld_soup_vertices(surface, class_of, coincident, welded);
  return welded.dense_ids();
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
  return from_classes(weld_seams(surface, position_classes(surface.positions, tolerance)));
}

}  // namespace unsnarl
