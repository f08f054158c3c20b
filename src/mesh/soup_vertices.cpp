#include "mesh/soup_vertices.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/open_sides.h"

namespace unsnarl {
namespace {

using Vertices = std::span<const std::array<Index, 2>>;  // (welded vertex, vertex), sorted

/// Welds vertices at one place that share no two coincident faces.
void weld_at_one_place(Vertices vertices, const CoincidentFaces& coincident, UnionFind& welded) {
  struct Cluster {
    Index vertex;
    std::vector<CoincidentFaces::Corner> faces;
  };
  std::vector<Cluster> clusters;
  for (auto it = vertices.begin(); it != vertices.end();) {
    Cluster piece{(*it)[0], {}};
    for (; it != vertices.end() && (*it)[0] == piece.vertex; ++it) {
      const auto faces = coincident.corners_at((*it)[1]);
      piece.faces.insert(piece.faces.end(), faces.begin(), faces.end());
    }
    const auto fits = [&](const Cluster& cluster) {
      for (const CoincidentFaces::Corner& a : piece.faces)
        for (const CoincidentFaces::Corner& b : cluster.faces)
          if (a.set == b.set && a.face != b.face) return false;
      return true;
    };
    const auto cluster = std::find_if(clusters.begin(), clusters.end(), fits);
    if (cluster == clusters.end()) {
      clusters.push_back(std::move(piece));
    } else {
      welded.unite(cluster->vertex, piece.vertex);
      cluster->faces.insert(cluster->faces.end(), piece.faces.begin(), piece.faces.end());
    }
  }
}

}  // namespace

void weld_soup_vertices(const SurfaceView& surface, std::span<const Index> class_of, const CoincidentFaces& coincident,
                        UnionFind& welded) {
  const std::size_t n = surface.vertex_count();
  std::vector<std::uint8_t> is_open(n, 0);  // by welded vertex
  for (const OpenSide& side : open_sides(surface, [&](Index v) { return welded.find(v); }))
    is_open[welded.find(side.from)] = is_open[welded.find(side.to)] = 1;

  std::vector<std::array<Index, 3>> by_place;  // position class, welded vertex, vertex
  for (std::size_t i = 0; i < n; ++i) {
    const auto v = static_cast<Index>(i);
    if (is_open[welded.find(v)]) by_place.push_back({class_of[v], welded.find(v), v});
  }
  std::sort(by_place.begin(), by_place.end());
  std::vector<std::array<Index, 2>> vertices;
  for (auto it = by_place.begin(); it != by_place.end();) {
    const Index place = (*it)[0];
    vertices.clear();
    for (; it != by_place.end() && (*it)[0] == place; ++it) vertices.push_back({(*it)[1], (*it)[2]});
    if (vertices.size() > 1) weld_at_one_place(vertices, coincident, welded);
  }
}

}  // namespace unsnarl
