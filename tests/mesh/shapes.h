#pragma once

#include <cmath>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/surface.h"

/// Small surfaces chosen by property, for the tests of this folder.
namespace unsnarl::shapes {

inline Index add_vertex(Surface& s, double x, double y, double z) {
  s.positions.insert(s.positions.end(), {x, y, z});
  return static_cast<Index>(s.positions.size() / 3) - 1;
}

inline void add_face(Surface& s, const std::vector<Index>& corners) {
  if (s.offsets.empty()) s.offsets = {0};
  s.corners.insert(s.corners.end(), corners.begin(), corners.end());
  s.offsets.push_back(static_cast<Index>(s.corners.size()));
}

/// Every face gets corners of its own, as in STL.
inline Surface exploded(const Surface& s) {
  Surface out;
  const SurfaceView view = s;
  for (std::size_t f = 0; f < view.face_count(); ++f) {
    std::vector<Index> corners;
    for (Index v : view.face(f))
      corners.push_back(add_vertex(out, s.positions[3 * v], s.positions[3 * v + 1], s.positions[3 * v + 2]));
    add_face(out, corners);
  }
  return out;
}

inline void append(Surface& to, const Surface& s, double dx = 0, double dy = 0, double dz = 0) {
  const auto shift = static_cast<Index>(to.positions.size() / 3);
  for (std::size_t i = 0; i < s.positions.size(); i += 3)
    add_vertex(to, s.positions[i] + dx, s.positions[i + 1] + dy, s.positions[i + 2] + dz);
  const SurfaceView view = s;
  for (std::size_t f = 0; f < view.face_count(); ++f) {
    std::vector<Index> corners(view.face(f).begin(), view.face(f).end());
    for (Index& v : corners) v += shift;
    add_face(to, corners);
  }
}

inline Surface octahedron() {
  Surface s;
  s.positions = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  for (const auto& t : std::vector<std::vector<Index>>{
           {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})
    add_face(s, t);
  return s;
}

/// Unit cube of six quads, normals outward.
inline Surface cube() {
  Surface s;
  for (int i = 0; i < 8; ++i) add_vertex(s, i & 1, (i >> 1) & 1, (i >> 2) & 1);
  for (const auto& q : std::vector<std::vector<Index>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    add_face(s, q);
  return s;
}

/// n x m quads over the vertex ids that at(i, j) gives, cut into triangles.
template <class At>
std::vector<Triangle> grid_triangles(Index n, Index m, At&& at) {
  std::vector<Triangle> triangles;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < m; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles;
}

inline std::vector<Triangle> torus_triangles(Index n, Index m) {
  return grid_triangles(n, m, [=](Index i, Index j) { return (i % n) * m + j % m; });
}
/// Glued with a flip where i wraps around.
inline std::vector<Triangle> klein_bottle_triangles(Index n, Index m) {
  return grid_triangles(n, m, [=](Index i, Index j) { return i < n ? i * m + j % m : (2 * m - j) % m; });
}
inline std::vector<Triangle> moebius_triangles(Index n, Index m) {
  return grid_triangles(n, m, [=](Index i, Index j) { return i < n ? i * (m + 1) + j : m - j; });
}

}  // namespace unsnarl::shapes
