#include "applications/seifert/seifert_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "applications/seifert/embedded_mesh.h"
#include "geometry/predicates.h"
#include "geometry/splitmix.h"
#include "geometry/triangle_intersection.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// Distance of a push-off from its triangle (unit: smallest height of the triangle)
constexpr double offset_of_height = 1e-3;
/// Distance of any push-off at first, at most; it is lowered to a tenth where a large triangle has another sheet near
/// (unit: size of the mesh)
constexpr double first_limit_rel = 1e-3;
/// That limit is lowered down to this, a hundred times what rounding does (unit: size of the mesh)
constexpr double least_limit_rel = 1e-14;
constexpr double grid_cells = 40;  ///< Cells along the longest side of the grid (unit: cells)

constexpr double least_jitter = 0.4;  ///< Places on a face differ from face to face from this on (unit: edge)
constexpr double jitter_range = 0.2;  ///< Places on a face differ from face to face over this range (unit: edge)
constexpr double across_share = 0.6;  ///< A place lies at this times its jitter toward the third corner (no unit)

/// A loop: faces, each joined to the next by an edge.
struct Loop {
  std::vector<Index> faces, edges;  // edges[k]: between faces[k] and the next
};

class Loops {
 public:
  Loops(std::span<const Vec3> x, std::span<const Triangle> faces) : x_(x), faces_(faces) {
    std::map<Edge, Index> ids;
    edges_of_.resize(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Index a = faces[f][k], b = faces[f][(k + 1) % 3];
        const auto [at, is_new] = ids.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<Index>(edges_.size()));
        if (is_new) {
          edges_.push_back(at->first);
          sides_.push_back({static_cast<Index>(f), -1});
        } else {
          sides_[at->second][1] = static_cast<Index>(f);
        }
        edges_of_[f][k] = at->second;
      }
  }

  const Edge& edge(Index e) const { return edges_[e]; }
  const std::array<Index, 2>& sides(Index e) const { return sides_[e]; }

  /// A tree of faces, then a forest of vertices rooted in the boundary, of edges that the tree does not cross: what
  /// edges are left cross one loop of the basis each.
  std::vector<Loop> basis() {
    parent_.assign(faces_.size(), -1);
    through_.assign(faces_.size(), -1);
    depth_.assign(faces_.size(), 0);
    std::vector<bool> is_crossed(edges_.size(), false);
    std::vector<Index> queue;
    std::vector<bool> seen(faces_.size(), false);
    for (std::size_t root = 0; root < faces_.size(); ++root) {  // one a component
      if (seen[root]) continue;
      seen[root] = true;
      queue.push_back(static_cast<Index>(root));
      for (std::size_t k = queue.size() - 1; k < queue.size(); ++k)
        for (const Index e : edges_of_[queue[k]]) {
          const Index other = sides_[e][0] == queue[k] ? sides_[e][1] : sides_[e][0];
          if (other < 0 || seen[other]) continue;
          seen[other] = true;
          parent_[other] = queue[k];
          through_[other] = e;
          depth_[other] = depth_[queue[k]] + 1;
          is_crossed[e] = true;
          queue.push_back(other);
        }
    }
    UnionFind joined(x_.size() + 1);
    const auto boundary = static_cast<Index>(x_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (sides_[e][1] < 0)
        for (const Index v : edges_[e]) joined.unite(v, boundary);
    std::vector<Loop> loops;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (sides_[e][1] >= 0 && !is_crossed[e] && !joined.unite(edges_[e][0], edges_[e][1]))
        loops.push_back(loop_across(static_cast<Index>(e)));
    return loops;
  }

 private:
  Loop loop_across(Index edge) const {
    Loop loop;
    std::vector<Index> back_faces, back_edges;
    Index a = sides_[edge][1], b = sides_[edge][0];  // from a up, down to b, and across the edge
    while (a != b)
      if (depth_[a] >= depth_[b]) {
        loop.faces.push_back(a);
        loop.edges.push_back(through_[a]);
        a = parent_[a];
      } else {
        back_faces.push_back(b);
        back_edges.push_back(through_[b]);
        b = parent_[b];
      }
    loop.faces.push_back(a);
    loop.faces.insert(loop.faces.end(), back_faces.rbegin(), back_faces.rend());
    loop.edges.insert(loop.edges.end(), back_edges.rbegin(), back_edges.rend());
    loop.edges.push_back(edge);
    return loop;
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> faces_;
  std::vector<Edge> edges_;
  std::vector<std::array<Index, 2>> sides_;
  std::vector<std::array<Index, 3>> edges_of_;
  std::vector<Index> parent_, through_, depth_;
};

using Polygon = std::vector<Vec3>;

class PushOffs {
 public:
  PushOffs(std::span<const Vec3> x, std::span<const Triangle> faces, const Loops& loops)
      : x_(x), faces_(faces), loops_(loops), size_(size_of(x)), grid_(make_grid()) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto [lo, hi] = box({x[faces[f][0]], x[faces[f][1]], x[faces[f][2]]});
      grid_.insert(static_cast<Index>(f), lo, hi);
    }
  }

  /// The loop on either side, at most `limit_rel` / size away from it; none where some part of it meets the surface, or
  /// would three times as far away. So push-offs of two sheets that face each other keep their order.
  std::optional<std::array<Polygon, 2>> push(const Loop& loop, double limit_rel) {
    if (!push_so_far(loop, limit_rel, 3)) return {};
    return push_so_far(loop, limit_rel, 1);
  }

 private:
  std::optional<std::array<Polygon, 2>> push_so_far(const Loop& loop, double limit_rel, double times) {
    const double limit = limit_rel * size_;
    // Another one for each face: faces in one plane, as discs are, may look to either side of it.
    const auto offset = [&](Index f) { return times * jitter(f) * std::min(offset_of_height * room(f), limit); };
    std::array<Polygon, 2> sides;
    const std::size_t n = loop.faces.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Index f = loop.faces[k], g = loop.faces[(k + 1) % n];
      const Vec3 up = offset(f) * normal(f), above = place(f, 0) + up, below = place(f, 1) - up;
      if (!is_clear(above, below, {f, f})) return {};
      sides[0].push_back(above);
      sides[1].push_back(below);
      const Edge& edge = loops_.edge(loop.edges[k]);
      const Vec3 out = std::min(offset(f), offset(g)) * (normal(f) + normal(g)).normalized();
      const auto at_edge = [&](double t) { return Vec3((1 - t) * x_[edge[0]] + t * x_[edge[1]]); };
      const Vec3 out_above = at_edge(jitter(2 * loop.edges[k])) + out,
                 out_below = at_edge(jitter(2 * loop.edges[k] + 1)) - out;
      if (!is_clear(out_above, out_below, {f, g})) return {};
      sides[0].push_back(out_above);
      sides[1].push_back(out_below);
    }
    for (const Polygon& side : sides)
      for (std::size_t k = 0; k < side.size(); ++k)
        if (!is_clear(side[k], side[(k + 1) % side.size()], {-1, -1})) return {};
    return sides;
  }

  static std::array<Vec3, 2> box(const std::array<Vec3, 3>& t) {
    return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
  }
  static double size_of(std::span<const Vec3> x) {
    const auto [lo, hi] = box_of(x);
    return (hi - lo).maxCoeff();
  }
  static std::array<Vec3, 2> box_of(std::span<const Vec3> x) {
    std::array<Vec3, 2> result{x[0], x[0]};
    for (const Vec3& p : x) result = {result[0].cwiseMin(p), result[1].cwiseMax(p)};
    return result;
  }
  FaceGrid make_grid() const {
    const auto [lo, hi] = box_of(x_);
    return {lo, hi, size_ / grid_cells};
  }

  /// Another one for each number: points of symmetric meshes, and those above and below a level face, would lie in
  /// line.
  static double jitter(Index id) {
    return least_jitter + jitter_range * splitmix_number(static_cast<std::uint64_t>(id) * splitmix_step);
  }
  Vec3 place(Index f, Index side) const {
    const double s = jitter(4 * f + side), t = jitter(4 * f + 2 + side);
    const Vec3 middle = (1 - s) * x_[faces_[f][0]] + s * x_[faces_[f][1]];
    return (1 - across_share * t) * middle + across_share * t * x_[faces_[f][2]];
  }
  Vec3 normal(Index f) const {
    const Triangle& t = faces_[f];
    return (x_[t[1]] - x_[t[0]]).cross(x_[t[2]] - x_[t[0]]).normalized();
  }
  /// The smallest height of the triangle.
  double room(Index f) const {
    const Triangle& t = faces_[f];
    const double longest = std::max({(x_[t[1]] - x_[t[0]]).squaredNorm(), (x_[t[2]] - x_[t[1]]).squaredNorm(),
                                     (x_[t[0]] - x_[t[2]]).squaredNorm()});
    return (x_[t[1]] - x_[t[0]]).cross(x_[t[2]] - x_[t[0]]).norm() / std::sqrt(longest);
  }

  bool is_clear(const Vec3& p, const Vec3& q, const std::array<Index, 2>& but) {
    bool clear = true;
    grid_.query(p.cwiseMin(q), p.cwiseMax(q), [&](Index f) {
      if (!clear || f == but[0] || f == but[1]) return;
      const Triangle& t = faces_[f];
      clear = !segment_meets_triangle(p, q, {x_[t[0]], x_[t[1]], x_[t[2]]});
    });
    return clear;
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> faces_;
  const Loops& loops_;
  double size_;  // longest side of the bounding box
  FaceGrid grid_;
};

