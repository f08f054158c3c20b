#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// An edge that pierces a face: an end point of segments of the intersection curve.
struct Crossing {
  Index edge = 0;
  Index face = 0;
  double along = 0;                 ///< the point is (1 - along) * edge[0] + along * edge[1]
  std::array<double, 3> weights{};  ///< ... and the sum of weights * corners of the face
  /// Moving the edge along this vector (dimensionless) relative to the face shortens the curve the fastest. Added up
  /// along a curve with the signs of the sides: minus twice the gradient of its length as one sheet slides.
  /// Volino and Magnenat-Thalmann, "Resolving Surface Collisions through Intersection Contour Minimization" (2006).
  Vec3 direction = Vec3::Zero();
  Index contour = 0;
  int side = 1;                   ///< +1: the edge is on the first sheet of its contour, -1: on the second
  std::array<Vec3, 2> normals{};  ///< unit normals there of the first and the second sheet; of an edge: its faces' mean
};

/// The intersection curves of a set of triangles.
struct Contours {
  std::vector<Crossing> crossings;          ///< sorted by (edge, face)
  Index count = 0;                          ///< connected curves
  std::vector<IntersectingPair> uncrossed;  ///< pairs without a crossing that could be computed (flat or touching)
};

/// `pairs` are those the exact detector found at x. Floating point: positions of the crossings are approximate.
Contours trace_contours(const Positions& x, std::span<const Triangle> triangles, const EdgeTable& edges,
                        std::span<const IntersectingPair> pairs);

}  // namespace unsnarl
