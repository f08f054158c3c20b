#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// The pairs of primitives whose distance decides whether a moving triangle mesh stays embedded.
enum class StencilKind : std::uint8_t {
  vertex_face,  ///< vertex 0 against the triangle 1, 2, 3
  edge_edge,    ///< edge 0, 1 against edge 2, 3
  vertex_edge,  ///< vertex 0 against the edge 1, 2; entry 3 is -1
};

/// Up to four vertices: two primitives that share none of them.
struct Stencil {
  StencilKind kind = StencilKind::vertex_face;
  std::array<Index, 4> v = {-1, -1, -1, -1};
  /// Ids of the two primitives where ContactCandidates listed it: the vertex or edge, and the triangle or edge; else
  /// -1.
  std::array<Index, 2> primitives = {-1, -1};

  int size() const { return kind == StencilKind::vertex_edge ? 3 : 4; }
  friend bool operator==(const Stencil& s, const Stencil& t) { return s.kind == t.kind && s.v == t.v; }
};

/// Where two primitives are closest. `weights` are signed barycentric coordinates: sum_i weights[i] x_i is the vector
/// from the closest point of the second primitive to that of the first, and `distance` is its length. Because the
/// closest points are optimal, the gradient of the distance is weights[i] * direction for each vertex i.
struct Closest {
  double distance = 0;            ///< not squared
  Vec3 direction = Vec3::Zero();  ///< unit vector; zero where distance is zero
  std::array<double, 4> weights = {0, 0, 0, 0};
};

/// Closest points of vertex p and triangle (a, b, c), which may be degenerate.
Closest closest_vertex_face(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// Closest points of the segments (a, b) and (c, d), which may be degenerate or parallel.
Closest closest_edge_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Closest points of vertex p and segment (a, b), which may be degenerate.
Closest closest_vertex_edge(const Vec3& p, const Vec3& a, const Vec3& b);

Closest closest(const Stencil& stencil, const Positions& x);
/// The same of vertices at these positions, in the stencil's order.
Closest closest(StencilKind kind, const std::array<Vec3, 4>& x);

/// Upper bound of the change of a stencil's distance while each vertex v moves by at most lengths[v].
double approach(const Stencil& stencil, std::span<const double> lengths);

double squared_distance(StencilKind kind, const std::array<Vec3, 4>& x);
double squared_distance(const Stencil& stencil, const Positions& x);

}  // namespace unsnarl
