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
/// Cross products shorter than this are not made unit vectors: their squares may underflow.
constexpr double least_normal = 1e-140;

constexpr Index grain = 1024;  // triangles or edges a task

/// What is passed along an axis by points that start at `at` and move by up to `motion`.
struct Interval {
  double lo, hi;
  Interval(double at, double motion) : lo(at + std::min(0.0, motion)), hi(at + std::max(0.0, motion)) {}
  void extend(const Interval& other) {
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
  }
};

double gap(const Interval& a, const Interval& b) {
  return std::max(a.lo - b.hi, b.lo - a.hi);
}

/// Whether two edges stay farther apart than `length` along the normal of both while their vertices go along p, by
/// more than rounding may feign. `extent` bounds how far apart they are.
bool stay_apart_along_normal(double length, double extent, const Positions& x, const Positions& p, const Edge& e,
                             const Edge& g) {
  const Vec3 u = x.col(e[1]) - x.col(e[0]), v = x.col(g[1]) - x.col(g[0]);
  const Vec3 n = u.cross(v);
  const double at = n.dot(x.col(e[0]) - x.col(g[0]));
  Interval first(at, n.dot(p.col(e[0]))), second(0, n.dot(p.col(g[0])));
  first.extend({at, n.dot(p.col(e[1]))});
  second.extend({0, n.dot(p.col(g[1]))});
  const double apart = gap(first, second);
  // (a + b)^2 <= (1 + s) a^2 + (1 + 1/s) b^2 for the length along the normal a and the rounding b, s = 1/1000.
  const double error2 = rounding * rounding * extent * extent * u.squaredNorm() * v.squaredNorm();
  return apart > 0 && apart * apart > 1.001 * length * length * n.squaredNorm() + 1001 * error2;
}

}  // namespace

