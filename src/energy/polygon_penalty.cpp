#include "energy/polygon_penalty.h"

#include <algorithm>
#include <map>

#include "energy/minkowski_penalty.h"

namespace unsnarl {
namespace {

/// A polygon is flat where its corners are no higher than this above its mean plane (unit: diameters of the polygon)
constexpr double flat = 0.05;

/// The corners around triangles that are joined along edges, none of which has three; empty where they have no single
/// boundary.
std::vector<Index> boundary_loop(std::span<const Triangle> triangles) {
  std::map<Index, Index> next;
  std::vector<std::array<Index, 2>> sides;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) sides.push_back({t[k], t[(k + 1) % 3]});
  for (const auto& [a, b] : sides) {
    if (std::find(sides.begin(), sides.end(), std::array<Index, 2>{b, a}) != sides.end()) continue;
    if (!next.emplace(a, b).second) return {};
  }
  std::vector<Index> loop;
  if (next.empty()) return loop;
  for (Index v = next.begin()->first; loop.empty() || v != loop.front(); v = next.at(v)) {
    loop.push_back(v);
    if (loop.size() > next.size() || !next.contains(v)) return {};
  }
  if (loop.size() != next.size()) loop.clear();
  return loop;
}

bool is_flat_and_convex(const Positions& x, const std::vector<Index>& loop) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(loop[k % loop.size()]); };
  Vec3 centre = Vec3::Zero(), normal = Vec3::Zero();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    centre += at(k) / static_cast<double>(loop.size());
    normal += (at(k) - at(0)).cross(at(k + 1) - at(0));
  }
  if (!(normal.norm() > 0)) return false;
  normal.normalize();
  double size = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) size = std::max(size, 2 * (at(k) - centre).norm());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (std::abs(normal.dot(at(k) - centre)) > flat * size) return false;
    if (!((at(k + 1) - at(k)).cross(at(k + 2) - at(k + 1)).dot(normal) > 0)) return false;
  }
  return true;
}

}  // namespace

double PolygonPenalty::value_and_gradient(const Positions& x, Positions& gradient, double weight) const {
  double value = 0;
  std::vector<Vec3> a, b;
  std::vector<double> weight_a, weight_b;
  const auto gather = [&](const std::vector<Index>& polygon, std::vector<Vec3>& points, std::vector<double>& weights) {
    points.clear();
    for (const Index v : polygon) points.push_back(x.col(v));
    weights.assign(polygon.size(), 0.0);
  };
  for (const auto& [i, j] : pairs) {
    const std::vector<Index>&p = polygons_[i], &q = polygons_[j];
    if (std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end()) continue;
    gather(p, a, weight_a);
    gather(q, b, weight_b);
    const PolygonPenetration found = polygon_penetration(a, b, 0, weight_a, weight_b);
    if (!(found.depth > 0)) continue;
    value += found.depth;
    for (std::size_t k = 0; k < p.size(); ++k) gradient.col(p[k]) -= weight * weight_a[k] * found.normal;
    for (std::size_t k = 0; k < q.size(); ++k) gradient.col(q[k]) += weight * weight_b[k] * found.normal;
  }
  return weight * value;
}

std::vector<std::vector<Index>> convex_faces(std::span<const Triangle> triangles, std::span<const Index> face_of,
                                             const Positions& x) {
  std::map<Index, std::vector<Triangle>> pieces;
  for (std::size_t t = 0; t < triangles.size(); ++t) pieces[face_of[t]].push_back(triangles[t]);
  std::vector<std::vector<Index>> polygons;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto found = pieces.find(face_of[t]);
    if (found == pieces.end()) continue;  // taken with its first triangle
    std::vector<Index> loop;
    if (found->second.size() > 1) loop = boundary_loop(found->second);
    if (loop.size() > 3 && is_flat_and_convex(x, loop))
      polygons.push_back(std::move(loop));
    else
      for (const Triangle& piece : found->second) polygons.emplace_back(piece.begin(), piece.end());
    pieces.erase(found);
  }
  return polygons;
}

}  // namespace unsnarl
