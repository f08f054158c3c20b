#include "verification.h"

#include <algorithm>

namespace unsnarl::app {

Verification::Verification(const SurfaceView& input, const FindOptions& options)
    : input_(input),
      identification_(identify(input, options.weld, options.weld_tolerance)),
      triangulation_(triangulate(input, identification_.vertex_of)),
      finder_(triangulation_.triangles) {}

std::vector<IntersectingPair> Verification::pairs(std::span<const double> positions) {
  Positions x(3, identification_.count);
  for (Index v = 0; v < identification_.count; ++v) {
    const double* p = &positions[3 * static_cast<std::size_t>(identification_.first[v])];
    x.col(v) = Vec3(p[0], p[1], p[2]);
  }
  std::vector<IntersectingPair> pairs = finder_.find(x);
  for (IntersectingPair& pair : pairs) {
    pair.a = triangulation_.polygon[pair.a];
    pair.b = triangulation_.polygon[pair.b];
    if (pair.b < pair.a) std::swap(pair.a, pair.b);
  }
  std::sort(pairs.begin(), pairs.end());
  const auto same_faces = [](const IntersectingPair& p, const IntersectingPair& q) { return p.a == q.a && p.b == q.b; };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same_faces), pairs.end());
  return pairs;
}

Index Verification::first_torn_vertex(std::span<const double> positions) const {
  for (std::size_t v = 0; v < identification_.vertex_of.size(); ++v) {
    const auto first = static_cast<std::size_t>(identification_.first[identification_.vertex_of[v]]);
    const auto together = [&](std::span<const double> x) {
      return x[3 * v] == x[3 * first] && x[3 * v + 1] == x[3 * first + 1] && x[3 * v + 2] == x[3 * first + 2];
    };
    if (together(input_.positions) && !together(positions)) return static_cast<Index>(v);
  }
  return -1;
}

std::vector<Index> faces_in(const std::vector<IntersectingPair>& pairs) {
  std::vector<Index> faces;
  faces.reserve(2 * pairs.size());
  for (const IntersectingPair& pair : pairs) {
    faces.push_back(pair.a);
    faces.push_back(pair.b);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace unsnarl::app
