#include "contact/contact_candidates.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/stop_check.h"
#include "geometry/parallel_lists.h"
#include "geometry/parallel_sums.h"

namespace unsnarl {
namespace {

/// Rounding changes a length by less than this, with a wide reserve (unit: share of the length)
constexpr double length_rounding = 1e-9;
/// Shorter cross products are not made unit vectors, since their squares may underflow (unit: squared length)
constexpr double least_normal = 1e-140;

/// Pairs of triangles that are gathered between two looks at the clock, about a tenth of a second (unit: pairs)
constexpr std::uint32_t candidates_between_looks = 1 << 15;
/// A task of a parallel loop has this many triangles or edges (unit: primitives)
constexpr Index primitives_a_task = 1024;

/// Interval along an axis that a point covers which starts at `at` and moves by `motion`.
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

/// Interval along an axis that three points cover, from an origin, which move by these motions.
Interval interval_along(const Vec3& axis, const std::array<Vec3, 3>& from_origin, const std::array<Vec3, 3>& motion) {
  Interval all(axis.dot(from_origin[0]), axis.dot(motion[0]));
  for (int k = 1; k < 3; ++k) all.extend({axis.dot(from_origin[k]), axis.dot(motion[k])});
  return all;
}

/// The longest of a triangle's edges, of which these are the first and the last, from the first corner.
Vec3 longest_edge(const Vec3& ab, const Vec3& ac) {
  const Vec3 bc = ac - ab;
  const double ab2 = ab.squaredNorm(), ac2 = ac.squaredNorm(), bc2 = bc.squaredNorm();
  if (ab2 >= std::max(ac2, bc2)) return ab;
  return ac2 >= bc2 ? ac : bc;
}

/// A vector made a unit vector, or zero where it is so short that its length means nothing.
Vec3 unit_or_zero(const Vec3& v, double shortest) {
  const double length = v.norm();
  return length > shortest ? Vec3(v / length) : Vec3::Zero();
}

/// Whether two edges stay farther apart than `length` along their common normal while their vertices move by p, beyond
/// doubt from rounding.
bool stay_apart_along_normal(double length, const Positions& x, const Positions& p, const Edge& e, const Edge& g) {
  const Vec3 u = x.col(e[1]) - x.col(e[0]), v = x.col(g[1]) - x.col(g[0]), r = x.col(e[0]) - x.col(g[0]);
  const Vec3 n = u.cross(v);
  const double at = n.dot(r);
  Interval first(at, n.dot(p.col(e[0]))), second(0, n.dot(p.col(g[0])));
  first.extend({at, n.dot(p.col(e[1]))});
  second.extend({0, n.dot(p.col(g[1]))});
  const double apart = gap(first, second);
  // (a + b)^2 <= (1 + s) a^2 + (1 + 1/s) b^2 for the length along the normal a and the rounding b, s = 1/1000.
  constexpr double length_factor = 1.001;   ///< 1 + s (fixed by s)
  constexpr double rounding_factor = 1001;  ///< 1 + 1/s (fixed by s)
  const double u2 = u.squaredNorm(), v2 = v.squaredNorm();
  const double p2 = std::max(
      {p.col(e[0]).squaredNorm(), p.col(e[1]).squaredNorm(), p.col(g[0]).squaredNorm(), p.col(g[1]).squaredNorm()});
  const double extent2 = 4 * (u2 + v2 + r.squaredNorm() + 4 * p2);
  const double error2 = length_rounding * length_rounding * extent2 * u2 * v2;
  return apart > 0 && apart * apart > length_factor * length * length * n.squaredNorm() + rounding_factor * error2;
}

/// Bit 3 k + l: corner k of a is corner l of b.
unsigned equal_corners(const FourIndices& a, const FourIndices& b) {
  unsigned equal = 0;
  for (int k = 0; k < 3; ++k) equal |= (bits_of(b == four_times(a[k])) & 7u) << (3 * k);
  return equal;
}

/// For the corners that two triangles share: the edges with a common end, and the shared corners.
struct Shared {
  std::uint16_t edges = 0;     // bit 3 k + l: edge k of a has an end in common with edge l of b
  std::uint8_t corners_a = 0;  // bit k: corner k of a is one of b
  std::uint8_t corners_b = 0;
};
constexpr std::array<Shared, 512> shared_of_corners = [] {
  std::array<Shared, 512> table;
  for (unsigned equal = 0; equal < 512; ++equal)
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        if (!(equal >> (3 * k + l) & 1u)) continue;
        Shared& shared = table[equal];
        shared.corners_a |= 1u << k;
        shared.corners_b |= 1u << l;
        for (int i : {k, (k + 2) % 3})
          for (int j : {l, (l + 2) % 3}) shared.edges |= 1u << (3 * i + j);
      }
  return table;
}();

/// Calls visit(k) for every bit k, ascending.
template <class Visit>
void for_bits(unsigned bits, Visit&& visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

}  // namespace

ContactCandidates::ContactCandidates(std::span<const Triangle> triangles, Index vertex_count)
    : triangles_(triangles),
      edges_(build_edges(triangles)),
      triangles_of_vertex_(triangles_of_vertices(triangles, vertex_count)),
      owned_corners_(triangles.size(), 0),
      boxes_(triangles.size()),
      slabs_(triangles.size()),
      reach_(triangles.size()) {
  std::vector<std::uint8_t> vertex_seen(static_cast<std::size_t>(vertex_count), 0);
  std::vector<std::uint8_t> edge_seen(edges_.edges.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    corners_.push_back(FourIndices{triangles[t][0], triangles[t][1], triangles[t][2], -1});
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

void ContactCandidates::update_triangle(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                                        Index t) {
  const Triangle& f = triangles_[t];
  Slabs& slabs = slabs_[t];
  slabs.around = std::max({bounds.around[f[0]], bounds.around[f[1]], bounds.around[f[2]]});
  slabs.radius = std::max({radius[f[0]], radius[f[1]], radius[f[2]]});
  std::array<Box, 3> ways;  // of the corners
  Box box;
  for (int k = 0; k < 3; ++k) {
    const Vec3 at = x.col(f[k]);
    ways[k].extend(at);
    ways[k].extend(Vec3(at + bounds.along.col(f[k])));
    box.extend(ways[k]);
  }
  const auto reaching = [&](const Box& way, double radius_there, double around) {
    return way.inflated(0.5 * radius_there + (1 + length_rounding) * around);
  };
  boxes_[t] = reaching(box, slabs.radius, slabs.around);
  Reach& reach = reach_[t];
  reach.corners.set(3, RoundedBox(boxes_[t]));
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const bool owns_corner = owned_corners_[t] & (1u << k), owns_edge = owned_corners_[t] & (8u << k);
    reach.corners.set(k, owns_corner ? RoundedBox(reaching(ways[k], radius[f[k]], bounds.around[f[k]])) : RoundedBox());
    Box edge;
    if (owns_edge) {
      edge.extend(ways[k]);
      edge.extend(ways[l]);
      edge = reaching(edge, std::max(radius[f[k]], radius[f[l]]), std::max(bounds.around[f[k]], bounds.around[f[l]]));
    }
    reach.edges.set(k, RoundedBox(edge));
  }
  const Vec3 ab = x.col(f[1]) - x.col(f[0]), ac = x.col(f[2]) - x.col(f[0]);
  const std::array<Vec3, 3> corners = {Vec3::Zero(), ab, ac};
  const std::array<Vec3, 3> motion = {bounds.along.col(f[0]), bounds.along.col(f[1]), bounds.along.col(f[2])};
  const auto slab_along = [&](const Vec3& axis) {
    const Interval range = interval_along(axis, corners, motion);
    return Slab{axis, range.lo, range.hi};
  };
  slabs.normal = slab_along(unit_or_zero(ab.cross(ac), least_normal));
  slabs.across = slab_along(unit_or_zero(slabs.normal.axis.cross(longest_edge(ab, ac)), 0));
}

void ContactCandidates::start(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                              std::span<const std::uint8_t> moves) {
  // Only pairs with a moving triangle are visited, so that the cost does not grow with what stands still.
  const Index triangle_count = static_cast<Index>(triangles_.size());
  moving_.resize(triangles_.size());
  for_chunks(triangle_count, primitives_a_task, [&](Index begin, Index end) {
    for (Index t = begin; t < end; ++t) {
      const Triangle& f = triangles_[t];
      moving_[t] = moves[f[0]] || moves[f[1]] || moves[f[2]];
      update_triangle(x, radius, bounds, t);
    }
  });
  if (built_) {
    bvh_.refit(boxes_);
  } else {
    bvh_.build(boxes_);
    built_ = true;
  }
  bvh_.set_active(moving_);
}

void ContactCandidates::start_around(std::span<const Index> vertices, const Positions& x,
                                     std::span<const double> radius, const MotionBounds& bounds) {
  around_.assign(around_vertex_.size(), 0);
  std::fill(moving_.begin(), moving_.end(), std::uint8_t{0});
  std::vector<Index> touched;
  for (Index v : vertices) {
    around_[v] = 1;
    for (Index t : triangles_of_vertex_[v]) {
      if (!moving_[t]) touched.push_back(t);
      moving_[t] = 1;
    }
  }
  for_chunks(static_cast<Index>(touched.size()), primitives_a_task, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) update_triangle(x, radius, bounds, touched[k]);
  });
  bvh_.refit(boxes_, touched);
  bvh_.set_only_active(touched);
}

