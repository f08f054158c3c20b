#include "mesh/progressive_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "geometry/parallel.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// 4 sqrt(3) area / sum of squared sides.
double quality(const Positions& x, const Triangle& t) {
  double squares = 0;
  for (int k = 0; k < 3; ++k) squares += (x.col(t[(k + 1) % 3]) - x.col(t[k])).squaredNorm();
  return squares > 0 ? 4 * std::sqrt(3.0) * triangle_area(x, t) / squares : 0;
}

/// The point of a triangle nearest to p: squared distance, and barycentric coordinates.
std::pair<double, Vec3> nearest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto on_edge = [&](const Vec3& u, const Vec3& v) {
    const Vec3 e = v - u;
    const double length = e.squaredNorm();
    const double s = length > 0 ? std::clamp((p - u).dot(e) / length, 0.0, 1.0) : 0;
    return std::pair((p - u - s * e).squaredNorm(), s);
  };
  const Vec3 n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  if (area > 0) {
    const Vec3 w((b - p).cross(c - p).dot(n) / area, (c - p).cross(a - p).dot(n) / area,
                 (a - p).cross(b - p).dot(n) / area);
    if (w.minCoeff() >= 0) return {(p - w[0] * a - w[1] * b - w[2] * c).squaredNorm(), w};
  }
  const auto [ab, s] = on_edge(a, b);
  const auto [bc, t] = on_edge(b, c);
  const auto [ca, u] = on_edge(c, a);
  if (ab <= bc && ab <= ca) return {ab, Vec3(1 - s, s, 0)};
  if (bc <= ca) return {bc, Vec3(0, 1 - t, t)};
  return {ca, Vec3(u, 0, 1 - u)};
}

/// The neighbours of a vertex in their order around it.
struct Ring {
  std::vector<Index> vertices;
  bool closed = false;

  std::size_t size() const { return vertices.size(); }
  Index operator[](std::size_t i) const { return vertices[i % size()]; }
};

/// None where the faces are no single fan. Faces of either orientation may follow each other.
std::optional<Ring> ring_of(Index v, std::span<const Index> star, std::span<const Triangle> triangles) {
  std::vector<std::pair<Index, Index>> sides;  // of the faces, opposite of v
  for (const Index t : star) {
    const Triangle& f = triangles[t];
    const int k = f[0] == v ? 0 : f[1] == v ? 1 : 2;
    sides.push_back({f[(k + 1) % 3], f[(k + 2) % 3]});
  }
  const auto sides_at = [&](Index w) {
    return std::count_if(sides.begin(), sides.end(), [&](const auto& s) { return s.first == w || s.second == w; });
  };
  std::vector<Index> ends;  // corners of one side alone: where the boundary leaves the star
  for (const auto& [a, b] : sides) {
    if (sides_at(a) > 2 || sides_at(b) > 2) return {};
    if (sides_at(a) == 1) ends.insert(ends.begin(), a);  // where its face begins, if all are oriented alike
    if (sides_at(b) == 1) ends.push_back(b);
  }
  if (ends.size() != 0 && ends.size() != 2) return {};
  Ring ring;
  ring.closed = ends.empty();
  ring.vertices.push_back(ring.closed ? sides.front().first : ends.front());
  for (std::size_t k = 0; k < star.size(); ++k) {
    const Index at = ring.vertices.back();
    const auto next =
        std::find_if(sides.begin(), sides.end(), [&](const auto& s) { return s.first == at || s.second == at; });
    if (next == sides.end()) return {};  // several fans
    ring.vertices.push_back(next->first == at ? next->second : next->first);
    sides.erase(next);
  }
  if (ring.closed) {
    if (ring.vertices.back() != ring.vertices.front()) return {};
    ring.vertices.pop_back();
  }
  std::vector<Index> sorted = ring.vertices;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  return ring;
}

/// A way to remove a vertex.
struct Collapse {
  double cost = infinity;  // infinite: there is none
  ProgressiveMesh::Removal removal;
  std::vector<Index> new_neighbours;  // of the parent
};

