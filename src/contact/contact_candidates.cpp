#include "contact/contact_candidates.h"

#include "geometry/parallel_lists.h"

namespace unsnarl {
namespace {

Box box_of_edge(const Positions& x, Index a, Index b) {
  Box box;
  box.extend(Vec3(x.col(a)));
  box.extend(Vec3(x.col(b)));
  return box;
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
      boxes_(triangles.size()) {
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
      const Stencil stencil{StencilKind::vertex_face, {v, f[0], f[1], f[2]}};
      if (squared_distance(stencil, x) <= radius * radius) stencils.push_back(stencil);
    }
  }
  if (!(owned_corners_[a] & 56) || !(owned_corners_[b] & 56)) return;
  for (int k = 0; k < 3; ++k) {
    if (!(owned_corners_[a] & (8u << k))) continue;
    const Edge& e = edges_.edges[edges_.edges_of_triangle[a][k]];
    const Box box = box_of_edge(x, e[0], e[1]).inflated(radius);
    const bool e_moves = moves[e[0]] || moves[e[1]];
    for (int l = 0; l < 3; ++l) {
      if (!(owned_corners_[b] & (8u << l))) continue;
      const Edge& g = edges_.edges[edges_.edges_of_triangle[b][l]];
      if (e[0] == g[0] || e[0] == g[1] || e[1] == g[0] || e[1] == g[1]) continue;
      if (!e_moves && !moves[g[0]] && !moves[g[1]]) continue;
      if (!box.overlaps(box_of_edge(x, g[0], g[1]))) continue;
      const Stencil stencil{StencilKind::edge_edge, {e[0], e[1], g[0], g[1]}};
      if (squared_distance(stencil, x) <= radius * radius) stencils.push_back(stencil);
    }
  }
}

bool ContactCandidates::are_neighbours(const Stencil& stencil) const {
  bool shared = false;
  triangles_at_first(stencil, [&](Index s) {
    if (shared) return;
    triangles_at_second(stencil, [&](Index t) {
      for (Index v : triangles_[s]) shared |= has_corner(t, v);
    });
  });
  return shared;
}

}  // namespace unsnarl
