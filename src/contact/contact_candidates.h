#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/distances.h"
#include "contact/four_boxes.h"
#include "contact/motion_bounds.h"
#include "mesh/adjacency.h"

namespace unsnarl {

struct NearStencil {
  Stencil stencil;
  double distance = 0;            ///< between its primitives
  Vec3 direction = Vec3::Zero();  ///< of the shortest way (Closest::direction)
  /// Lower bound of the distance while vertices keep to their bounds: least_distance() along `direction`.
  double least_distance = 0;
  friend bool operator==(const NearStencil& s, const NearStencil& t) = default;
};

/// Radius of a stencil where every vertex has one: the mean of its two primitives', of which each has that of its
/// vertex with the largest.
inline double radius_of(const Stencil& stencil, std::span<const double> radius) {
  return 0.5 * approach(stencil, radius);
}

/// Lists the stencils of a triangle mesh that are close together: every vertex against every triangle it is not a
/// corner of, every edge against every edge it shares no end point with. Stencils between triangles that share a vertex
/// or an edge are among them; they keep neighbours from folding through each other.
class ContactCandidates {
 public:
  /// The triangles may include obstacles; vertices without a triangle take part in nothing. The span must outlive this.
  ContactCandidates(std::span<const Triangle> triangles, Index vertex_count);

  /// All stencils with a vertex v with moves[v] != 0 whose primitives may come closer than their radius while every
  /// vertex keeps to its bounds, and a few more. `moves` and `radius`, a length, have one entry a vertex; the radius of
  /// a stencil is radius_of(). Parallel; the order depends only on the arguments, and on those of the first call.
  /// Throws WorkStopped soon after `stop` says so.
  void gather(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
              std::span<const std::uint8_t> moves, std::vector<NearStencil>& stencils,
              const std::function<bool()>& stop = {});

  /// The same for the stencils with one of `vertices`, after only the positions and bounds of these have changed since
  /// the last gathering. The cost grows with their number. Lists each stencil once. Returns false, and a part of them,
  /// where there are more than `most`.
  bool gather_around(std::span<const Index> vertices, const Positions& x, std::span<const double> radius,
                     const MotionBounds& bounds, std::vector<NearStencil>& stencils,
                     const std::function<bool()>& stop = {},
                     std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Whether a triangle at the one primitive shares a vertex with a triangle at the other. For listed stencils.
  bool are_neighbours(const Stencil& stencil) const;

  const EdgeTable& edges() const { return edges_; }
  const IndexLists& triangles_of_vertex() const { return triangles_of_vertex_; }

 private:
  /// Updates where triangle t may be.
  void update_triangle(const Positions& x, std::span<const double> radius, const MotionBounds& bounds, Index t);
  bool gather_active(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                     std::span<const std::uint8_t> moves, std::vector<NearStencil>& stencils,
                     const std::function<bool()>& stop, std::size_t most);
  void gather_pair(const Positions& x, std::span<const double> radius, const MotionBounds& bounds,
                   std::span<const std::uint8_t> moves, Index a, Index b, std::vector<NearStencil>& stencils) const;

  std::span<const Triangle> triangles_;
  EdgeTable edges_;
  IndexLists triangles_of_vertex_;
  IndexLists around_vertex_;  // the corners of the triangles at each vertex, itself among them; ascending
  IndexLists around_edge_;    // the same of each edge
  // Every vertex and edge belongs to its first triangle, so that a stencil is listed once.
  std::vector<std::uint8_t> owned_corners_;  // bit k: corner k; bit 3 + k: edge k of the triangle
  std::vector<std::uint8_t> moving_;         // per triangle: has a vertex that is gathered around
  std::vector<std::uint8_t> around_;         // per vertex: gather_around() it
  std::vector<Box> boxes_;
  std::vector<FourIndices> corners_;  // of the triangles; the last is -1
  // Of the last gathering:
  struct Slab {
    Vec3 normal;        // of the triangle, unit or zero
    double lo, hi;      // where its corners may be along it, from the first one
    double around = 0;  // the largest of its corners
    double radius = 0;  // the same
  };
  struct Reach {
    FourBoxes corners;  // of those the triangle looks after, and its own
    FourBoxes edges;    // of those it looks after
  };
  std::vector<Slab> slabs_;
  std::vector<Reach> reach_;
  Bvh bvh_;
  bool built_ = false;
};

}  // namespace unsnarl