/// Removes vertices from the mesh as it is at the beginning of a round.
class Round {
 public:
  Round(const Positions& x, std::span<const Triangle> triangles, std::span<const Index> faces,
        std::span<const std::uint8_t> ranks, const CoarsenOptions& options)
      : x_(x), triangles_(triangles), ranks_(ranks), options_(options) {
    std::vector<Triangle> current;
    current.reserve(faces.size());
    for (const Index t : faces) current.push_back(triangles[t]);
    faces_of_vertex_ = triangles_of_vertices(current, static_cast<Index>(x.cols()));
    for (Index& t : faces_of_vertex_.items) t = faces[t];
    neighbours_ = vertex_neighbours(build_edges(current).edges, static_cast<Index>(x.cols()));
  }

  /// The best collapse of this vertex.
  Collapse best_collapse(Index v) const {
    Collapse best;
    const std::span<const Index> star = faces_of_vertex_[v];
    if (star.size() < 2 || star.size() > options_.largest_valence) return best;
    const std::optional<Ring> ring = ring_of(v, star, triangles_);
    if (!ring || ring->size() < 3) return best;
    double edge = 0;
    for (const Index w : ring->vertices) edge += (x_.col(w) - x_.col(v)).norm();
    edge /= static_cast<double>(ring->size());
    Vec3 normal = Vec3::Zero();
    double worst = 1;
    const std::size_t n = ring->size();
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Triangle t = {v, (*ring)[i], (*ring)[i + 1]};
      normal += area_vector(x_, t);
      worst = std::min(worst, quality(x_, t));
    }
    normal.normalize();
    const double least_quality = std::min(options_.least_quality, worst);
    for (std::size_t i = 0; i < n; ++i) {
      if (!ring->closed && i != 0 && i != n - 1) continue;
      if (ranks_[(*ring)[i]] < ranks_[v]) continue;
      Collapse collapse = collapse_onto(v, *ring, i, normal, edge, least_quality);
      if (collapse.cost < best.cost) best = std::move(collapse);
    }
    if (best.cost < infinity) best.removal.star.assign(star.begin(), star.end());
    return best;
  }

  bool are_neighbours(Index v, Index w) const {
    const std::span<const Index> of_v = neighbours_[v];
    return std::binary_search(of_v.begin(), of_v.end(), w);
  }
  std::span<const Index> neighbours(Index v) const { return neighbours_[v]; }

 private:
  Collapse collapse_onto(Index v, const Ring& ring, std::size_t onto, const Vec3& normal, double edge,
                         double least_quality) const {
    const Index parent = ring[onto];
    const std::size_t n = ring.size();
    Collapse collapse;
    double worst = 1, nearest = infinity;
    // The sides of the ring, from the parent's neighbour on one side to that on the other.
    const std::size_t sides = n - 2;
    const std::size_t first = ring.closed || onto == 0 ? onto + 1 : 0;
    for (std::size_t k = 0; k < sides; ++k) {
      const Triangle t = {parent, ring[first + k], ring[first + k + 1]};
      const double q = quality(x_, t);
      if (!(q >= least_quality) || !(q > 0)) return {};
      worst = std::min(worst, q);
      if (!(area_vector(x_, t).normalized().dot(normal) >= options_.least_cosine)) return {};
      const auto [squared, weights] = nearest_point(x_.col(v), x_.col(t[0]), x_.col(t[1]), x_.col(t[2]));
      if (squared < nearest) {
        nearest = squared;
        collapse.removal.corners = t;
        collapse.removal.weights = weights;
      }
    }
    const double offset = std::sqrt(nearest) / edge;
    if (!(offset <= options_.largest_offset)) return {};
    // Link condition: who becomes a neighbour of the parent must not be one.
    const std::size_t last = first + sides;
    for (std::size_t k = first; k <= last; ++k) {
      const bool is_beside = ring.closed ? k == first || k == last : k == (onto == 0 ? first : last);
      if (is_beside) continue;
      if (are_neighbours(parent, ring[k])) return {};
      collapse.new_neighbours.push_back(ring[k]);
    }
    if (ring.closed && n == 3) {  // a tetrahedron's
      for (const Index t : faces_of_vertex_[parent])
        if (has_corner(triangles_[t], ring[first]) && has_corner(triangles_[t], ring[first + 1])) return {};
    }
    collapse.removal.vertex = v;
    collapse.removal.parent = parent;
    collapse.cost = edge * (1 + offset) / worst;
    return collapse;
  }

  const Positions& x_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint8_t> ranks_;
  const CoarsenOptions& options_;
  IndexLists faces_of_vertex_;
  IndexLists neighbours_;
};

}  // namespace