bool ContactCandidates::visit_active(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                                     std::span<const std::uint8_t> moves, const OnStencil& on_stencil,
                                     const std::function<bool()>& stop, const ListLimit& limit) const {
  std::atomic<std::size_t> found{0};
  StopCheck check(stop, static_cast<std::size_t>(bvh_.task_count()), candidates_between_looks);
  bvh_.self_pairs_parallel([&](Index task, Index a, Index b) {
    check.step(task);
    if (found.load(std::memory_order_relaxed) > limit.most) return;
    const std::size_t here = visit_pair(x, radius, bounds, moves, a, b, task, on_stencil, limit.counts_listed);
    if (here > 0) found.fetch_add(here, std::memory_order_relaxed);
  });
  return found <= limit.most;
}

bool ContactCandidates::stays_beyond(const Positions& x, const MotionBounds& bounds, Index a, Index b) const {
  const Slabs &slabs = slabs_[a], &others = slabs_[b];
  const Triangle& g = triangles_[b];
  const Vec3 origin = x.col(triangles_[a][0]);
  const std::array<Vec3, 3> corners = {x.col(g[0]) - origin, x.col(g[1]) - origin, x.col(g[2]) - origin};
  const std::array<Vec3, 3> motion = {bounds.along.col(g[0]), bounds.along.col(g[1]), bounds.along.col(g[2])};
  const double reach = 0.5 * (slabs.radius + others.radius) + (slabs.around + others.around);
  double size = 0;
  for (const Vec3& corner : corners) size += corner.cwiseAbs().sum();
  const double least = reach + length_rounding * (reach + size);
  const auto is_beyond = [&](const Slab& slab) {
    const Interval range = interval_along(slab.axis, corners, motion);
    return std::max(range.lo - slab.hi, slab.lo - range.hi) > least;
  };
  return is_beyond(slabs.normal) || is_beyond(slabs.across);
}

