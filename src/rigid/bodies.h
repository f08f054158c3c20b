#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "geometry/types.h"
#include "rigid/rigid_motion.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// A part that moves as one body. A vertex at p in the input is at rotation (p - rest_centre) + centre.
struct Body {
  std::vector<Index> vertices;   ///< ascending
  std::vector<Index> triangles;  ///< those of which all vertices are its own, ascending
  bool avoids_soft = false;      ///< it must not intersect soft triangles either
  double area = 0;               ///< of the triangles, in the input
  double diagonal = 0;           ///< of the bounding box, in the input
  Vec3 rest_centre = Vec3::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  ///< sum of q q^T over the vertices, q from rest_centre

  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 centre = Vec3::Zero();  ///< where the mean of the vertices is
  bool is_placed = true;       ///< at a place where it intersects nothing that it must not

  bool is_at_rest() const { return centre == rest_centre && rotation == Eigen::Matrix3d::Identity(); }
  /// Sum of the squared displacements of the vertices.
  double squared_displacement() const;
};

/// Bodies among each other and among what does not move, on the triangles of one surface.
class Bodies {
 public:
  /// body_of: of each vertex, or -1. fixed, of the vertices: triangles of fixed vertices alone are obstacles to all
  /// bodies; other triangles without a vertex of a body are soft, obstacles to bodies that avoid_soft() is said of.
  /// `triangles` must outlive this.
  Bodies(const Positions& rest, std::span<const Triangle> triangles, std::span<const Index> body_of, Index count,
         std::span<const std::uint8_t> fixed);

  std::span<Body> list() { return bodies_; }
  std::span<const Body> list() const { return bodies_; }
  const Positions& rest() const { return rest_; }
  /// The present positions of all vertices; those of no body are at rest.
  const Positions& x() const { return x_; }
  std::span<const Triangle> triangles() const { return triangles_; }

  void avoid_soft(Index body) { bodies_[body].avoids_soft = true; }

  /// Puts a body where its rotation and centre say. `settle` before others look for it there.
  void move(const Body& body);
  void settle(const Body& body);
  /// Largest displacement of a vertex of it.
  double largest_displacement(const Body& body) const;

  /// Whether the body intersects nothing that it must not: obstacles, and bodies that are present.
  bool is_free(const Body& body) const;
  std::vector<IntersectingPair> contacts_of(const Body& body) const;
  /// Whether other bodies have to keep clear of this one.
  void set_present(Index body, bool present) { is_present_[body] = present; }

  /// Calls visit(t, u) for triangles t of the body and u that it must not intersect whose boxes come `reach` close.
  template <class Visit>
  void near_triangles(const Body& body, double reach, Visit&& visit) const {
    for (Index t : body.triangles)
      tree_.query(box_of(x_, triangles_[t]).inflated(reach), [&](Index u) {
        if (is_obstacle_to(body, u)) visit(t, u);
      });
  }
  /// The body of a triangle; negative: what it is instead.
  Index owner_of_triangle(Index t) const { return owner_[t]; }
  /// The body of a vertex; -1: it is of none.
  Index body_of_vertex(Index v) const { return body_of_[v]; }

 private:
  static constexpr Index obstacle = -1, soft = -2, mixed = -3;  // owners that are no bodies; mixed: of several
  bool is_obstacle_to(const Body& body, Index u) const;

  Positions rest_, x_;
  std::span<const Triangle> triangles_;
  std::vector<Body> bodies_;
  std::vector<Index> body_of_;  // of each vertex
  std::vector<Index> owner_;    // of each triangle: its body, or what it is instead
  std::vector<std::uint8_t> is_present_;
  std::vector<Box> boxes_;
  Bvh tree_;
  mutable Index last_hit_ = 0;  // position in a body's list of the triangle that was last found to intersect
};

}  // namespace unsnarl
