#include "contact/contact_candidates.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/parallel_lists.h"

namespace unsnarl {
namespace {

/// What rounding may add to a length relative to it, with much to spare.
constexpr double rounding = 1e-9;
/// Normals are trusted where the sine of the angle at the first corner exceeds this: then their error is below
/// `rounding`.
constexpr double least_sine = 1e-6;

constexpr Index grain = 1024;  // triangles or edges a task

/// Whether the lines of two edges are farther apart than `length`, by more than rounding may feign.
bool lines_farther_than(double length, const Positions& x, const Edge& e, const Edge& g) {
  const Vec3 u = x.col(e[1]) - x.col(e[0]), v = x.col(g[1]) - x.col(g[0]), r = x.col(e[0]) - x.col(g[0]);
  const Vec3 n = u.cross(v);
  const double along = n.dot(r);
  // (a + b)^2 <= (1 + s) a^2 + (1 + 1/s) b^2 for the length along the normal a and the rounding b, s = 1/1000.
  const double error2 = rounding * rounding * r.squaredNorm() * u.squaredNorm() * v.squaredNorm();
  return along * along > 1.001 * length * length * n.squaredNorm() + 1001 * error2;
}

bool point_near(const Vec3& p, const Box& box, double radius) {
  return (p.array() >= box.lo.array() - radius).all() && (p.array() <= box.hi.array() + radius).all();
}

}  // namespace

ContactCandidates::ContactCandidates(std::span<const Triangle> triangles, Index vertex_count)
    : triangles_(triangles),
      edges_(build_edges(triangles)),
      triangles_of_vertex_(triangles_of_vertices(triangles, vertex_count)),
      owned_corners_(triangles.size(), 0),
      boxes_(triangles.size()),
      edge_middle_(edges_.edges.size()),
      edge_radius_(edges_.edges.size()),
      normal_(triangles.size()) {
  std::vector<std::uint8_t> vertex_seen(static_cast<std::size_t>(vertex_count), 0);
  std::vector<std::uint8_t> edge_seen(edges_.edges.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      std::uint8_t& vertex = vertex_seen[triangles[t][k]];
      if (!vertex) owned_corners_[t] |= static_cast<std::uint8_t>(1u << k);
      vertex = 1;
      const Index e = edges_.edges_of_triangle[t][k];
      if (e < 0) continue;
      if (!edge_seen[e]) owned_corners_[t] |= static_cast<std::uint8_t>(8u << k);
      edge_seen[e] = 1;
    }
  }
  auto list_corners = [&](IndexLists& lists, std::span<const Index> around) {
    const std::size_t begin = lists.items.size();
    for (Index t : around) lists.items.insert(lists.items.end(), triangles[t].begin(), triangles[t].end());
    std::sort(lists.items.begin() + begin, lists.items.end());
    lists.items.erase(std::unique(lists.items.begin() + begin, lists.items.end()), lists.items.end());
    lists.offsets.push_back(static_cast<Index>(lists.items.size()));
  };
  for (Index v = 0; v < vertex_count; ++v) list_corners(around_vertex_, triangles_of_vertex_[v]);
  for (Index e = 0; e < edges_.triangles_of_edge.size(); ++e) list_corners(around_edge_, edges_.triangles_of_edge[e]);
}

void ContactCandidates::gather(const Positions& x, double radius, std::span<const double> allowance,
                               std::span<const std::uint8_t> moves, std::vector<NearStencil>& stencils) {
  // What stands still needs no looking at, however much of it there is: only pairs with a moving triangle are visited.
  const Index triangle_count = static_cast<Index>(triangles_.size());
  moving_.resize(triangles_.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<Index>(0, triangle_count, grain), [&](const auto& range) {
    for (Index t = range.begin(); t < range.end(); ++t) {
      const Triangle& f = triangles_[t];
      moving_[t] = moves[f[0]] || moves[f[1]] || moves[f[2]];
      const double room = std::max({allowance[f[0]], allowance[f[1]], allowance[f[2]]});
      boxes_[t] = box_of(x, f).inflated(0.5 * radius + (1 + rounding) * room);
      const Vec3 a = x.col(f[0]), b = x.col(f[1]), c = x.col(f[2]);
      const Vec3 n = (b - a).cross(c - a);
      const double length = n.norm();
      const bool reliable = length > least_sine * (b - a).norm() * (c - a).norm();
      normal_[t] = reliable ? Vec3(n / length) : Vec3::Zero();
    }
  });
  const Index edge_count = static_cast<Index>(edges_.edges.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<Index>(0, edge_count, grain), [&](const auto& range) {
    for (Index e = range.begin(); e < range.end(); ++e) {
      const Vec3 a = x.col(edges_.edges[e][0]), b = x.col(edges_.edges[e][1]);
      edge_middle_[e] = 0.5 * (a + b);
      edge_radius_[e] = 0.5 * (b - a).norm();
    }
  });
  if (built_) {
    bvh_.refit(boxes_);
  } else {
    bvh_.build(boxes_);
    built_ = true;
  }
  bvh_.watch(moving_);
  std::vector<std::vector<NearStencil>> lists(bvh_.task_count());
  bvh_.self_pairs_parallel(
      [&](Index task, Index a, Index b) { gather_pair(x, radius, allowance, moves, a, b, lists[task]); });
  join_lists(lists, stencils);
}