ProgressiveMesh::ProgressiveMesh(std::vector<Triangle> triangles, std::vector<std::uint8_t> ranks)
    : triangles_(std::move(triangles)), ranks_(std::move(ranks)) {
  faces_.resize(triangles_.size());
  for (std::size_t t = 0; t < faces_.size(); ++t) faces_[t] = static_cast<Index>(t);
}

Index ProgressiveMesh::coarsen(const Positions& x, const CoarsenOptions& options) {
  const Round round(x, triangles_, faces_, ranks_, options);
  std::vector<Index> candidates;
  for (Index v = 0; v < static_cast<Index>(ranks_.size()); ++v)
    if (ranks_[v] < options.least_kept_rank) candidates.push_back(v);
  std::vector<Collapse> collapses(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t k) { collapses[k] = round.best_collapse(candidates[k]); });
  std::erase_if(collapses, [](const Collapse& c) { return !(c.cost < infinity); });
  std::stable_sort(collapses.begin(), collapses.end(),
                   [](const Collapse& a, const Collapse& b) { return a.cost < b.cost; });

  std::vector<Removal> removals;
  std::vector<std::uint8_t> is_blocked(ranks_.size(), 0);  // a neighbour, or it itself, has been removed in this round
  std::set<Edge> new_edges;
  const auto edge = [](Index v, Index w) { return Edge{std::min(v, w), std::max(v, w)}; };
  for (Collapse& collapse : collapses) {
    Removal& removal = collapse.removal;
    if (is_blocked[removal.vertex]) continue;
    // The star is as it was at the beginning of the round; the parent may have got new neighbours since.
    const auto exists = [&](Index w) { return new_edges.contains(edge(removal.parent, w)); };
    if (std::any_of(collapse.new_neighbours.begin(), collapse.new_neighbours.end(), exists)) continue;
    if (removal.star.size() == 3 && collapse.new_neighbours.empty() && is_blocked[removal.parent]) continue;
    for (const Index w : collapse.new_neighbours) new_edges.insert(edge(removal.parent, w));
    is_blocked[removal.vertex] = 1;
    for (const Index w : round.neighbours(removal.vertex)) is_blocked[w] = 1;
    for (const Index t : removal.star) {
      Triangle& f = triangles_[t];
      if (has_corner(f, removal.parent)) continue;  // vanishes
      std::replace(f.begin(), f.end(), removal.vertex, removal.parent);
    }
    removals.push_back(std::move(removal));
  }
  if (removals.empty()) return 0;
  std::vector<std::uint8_t> is_removed(ranks_.size(), 0);
  for (const Removal& removal : removals) is_removed[removal.vertex] = 1;
  std::erase_if(faces_, [&](Index t) {
    return std::any_of(triangles_[t].begin(), triangles_[t].end(), [&](Index v) { return is_removed[v] != 0; });
  });
  rounds_.push_back(std::move(removals));
  return static_cast<Index>(rounds_.back().size());
}

std::vector<ProgressiveMesh::Removal> ProgressiveMesh::refine() {
  if (rounds_.empty()) return {};
  std::vector<Removal> removals = std::move(rounds_.back());
  rounds_.pop_back();
  std::vector<Index> back;
  for (const Removal& removal : removals)
    for (const Index t : removal.star) {
      Triangle& f = triangles_[t];
      if (has_corner(f, removal.vertex))
        back.push_back(t);
      else
        std::replace(f.begin(), f.end(), removal.parent, removal.vertex);
    }
  std::sort(back.begin(), back.end());
  const auto middle = faces_.insert(faces_.end(), back.begin(), back.end());
  std::inplace_merge(faces_.begin(), middle, faces_.end());
  return removals;
}

std::size_t ProgressiveMesh::count_below(Index id) const {
  return static_cast<std::size_t>(std::lower_bound(faces_.begin(), faces_.end(), id) - faces_.begin());
}

std::vector<Triangle> ProgressiveMesh::triangles() const {
  std::vector<Triangle> result;
  for (const Index t : faces_) result.push_back(triangles_[t]);
  return result;
}

}  // namespace unsnarl