/// Crossings in which p is above q, seen along z, with their signs. None where the view is not generic.
std::optional<std::int64_t> linking_number(const Polygon& p, const Polygon& q) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % p.size()];
    const Vec3 lo = a.cwiseMin(b), hi = a.cwiseMax(b);
    for (std::size_t j = 0; j < q.size(); ++j) {
      const Vec3 &c = q[j], &d = q[(j + 1) % q.size()];
      if (std::min(c[0], d[0]) > hi[0] || std::max(c[0], d[0]) < lo[0] || std::min(c[1], d[1]) > hi[1] ||
          std::max(c[1], d[1]) < lo[1])
        continue;
      const Sign ca = orient2d_dropping(2, a, b, c), da = orient2d_dropping(2, a, b, d);
      const Sign ac = orient2d_dropping(2, c, d, a), bc = orient2d_dropping(2, c, d, b);
      if (ca * da > 0 || ac * bc > 0) continue;
      if (ca * da * ac * bc == 0) return {};
      const Sign side = orient3d(a, b, c, d);
      if (side == 0) return {};
      if (side * da > 0) sum += da;  // d is to the left of ab where cd crosses ab from its right
    }
  }
  return sum;
}

}  // namespace

SeifertMatrix seifert_matrix(std::span<const Vec3> x, std::span<const Triangle> faces) {
  Loops loops(x, faces);
  const std::vector<Loop> basis = loops.basis();
  SeifertMatrix matrix;
  matrix.size = static_cast<Index>(basis.size());
  matrix.entries.resize(basis.size() * basis.size());
  PushOffs push_offs(x, faces, loops);
  std::vector<std::array<Polygon, 2>> pushed;
  for (const Loop& loop : basis) {
    std::optional<std::array<Polygon, 2>> sides;
    for (double limit_rel = first_limit_rel; limit_rel >= least_limit_rel && !sides; limit_rel /= 10)
      sides = push_offs.push(loop, limit_rel);
    if (!sides)
      throw std::invalid_argument(
          "the surface is too thin to tell its sides apart in 64-bit numbers; is the link much longer one way than "
          "another? Stretch it");
    pushed.push_back(std::move(*sides));
  }
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t j = 0; j < basis.size(); ++j) {
      const std::optional<std::int64_t> number = linking_number(pushed[i][1], pushed[j][0]);
      if (!number) throw std::invalid_argument("two loops of the surface lie in line; turn the link a little");
      matrix.entries[i * basis.size() + j] = *number;
    }
  return matrix;
}

