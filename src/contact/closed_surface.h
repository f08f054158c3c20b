#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "contact/bvh.h"
#include "contact/distances.h"
#include "geometry/types.h"

namespace unsnarl {

/// The place of a point with respect to a closed surface.
enum class Side : std::uint8_t { inside, on, outside };

/// Triangles whose vertices move, asked which side of them a point is on, and what of them is nearest to it.
class ClosedSurface {
 public:
  /// For side_of() to make sense, every edge has to be one of an even number of these triangles.
  explicit ClosedSurface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {}

  /// Takes over the positions.
  void update(const Positions& x);

  std::span<const Triangle> triangles() const { return triangles_; }

  /// Exact: inside is what a ray leaves through an odd number of triangles, whatever their orientation. The ray goes
  /// along x, from p shifted by (0, e, e^2) for an infinitely small e, so that it meets no edge.
  Side side_of(const Vec3& p) const;

  /// The places where the line along x through (y, z) crosses the triangles, ascending: it is inside between the first
  /// and the second place, the third and the fourth, and so on. Which triangles it crosses is exact, as of the ray of
  /// side_of(); the places are rounded.
  std::vector<double> crossings(double y, double z) const;

  struct Nearest {
    Index triangle = -1;  ///< of triangles(); -1: there are none that count
    Closest closest;      ///< as of closest_vertex_face(): its direction leads from the triangle to the point
  };
  /// Looks among the triangles that `accept`, which may be empty for all. `guess`: a length to begin with; the nearer
  /// to the distance, the faster; 0: none.
  Nearest nearest(const Vec3& p, double guess, const std::function<bool(Index)>& accept = {}) const;

 private:
  bool has(const Vec3& p, const Triangle& t) const;

  std::vector<Triangle> triangles_;
  Positions x_;
  Box box_;
  Bvh bvh_;
};

/// An edge that an odd number of the triangles have; {-1, -1}: there is none, and they are closed.
Edge first_open_edge(std::span<const Triangle> triangles);

}  // namespace unsnarl
