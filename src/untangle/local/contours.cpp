#include "untangle/local/contours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/triangle_intersection.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

/// Largest |direction| of one crossing: an edge nearly parallel to the face would otherwise outweigh its whole curve
/// (no unit)
constexpr double direction_limit = 4.0;
/// Sine of the angle between an edge and a face: a smaller one counts as this, so that the quotient is finite.
/// direction_limit decides then [E24] (no unit)
constexpr double least_steepness = 1e-3;

/// Union-find with the parity of each element relative to its root.
class ParityForest {
 public:
  explicit ParityForest(Index n) : parent_(n), parity_(n, 1) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// Root and parity (+1, -1) of i.
  std::pair<Index, int> find(Index i) {
    int parity = 1;
    Index root = i;
    while (parent_[root] != root) parity *= parity_[root], root = parent_[root];
    int left = parity;
    while (parent_[i] != i) {  // compress
      const Index next = parent_[i];
      const int own = parity_[i];
      parent_[i] = root;
      parity_[i] = left;
      left *= own;
      i = next;
    }
    return {root, parity};
  }
  /// Says that i and j have this relative parity; an earlier contradicting statement stands.
  void join(Index i, Index j, int parity) {
    const auto [ri, pi] = find(i);
    const auto [rj, pj] = find(j);
    if (ri == rj) return;
    const Index root = std::min(ri, rj), child = std::max(ri, rj);
    parent_[child] = root;
    parity_[child] = pi * pj * parity;
  }

 private:
  std::vector<Index> parent_;
  std::vector<int> parity_;
};

/// The edge's faces that intersect the pierced face, with the index of the pair.
struct Incidence {
  Index edge, face, other, pair;
  auto key() const { return std::pair(edge, face); }
  bool operator<(const Incidence& o) const { return key() != o.key() ? key() < o.key() : other < o.other; }
};

/// Unit direction of the curve in face `other` from the crossing inwards, within the plane of the pierced face.
Vec3 curve_direction(const Positions& x, const Triangle& other, const Edge& edge, const Vec3& pierced_normal) {
  const TrianglePoints p = points_of(x, other);
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  Vec3 along = normal.cross(pierced_normal);
  const double length = along.norm();
  if (!(length > 0)) return Vec3::Zero();
  along /= length;
  Index apex = other[0];
  for (Index v : other)
    if (v != edge[0] && v != edge[1]) apex = v;
  // Inwards: to the apex's side of the edge within the plane of `other`.
  const Vec3 e = x.col(edge[1]) - x.col(edge[0]);
  const Vec3 to_apex = x.col(apex) - x.col(edge[0]);
  const Vec3 inward = to_apex - e * (e.dot(to_apex) / e.squaredNorm());
  return along.dot(inward) < 0 ? Vec3(-along) : along;
}

}  // namespace