void ContactCandidates::gather_pair(const Positions& x, double radius, std::span<const double> allowance,
                                    std::span<const std::uint8_t> moves, Index a, Index b,
                                    std::vector<NearStencil>& stencils) const {
  const bool moving[2] = {moving_[a] != 0, moving_[b] != 0};
  const Index faces[2] = {a, b};
  for (int side = 0; side < 2; ++side) {
    const Index t = faces[side];
    const Index other = faces[1 - side];
    if (!(owned_corners_[t] & 7)) continue;
    const Triangle& f = triangles_[other];
    const double room = std::max({allowance[f[0]], allowance[f[1]], allowance[f[2]]});
    for (int k = 0; k < 3; ++k) {
      const Index v = triangles_[t][k];
      if (!(owned_corners_[t] & (1u << k)) || has_corner(other, v)) continue;
      if (!moves[v] && !moving[1 - side]) continue;
      const double reach = radius + (allowance[v] + room);
      // Farther from the plane than that: no need of the distance.
      const Vec3 to = x.col(v) - x.col(f[0]);
      if (std::abs(normal_[other].dot(to)) > reach + rounding * (reach + to.norm())) continue;
      if (!point_near(x.col(v), box_of(x, f), reach)) continue;
      const Stencil stencil{StencilKind::vertex_face, {v, f[0], f[1], f[2]}, {v, other}};
      const double squared = squared_distance(stencil, x);
      if (squared <= reach * reach) stencils.push_back({stencil, std::sqrt(squared)});
    }
  }
  if (!(owned_corners_[a] & 56) || !(owned_corners_[b] & 56)) return;
  for (int k = 0; k < 3; ++k) {
    if (!(owned_corners_[a] & (8u << k))) continue;
    const Index edge_a = edges_.edges_of_triangle[a][k];
    const Edge& e = edges_.edges[edge_a];
    const bool e_moves = moves[e[0]] || moves[e[1]];
    const double room = std::max(allowance[e[0]], allowance[e[1]]);
    for (int l = 0; l < 3; ++l) {
      if (!(owned_corners_[b] & (8u << l))) continue;
      const Index edge_b = edges_.edges_of_triangle[b][l];
      const Edge& g = edges_.edges[edge_b];
      if (e[0] == g[0] || e[0] == g[1] || e[1] == g[0] || e[1] == g[1]) continue;
      if (!e_moves && !moves[g[0]] && !moves[g[1]]) continue;
      const double reach = radius + (room + std::max(allowance[g[0]], allowance[g[1]]));
      const double most = (1 + rounding) * (edge_radius_[edge_a] + edge_radius_[edge_b] + reach);
      if ((edge_middle_[edge_a] - edge_middle_[edge_b]).squaredNorm() > most * most) continue;
      const Stencil stencil{StencilKind::edge_edge, {e[0], e[1], g[0], g[1]}, {edge_a, edge_b}};
      if (lines_farther_than(reach, x, e, g)) continue;
      const double squared = squared_distance(stencil, x);
      if (squared <= reach * reach) stencils.push_back({stencil, std::sqrt(squared)});
    }
  }
}

bool ContactCandidates::are_neighbours(const Stencil& stencil) const {
  const auto [first, second] = stencil.primitives;
  if (stencil.kind == StencilKind::vertex_face) {
    const std::span<const Index> around = around_vertex_[first];
    const Triangle& f = triangles_[second];
    return std::any_of(f.begin(), f.end(),
                       [&](Index v) { return std::binary_search(around.begin(), around.end(), v); });
  }
  const std::span<const Index> a = around_edge_[first], b = around_edge_[second];
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace unsnarl