std::size_t ContactCandidates::visit_pair(const Positions& x, std::span<const double> radius,
                                          const MotionBounds& bounds, std::span<const std::uint8_t> moves, Index a,
                                          Index b, Index task, const OnStencil& on_stencil, bool counts_listed) const {
  std::size_t found = 0;
  const auto visit = [&](const Stencil& stencil) {
    const Closest at = closest(stencil, x);
    const double least = least_distance(stencil, x, bounds, at.direction);
    if (!(least <= radius_of(stencil, radius))) return;
    const bool is_listed = on_stencil(task, {stencil, at.distance, at.direction, least});
    found += is_listed || !counts_listed;
  };
  const std::array<unsigned, 2> near_corners = {reach_[a].corners.overlapping(reach_[b].corners, 3) & 7u,
                                                reach_[b].corners.overlapping(reach_[a].corners, 3) & 7u};
  std::array<unsigned, 3> near_edges;  // of b, of each edge of a
  for (int k = 0; k < 3; ++k) near_edges[k] = reach_[b].edges.overlapping(reach_[a].edges, k) & 7u;
  if ((near_corners[0] | near_corners[1] | near_edges[0] | near_edges[1] | near_edges[2]) == 0) return 0;
  const unsigned equal = equal_corners(corners_[a], corners_[b]);
  if (equal == 0 && (stays_beyond(x, bounds, a, b) || stays_beyond(x, bounds, b, a))) return 0;
  const Shared& shared = shared_of_corners[equal];
  const auto gather_corners = [&](Index t, Index other, unsigned near) {
    const Triangle& f = triangles_[other];
    const Slabs& slabs = slabs_[other];
    for_bits(near, [&](int k) {
      const Index v = triangles_[t][k];
      if (!moves[v] && !moving_[other]) return;
      // Farther from the plane than the radius: the distance is not needed.
      const double reach = 0.5 * (radius[v] + slabs.radius) + (bounds.around[v] + slabs.around);
      const Vec3 to = x.col(v) - x.col(f[0]);
      const Slab& slab = slabs.normal;
      const Interval range(slab.axis.dot(to), slab.axis.dot(bounds.along.col(v)));
      if (std::max(range.lo - slab.hi, slab.lo - range.hi) > reach + length_rounding * (reach + to.cwiseAbs().sum()))
        return;
      visit(stencil_of(StencilKind::vertex_face, {v, other}));
    });
  };
  gather_corners(a, b, near_corners[0] & ~shared.corners_a);
  gather_corners(b, a, near_corners[1] & ~shared.corners_b);
  for (int k = 0; k < 3; ++k) {
    for_bits(near_edges[k] & ~(shared.edges >> (3 * k)), [&](int l) {
      const Index edge_a = edges_.edges_of_triangle[a][k], edge_b = edges_.edges_of_triangle[b][l];
      const Edge &e = edges_.edges[edge_a], &g = edges_.edges[edge_b];
      if (!moves[e[0]] && !moves[e[1]] && !moves[g[0]] && !moves[g[1]]) return;
      const auto most = [&](std::span<const double> of, const Edge& edge) {
        return std::max(of[edge[0]], of[edge[1]]);
      };
      const double reach =
          0.5 * (most(radius, e) + most(radius, g)) + (most(bounds.around, e) + most(bounds.around, g));
      if (stay_apart_along_normal(reach, x, bounds.along, e, g)) return;
      visit(stencil_of(StencilKind::edge_edge, {edge_a, edge_b}));
    });
  }
  return found;
}

Stencil ContactCandidates::stencil_of(StencilKind kind, const std::array<Index, 2>& primitives) const {
  const auto [first, second] = primitives;
  if (kind == StencilKind::vertex_face) {
    const Triangle& f = triangles_[second];
    return {kind, {first, f[0], f[1], f[2]}, primitives};
  }
  const Edge &e = edges_.edges[first], &g = edges_.edges[second];
  return {kind, {e[0], e[1], g[0], g[1]}, primitives};
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
