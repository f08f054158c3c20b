#include "untangle/coarse/coarse_level.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/sort_unique.h"
#include "recover/recover_regions.h"
#include "scene/recorder.h"
#include "untangle/conflict_regions.h"

namespace unsnarl {
namespace {

/// A vertex is collapsed only onto one of its rank or above. Vertices of the border are fixed corners of active faces.
/// They keep its shape however coarse the mesh becomes: a border that came back far from where it ran would cut through
/// what has been untangled beside it. [E62]
enum Rank : std::uint8_t { free_vertex, obstacle, border };

std::vector<std::uint8_t> ranks_of(const Patch& patch, std::span<const IntersectingPair> tolerated) {
  std::vector<std::uint8_t> ranks(patch.vertices.size(), obstacle);
  std::fill(ranks.begin(), ranks.begin() + patch.free_count, free_vertex);
  for (Index t = 0; t < patch.active_count; ++t)
    for (const Index v : patch.triangles[t])
      if (v >= patch.free_count) ranks[v] = border;
  for (const IntersectingPair& pair : tolerated)
    for (const Index t : {pair.a, pair.b})
      for (const Index v : patch.triangles[t]) ranks[v] = ProgressiveMesh::stays;
  return ranks;
}

/// Makes the triangles those of the vertices that they use, numbered anew. Returns these vertices, ascending.
std::vector<Index> number_anew(std::vector<Triangle>& triangles, std::size_t vertex_count) {
  std::vector<Index> local(vertex_count, -1), vertices;
  for (const Triangle& t : triangles)
    for (const Index v : t) local[v] = 0;
  for (Index v = 0; v < static_cast<Index>(vertex_count); ++v)
    if (local[v] == 0) {
      local[v] = static_cast<Index>(vertices.size());
      vertices.push_back(v);
    }
  for (Triangle& t : triangles)
    for (Index& v : t) v = local[v];
  return vertices;
}

}  // namespace

CoarseMesh::CoarseMesh(const Patch& patch, std::span<const IntersectingPair> tolerated)
    : mesh(patch.triangles, ranks_of(patch, tolerated)), x(patch.x) {}

std::size_t coarsen(CoarseMesh& coarse, const Patch& patch, double faces, const std::function<bool()>& stop) {
  ProgressiveMesh& mesh = coarse.mesh;
  const auto active_faces = [&] { return mesh.count_below(patch.active_count); };
  while (static_cast<double>(active_faces()) > faces && !(stop && stop()))
    if (mesh.coarsen(patch.rest) == 0 && mesh.coarsen(patch.rest, CoarsenOptions::any_shape(border)) == 0) break;
  return active_faces();
}

CoarseLevel make_level(const CoarseMesh& coarse, const Patch& patch) {
  CoarseLevel level;
  std::vector<Triangle> triangles = coarse.mesh.triangles();
  level.vertices = number_anew(triangles, patch.vertices.size());
  const auto n = static_cast<Index>(level.vertices.size());
  Positions rest(3, n), x(3, n);
  std::vector<std::uint8_t> fixed(level.vertices.size());
  for (Index k = 0; k < n; ++k) {
    const Index v = level.vertices[k];
    rest.col(k) = patch.rest.col(v);
    x.col(k) = coarse.x.col(v);
    fixed[k] = v >= patch.free_count;
  }
  level.scene = make_scene(std::move(rest), std::move(triangles), std::move(fixed));
  level.scene.x = std::move(x);
  level.scene.parts = patch.parts;
  level.scene.part_of = parts_of(coarse.mesh, patch);
  return level;
}

std::vector<Index> parts_of(const ProgressiveMesh& mesh, const Patch& patch) {
  std::vector<Index> parts;
  if (!patch.part_of.empty())
    for (const Index t : mesh.faces()) parts.push_back(patch.part_of[t]);
  return parts;
}

void take_over(const CoarseLevel& level, CoarseMesh& coarse) {
  for (std::size_t k = 0; k < level.vertices.size(); ++k)
    coarse.x.col(level.vertices[k]) = level.scene.x.col(static_cast<Index>(k));
}

std::vector<IntersectingPair> tolerated_on(const CoarseLevel& level, std::span<const IntersectingPair> pairs,
                                           const CoarseMesh& coarse, std::span<const IntersectingPair> tolerated) {
  const Scene& scene = level.scene;
  const auto is_fixed = [&](Index t) {
    return std::all_of(scene.triangles[t].begin(), scene.triangles[t].end(), [&](Index v) { return scene.fixed[v]; });
  };
  std::vector<IntersectingPair> result;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(result),
               [&](const IntersectingPair& pair) { return is_fixed(pair.a) && is_fixed(pair.b); });
  const auto number = [&](Index face) { return static_cast<Index>(coarse.mesh.count_below(face)); };
  for (const IntersectingPair& pair : tolerated) result.push_back({number(pair.a), number(pair.b), pair.kind});
  sort_unique(result);
  return result;
}

void recover_level(CoarseLevel& level, SceneIndex& index, const RecoverOptions& options,
                   const std::function<bool()>& stop) {
  std::vector<Index> moved;
  for (Index v = 0; v < level.scene.vertex_count(); ++v)
    if (level.scene.x.col(v) != level.scene.rest.col(v)) moved.push_back(v);
  RecoverRegionsOptions recovery;
  recovery.recover = options;
  recovery.recover.unflip_rounds = 0;  // faces of a coarse mesh are not those of the surface
  recovery.min_gap = [](std::span<const Index>) { return 0.0; };
  recovery.stop = [&] { return stop && stop(); };
  Recorder nobody({}, level.scene.x);
  recover_regions(level.scene, index, {dilate(level.scene, moved, recovery_rings)}, recovery, nobody);
}

}  // namespace unsnarl