Contours trace_contours(const Positions& x, std::span<const Triangle> triangles, const EdgeTable& edges,
                        std::span<const IntersectingPair> pairs) {
  std::vector<Incidence> incidences;
  std::vector<std::uint8_t> has_crossing(pairs.size(), 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].kind != PairClass::disjoint && pairs[k].kind != PairClass::one_vertex) continue;
    for (const auto& [piercing, pierced] : {std::pair(pairs[k].a, pairs[k].b), std::pair(pairs[k].b, pairs[k].a)}) {
      const TrianglePoints face = points_of(x, triangles[pierced]);
      for (Index e : edges.edges_of_triangle[piercing]) {
        if (e < 0) continue;
        const auto [u, v] = edges.edges[e];
        if (has_corner(triangles[pierced], u) || has_corner(triangles[pierced], v)) continue;
        if (segment_meets_triangle(x.col(u), x.col(v), face))
          incidences.push_back({e, pierced, piercing, static_cast<Index>(k)});
      }
    }
  }
  std::sort(incidences.begin(), incidences.end());

  Contours contours;
  ParityForest forest(static_cast<Index>(pairs.size()));
  std::vector<Index> pair_of_crossing;
  std::vector<int> edge_side_in_pair;
  for (std::size_t begin = 0, end = 0; begin < incidences.size(); begin = end) {
    while (end < incidences.size() && incidences[end].key() == incidences[begin].key()) ++end;
    const auto [edge_id, face_id] = incidences[begin].key();
    const Edge& edge = edges.edges[edge_id];
    const TrianglePoints face = points_of(x, triangles[face_id]);
    const Vec3 p = x.col(edge[0]), q = x.col(edge[1]);
    const Vec3 normal_raw = (face[1] - face[0]).cross(face[2] - face[0]);
    const double double_area = normal_raw.norm(), length = (q - p).norm();
    if (!(double_area > 0) || !(length > 0)) continue;
    const Vec3 normal = normal_raw / double_area, e = (q - p) / length;
    const double height_p = normal.dot(p - face[0]), height_q = normal.dot(q - face[0]);
    if (!(height_p - height_q != 0)) continue;

    Crossing crossing;
    crossing.edge = edge_id;
    crossing.face = face_id;
    crossing.along = std::clamp(height_p / (height_p - height_q), 0.0, 1.0);
    const Vec3 point = p + crossing.along * (q - p);
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &b = face[(k + 1) % 3], &c = face[(k + 2) % 3];
      crossing.weights[k] = std::max(0.0, normal.dot((b - point).cross(c - point)));
      sum += crossing.weights[k];
    }
    if (!(sum > 0)) continue;
    for (double& w : crossing.weights) w /= sum;

    Vec3 curve = Vec3::Zero(), edge_normal = Vec3::Zero();
    for (std::size_t k = begin; k < end; ++k) {
      const Triangle& other = triangles[incidences[k].other];
      curve += curve_direction(x, other, edge, normal);
      edge_normal += triangle_normal(x, other);
    }
    crossing.normals = {edge_normal.normalized(), normal};
    // Sliding the edge by D over the resting face moves the crossing by D - (D.n)/(e.n) e; sliding the face by -D under
    // the resting edge, by -(D.n)/(e.n) e. Neither sheet rests: the mean of both counts, here twice.
    const double steepness = e.dot(normal);
    const double divisor = std::copysign(std::max(std::abs(steepness), least_steepness), steepness);
    crossing.direction = curve - normal * (2 * e.dot(curve) / divisor);
    const double size = crossing.direction.norm();
    if (size > direction_limit) crossing.direction *= direction_limit / size;

    for (std::size_t k = begin; k < end; ++k) {
      has_crossing[incidences[k].pair] = 1;
      // The pierced face keeps its side from pair to pair.
      const bool first_is_a = pairs[incidences[begin].pair].a == face_id,
                 this_is_a = pairs[incidences[k].pair].a == face_id;
      forest.join(incidences[begin].pair, incidences[k].pair, first_is_a == this_is_a ? 1 : -1);
    }
    pair_of_crossing.push_back(incidences[begin].pair);
    // Face a of a pair is on its first sheet.
    edge_side_in_pair.push_back(pairs[incidences[begin].pair].a == face_id ? -1 : 1);
    contours.crossings.push_back(crossing);
  }

  std::vector<Index> contour_of_root(pairs.size(), -1);
  for (std::size_t k = 0; k < contours.crossings.size(); ++k) {
    const auto [root, parity] = forest.find(pair_of_crossing[k]);
    if (contour_of_root[root] < 0) contour_of_root[root] = contours.count++;
    contours.crossings[k].contour = contour_of_root[root];
    contours.crossings[k].side = edge_side_in_pair[k] * parity;
    if (contours.crossings[k].side < 0) std::swap(contours.crossings[k].normals[0], contours.crossings[k].normals[1]);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (!has_crossing[k]) contours.uncrossed.push_back(pairs[k]);
  return contours;
}

}  // namespace unsnarl