ContactCandidates::ContactCandidates(std::span<const Triangle> triangles, Index vertex_count)
    : triangles_(triangles),
      edges_(build_edges(triangles)),
      triangles_of_vertex_(triangles_of_vertices(triangles, vertex_count)),
      owned_corners_(triangles.size(), 0),
      boxes_(triangles.size()),
      slabs_(triangles.size()),
      balls_(edges_.edges.size()) {
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

void ContactCandidates::gather(const Positions& x, double radius, const MotionBounds& bounds,
                               std::span<const std::uint8_t> moves, std::vector<NearStencil>& stencils) {
  const Positions& along = bounds.along;
  const std::vector<double>& around = bounds.around;
  // What stands still needs no looking at, however much of it there is: only pairs with a moving triangle are visited.
  const Index triangle_count = static_cast<Index>(triangles_.size());
  moving_.resize(triangles_.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<Index>(0, triangle_count, grain), [&](const auto& range) {
    for (Index t = range.begin(); t < range.end(); ++t) {
      const Triangle& f = triangles_[t];
      moving_[t] = moves[f[0]] || moves[f[1]] || moves[f[2]];
      Slab& slab = slabs_[t];
      slab.around = std::max({around[f[0]], around[f[1]], around[f[2]]});
      Box& box = boxes_[t] = box_of(x, f);
      const Vec3 a = x.col(f[0]), b = x.col(f[1]), c = x.col(f[2]);
      const Vec3 p = along.col(f[0]), q = along.col(f[1]), r = along.col(f[2]);
      box.extend(Vec3(a + p));
      box.extend(Vec3(b + q));
      box.extend(Vec3(c + r));
      box = box.inflated(0.5 * radius + (1 + rounding) * slab.around);
      const Vec3 n = (b - a).cross(c - a);
      const double length = n.norm();
      slab.normal = length > least_normal ? Vec3(n / length) : Vec3::Zero();
      Interval range(0, slab.normal.dot(p));
      range.extend({slab.normal.dot(b - a), slab.normal.dot(q)});
      range.extend({slab.normal.dot(c - a), slab.normal.dot(r)});
      slab.lo = range.lo;
      slab.hi = range.hi;
    }
  });
  const Index edge_count = static_cast<Index>(edges_.edges.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<Index>(0, edge_count, grain), [&](const auto& range) {
    for (Index e = range.begin(); e < range.end(); ++e) {
      const auto [i, j] = edges_.edges[e];
      const Vec3 a = x.col(i), b = x.col(j), p = along.col(i), q = along.col(j);
      Ball& ball = balls_[e];
      ball.center = 0.5 * (a + b) + 0.25 * (p + q);
      const auto from_center = [&](const Vec3& point) { return (point - ball.center).squaredNorm(); };
      ball.radius = std::sqrt(std::max({from_center(a), from_center(b), from_center(a + p), from_center(b + q)}));
      ball.around = std::max(around[i], around[j]);
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
      [&](Index task, Index a, Index b) { gather_pair(x, radius, bounds, moves, a, b, lists[task]); });
  join_lists(lists, stencils);
}

void ContactCandidates::gather_pair(const Positions& x, double radius, const MotionBounds& bounds,
                                    std::span<const std::uint8_t> moves, Index a, Index b,
                                    std::vector<NearStencil>& stencils) const {
  const auto append = [&](const Stencil& stencil) {
    const Closest at = closest(stencil, x);
    const double least = least_distance(stencil, x, bounds, at.direction);
    if (least <= radius) stencils.push_back({stencil, at.distance, least});
  };
  const bool moving[2] = {moving_[a] != 0, moving_[b] != 0};
  const Index faces[2] = {a, b};
  for (int side = 0; side < 2; ++side) {
    const Index t = faces[side];
    const Index other = faces[1 - side];
    if (!(owned_corners_[t] & 7)) continue;
    const Triangle& f = triangles_[other];
    const Slab& slab = slabs_[other];
    for (int k = 0; k < 3; ++k) {
      const Index v = triangles_[t][k];
      if (!(owned_corners_[t] & (1u << k)) || has_corner(other, v)) continue;
      if (!moves[v] && !moving[1 - side]) continue;
      const double reach = radius + (bounds.around[v] + slab.around);
      // Stays farther from the plane than that: no need of the distance.
      const Vec3 p = bounds.along.col(v);
      const Vec3 to = x.col(v) - x.col(f[0]);
      const Interval range(slab.normal.dot(to), slab.normal.dot(p));
      const double needed = reach + rounding * (reach + to.norm());
      if (range.lo - slab.hi > needed || slab.lo - range.hi > needed) continue;
      Box box;
      box.extend(Vec3(x.col(v)));
      box.extend(Vec3(x.col(v) + p));
      if (!box.inflated(0.5 * radius + (1 + rounding) * bounds.around[v]).overlaps(boxes_[other])) continue;
      append({StencilKind::vertex_face, {v, f[0], f[1], f[2]}, {v, other}});
    }
  }
  if (!(owned_corners_[a] & 56) || !(owned_corners_[b] & 56)) return;
  for (int k = 0; k < 3; ++k) {
    if (!(owned_corners_[a] & (8u << k))) continue;
    const Index edge_a = edges_.edges_of_triangle[a][k];
    const Edge& e = edges_.edges[edge_a];
    const bool e_moves = moves[e[0]] || moves[e[1]];
    const Ball& ball = balls_[edge_a];
    for (int l = 0; l < 3; ++l) {
      if (!(owned_corners_[b] & (8u << l))) continue;
      const Index edge_b = edges_.edges_of_triangle[b][l];
      const Edge& g = edges_.edges[edge_b];
      if (e[0] == g[0] || e[0] == g[1] || e[1] == g[0] || e[1] == g[1]) continue;
      if (!e_moves && !moves[g[0]] && !moves[g[1]]) continue;
      const Ball& other = balls_[edge_b];
      const double reach = radius + (ball.around + other.around);
      const double most = (1 + rounding) * (ball.radius + other.radius + reach);
      if ((ball.center - other.center).squaredNorm() > most * most) continue;
      if (stay_apart_along_normal(reach, 2 * most, x, bounds.along, e, g)) continue;
      append({StencilKind::edge_edge, {e[0], e[1], g[0], g[1]}, {edge_a, edge_b}});
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
