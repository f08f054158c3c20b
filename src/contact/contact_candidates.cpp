#include "contact/contact_candidates.h"

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

void ContactCandidates::gather(const Positions& x, double radius, std::span<const std::uint8_t> moves,
                               std::vector<Stencil>& stencils) {
  for (std::size_t t = 0; t < triangles_.size(); ++t) boxes_[t] = box_of(x, triangles_[t]).inflated(0.5 * radius);
  if (built_) {
    bvh_.refit(boxes_);
  } else {
    bvh_.build(boxes_);
    built_ = true;
  }
  for (std::size_t e = 0; e < edges_.edges.size(); ++e) {
    const Vec3 a = x.col(edges_.edges[e][0]), b = x.col(edges_.edges[e][1]);
    edge_middle_[e] = 0.5 * (a + b);
    edge_radius_[e] = 0.5 * (b - a).norm();
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 a = x.col(triangles_[t][0]), b = x.col(triangles_[t][1]), c = x.col(triangles_[t][2]);
    const Vec3 n = (b - a).cross(c - a);
    const double length = n.norm();
    const bool reliable = length > least_sine * (b - a).norm() * (c - a).norm();
    normal_[t] = reliable ? Vec3(n / length) : Vec3::Zero();
  }
  // One query per moving triangle: what stands still needs no looking at, however much of it there is.
  moving_.assign(triangles_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Triangle& f = triangles_[t];
    moving_[t] = moves[f[0]] || moves[f[1]] || moves[f[2]];
  }
  constexpr Index chunk = 256;  // triangles a task
  gather_in_chunks(static_cast<Index>(triangles_.size()), chunk, stencils,
                   [&](Index begin, Index end, std::vector<Stencil>& list) {
                     for (Index t = begin; t < end; ++t) {
                       if (!moving_[t]) continue;
                       bvh_.query(boxes_[t], [&](Index other) {
                         if (other > t || (other < t && !moving_[other])) gather_pair(x, radius, moves, t, other, list);
                       });
                     }
                   });
}

void ContactCandidates::gather_pair(const Positions& x, double radius, std::span<const std::uint8_t> moves, Index a,
                                    Index b, std::vector<Stencil>& stencils) const {
  const bool moving[2] = {moving_[a] != 0, moving_[b] != 0};
  const Index faces[2] = {a, b};
  for (int side = 0; side < 2; ++side) {
    const Index t = faces[side];
    const Index other = faces[1 - side];
    if (!(owned_corners_[t] & 7)) continue;
    const Triangle& f = triangles_[other];
    const Box box = box_of(x, f);
    for (int k = 0; k < 3; ++k) {
      const Index v = triangles_[t][k];
      if (!(owned_corners_[t] & (1u << k)) || has_corner(other, v)) continue;
      if (!moves[v] && !moving[1 - side]) continue;
      if (!point_near(x.col(v), box, radius)) continue;
      // Farther from the plane than the radius: no need of the distance.
      const Vec3 to = x.col(v) - x.col(f[0]);
      if (std::abs(normal_[other].dot(to)) > radius + rounding * (radius + to.norm())) continue;
      const Stencil stencil{StencilKind::vertex_face, {v, f[0], f[1], f[2]}, {v, other}};
      if (squared_distance(stencil, x) <= radius * radius) stencils.push_back(stencil);
    }
  }
  if (!(owned_corners_[a] & 56) || !(owned_corners_[b] & 56)) return;
  for (int k = 0; k < 3; ++k) {
    if (!(owned_corners_[a] & (8u << k))) continue;
    const Index edge_a = edges_.edges_of_triangle[a][k];
    const Edge& e = edges_.edges[edge_a];
    const bool e_moves = moves[e[0]] || moves[e[1]];
    for (int l = 0; l < 3; ++l) {
      if (!(owned_corners_[b] & (8u << l))) continue;
      const Index edge_b = edges_.edges_of_triangle[b][l];
      const Edge& g = edges_.edges[edge_b];
      if (e[0] == g[0] || e[0] == g[1] || e[1] == g[0] || e[1] == g[1]) continue;
      if (!e_moves && !moves[g[0]] && !moves[g[1]]) continue;
      const double most = (1 + rounding) * (edge_radius_[edge_a] + edge_radius_[edge_b] + radius);
      if ((edge_middle_[edge_a] - edge_middle_[edge_b]).squaredNorm() > most * most) continue;
      const Stencil stencil{StencilKind::edge_edge, {e[0], e[1], g[0], g[1]}, {edge_a, edge_b}};
      if (squared_distance(stencil, x) <= radius * radius) stencils.push_back(stencil);
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
