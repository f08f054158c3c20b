#include "untangle/coarse_scene.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "contact/distances.h"
#include "mesh/adjacency.h"
#include "mesh/simplification.h"

namespace unsnarl {
namespace {

constexpr std::size_t fewer = 4;    // times fewer triangles: edges twice as long
constexpr double tolerance = 0.25;  // h: how far the coarse surface may lie from the fine one
constexpr double worthwhile = 0.5;  // share of the triangles: with more left it is hardly cheaper

/// For every vertex the kept one that is fewest edges away (the first of these in the order of the search); -1 where
/// there is none.
std::vector<Index> nearest_kept(const IndexLists& neighbours, std::span<const std::uint8_t> kept) {
  std::vector<Index> nearest(kept.size(), -1);
  std::vector<Index> front, next;
  for (Index v = 0; v < static_cast<Index>(kept.size()); ++v)
    if (kept[v]) {
      nearest[v] = v;
      front.push_back(v);
    }
  while (!front.empty()) {
    next.clear();
    for (const Index v : front)
      for (const Index w : neighbours[v])
        if (nearest[w] < 0) {
          nearest[w] = nearest[v];
          next.push_back(w);
        }
    front.swap(next);
  }
  return nearest;
}

}  // namespace

std::optional<CoarseScene> CoarseScene::of(const Patch& patch) {
  const auto active_count = static_cast<std::size_t>(patch.active_count);
  const std::span<const Triangle> active(patch.triangles.data(), active_count);
  std::vector<Triangle> triangles = simplify(patch.x, active, active_count / fewer, tolerance * patch.edge_length);
  if (static_cast<double>(triangles.size()) > worthwhile * static_cast<double>(active_count)) return {};
  const std::size_t coarse_count = triangles.size();
  triangles.insert(triangles.end(), patch.triangles.begin() + patch.active_count, patch.triangles.end());

  const Index n = static_cast<Index>(patch.x.cols());
  std::vector<std::uint8_t> kept(n, 0);
  for (const Triangle& t : triangles)
    for (const Index v : t) kept[v] = 1;
  std::vector<Index> local(n, -1), vertices;
  for (Index v = 0; v < n; ++v)
    if (kept[v]) {
      local[v] = static_cast<Index>(vertices.size());
      vertices.push_back(v);
    }
  Positions x(3, static_cast<Index>(vertices.size()));
  std::vector<std::uint8_t> fixed(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    x.col(k) = patch.x.col(vertices[k]);
    fixed[k] = vertices[k] >= patch.free_count;
  }
  std::vector<Triangle> renumbered = triangles;
  for (Triangle& t : renumbered)
    for (Index& v : t) v = local[v];

  CoarseScene result;
  result.scene_ = make_scene(std::move(x), std::move(renumbered), std::move(fixed));
  // On the coarse triangles around the kept vertices nearest along the surface: the nearest ones in space may be of
  // another sheet.
  const IndexLists neighbours = vertex_neighbours(build_edges(active).edges, n);
  const std::vector<Index> nearest = nearest_kept(neighbours, kept);
  const IndexLists around = triangles_of_vertices({triangles.data(), coarse_count}, n);
  result.places_.resize(patch.free_count);
  oneapi::tbb::parallel_for(Index{0}, patch.free_count, [&](Index v) {
    Place& place = result.places_[v];
    place = {{0, 0, 0}, Vec3::Zero()};
    if (kept[v]) {
      place = {{local[v], local[v], local[v]}, Vec3(1, 0, 0)};
      return;
    }
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](Index near) {
      if (near < 0) return;
      for (const Index t : around[near]) {
        const Triangle& f = triangles[t];
        const Closest c = closest_vertex_face(patch.x.col(v), patch.x.col(f[0]), patch.x.col(f[1]), patch.x.col(f[2]));
        if (!(c.distance < least)) continue;
        least = c.distance;
        place = {{local[f[0]], local[f[1]], local[f[2]]}, -Vec3(c.weights[1], c.weights[2], c.weights[3])};
      }
    };
    look_at(nearest[v]);
    for (const Index w : neighbours[v]) look_at(nearest[w]);
  });
  return result;
}

void CoarseScene::carry(const Positions& x, Patch& patch) const {
  for (Index v = 0; v < patch.free_count; ++v) {
    const Place& place = places_[v];
    for (int k = 0; k < 3; ++k)
      if (place.weights[k] != 0)
        patch.x.col(v) += place.weights[k] * (x.col(place.corners[k]) - scene_.rest.col(place.corners[k]));
  }
}

}  // namespace unsnarl