/// By symmetric elimination as in Bareiss's: what is left is the Schur complement times the last pivot, in integers.
int signature(const SeifertMatrix& matrix) {
  const Index n = matrix.size;
  std::vector<Integer> m(matrix.entries.size());
  const auto at = [&](Index i, Index j) -> Integer& { return m[std::size_t(i) * n + j]; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      at(i, j) = Integer(matrix.entries[std::size_t(i) * n + j]) + matrix.entries[std::size_t(j) * n + i];
  Integer previous = 1;
  int result = 0;
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    while (pivot < n && at(pivot, pivot) == 0) ++pivot;
    if (pivot == n) {  // a pivot comes from a sum of two rows, and of their columns
      Index i = k, j = k;
      while (i < n && at(i, j) == 0)
        if (++j == n) j = ++i;
      if (i == n) break;
      for (Index l = k; l < n; ++l) at(i, l) += at(j, l);
      for (Index l = k; l < n; ++l) at(l, i) += at(l, j);
      pivot = i;
    }
    for (Index l = k; l < n; ++l) std::swap(at(k, l), at(pivot, l));
    for (Index l = k; l < n; ++l) std::swap(at(l, k), at(l, pivot));
    result += (at(k, k) > 0) == (previous > 0) ? 1 : -1;
    for (Index i = k + 1; i < n; ++i)
      for (Index j = k + 1; j < n; ++j) at(i, j) = (at(i, j) * at(k, k) - at(i, k) * at(k, j)) / previous;
    previous = at(k, k);
  }
  return result;
}

Polynomial alexander_polynomial(const SeifertMatrix& matrix) {
  LinearMatrix m(matrix.size);
  for (Index i = 0; i < matrix.size; ++i)
    for (Index j = 0; j < matrix.size; ++j) {
      m.constant[m.at(i, j)] = matrix.entries[m.at(i, j)];
      m.slope[m.at(i, j)] = -matrix.entries[m.at(j, i)];
    }
  return without_units(determinant(m));
}

}  // namespace unsnarl
