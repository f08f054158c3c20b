#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/bvh.h"
#include "contact/passing.h"
#include "geometry/types.h"
#include "rigid/rigid_motion.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// A part that moves as one body: a vertex at p in the input is at rotation (p - rest_centre) + centre.
struct Body {
  std::vector<Index> vertices;   ///< ascending
  std::vector<Index> triangles;  ///< those with all vertices in the body, ascending
  bool avoids_soft = false;      ///< soft triangles are obstacles to it too
  double area = 0;               ///< of the triangles, in the input
  double diagonal = 0;           ///< of the bounding box, in the input
  Vec3 rest_centre = Vec3::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  ///< sum of q q^T over the vertices, q from rest_centre

  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 centre = Vec3::Zero();  ///< present mean of the vertices
  bool is_placed = true;       ///< it intersects nothing that it must not intersect

  bool is_at_rest() const { return centre == rest_centre && rotation == Eigen::Matrix3d::Identity(); }
  /// Sum of the squared displacements of the vertices.
  double squared_displacement() const;
};

/// The bodies of one surface, and its triangles that do not move, as obstacles to each other.
class Bodies {
 public:
  /// body_of: the body of each vertex, or -1. fixed: one flag a vertex. Triangles with only fixed vertices are
  /// obstacles to all bodies. Other triangles without a vertex of a body are soft: obstacles to bodies with
  /// avoids_soft. Triangles that pass through each other are none to each other. `triangles` must outlive this.
  Bodies(const Positions& rest, std::span<const Triangle> triangles, std::span<const Index> body_of, Index count,
         std::span<const std::uint8_t> fixed, Passing passing = {});

  std::span<Body> list() { return bodies_; }
  std::span<const Body> list() const { return bodies_; }
  const Positions& rest() const { return rest_; }
  /// The present positions of all vertices; vertices of no body are at rest.
  const Positions& x() const { return x_; }
  std::span<const Triangle> triangles() const { return triangles_; }

  void avoid_soft(Index body) { bodies_[body].avoids_soft = true; }

  /// Moves a body to its rotation and centre. Call settle() before other bodies are tested against it.
  void move(const Body& body);
  void settle(const Body& body);
  /// Largest displacement of a vertex of the body.
  double largest_displacement(const Body& body) const;

  /// Whether the body intersects no obstacle and no present body.
  bool is_free(const Body& body) const;
  std::vector<IntersectingPair> contacts_of(const Body& body) const;
  /// Whether other bodies have to keep clear of this one.
  void set_present(Index body, bool present) { is_present_[body] = present; }

  /// Calls visit(t, u) for triangles t of the body and triangles u that it must not intersect, if their boxes are
  /// within `reach` of each other.
  template <class Visit>
  void near_triangles(const Body& body, double reach, Visit&& visit) const {
    for (Index t : body.triangles)
      tree_.query(box_of(x_, triangles_[t]).inflated(reach), [&](Index u) {
        if (is_obstacle_to(body, u) && passing_.meet(triangles_, t, u)) visit(t, u);
      });
  }
  /// The body of a triangle, or `obstacle`, `soft` or `mixed`.
  Index owner_of_triangle(Index t) const { return owner_[t]; }
  /// The body of a vertex; -1: none.
  Index body_of_vertex(Index v) const { return body_of_[v]; }

 private:
  /// Owner of triangles that do not move (fixed by the numbering of bodies from 0)
  static constexpr Index obstacle = -1;
  /// Owner of triangles that move but belong to no body (fixed by the numbering of bodies from 0)
  static constexpr Index soft = -2;
  /// Owner of triangles whose corners have several owners (fixed by the numbering of bodies from 0)
  static constexpr Index mixed = -3;
  bool is_obstacle_to(const Body& body, Index u) const;

  Positions rest_, x_;
  std::span<const Triangle> triangles_;
  Passing passing_;
  std::vector<Body> bodies_;
  std::vector<Index> body_of_;  // of each vertex
  std::vector<Index> owner_;    // of each triangle: its body, or obstacle, soft or mixed
  std::vector<std::uint8_t> is_present_;
  std::vector<Box> boxes_;
  Bvh tree_;
  mutable Index last_hit_ = 0;  // position in a body's list of triangles of the one that was last found to intersect
};

}  // namespace unsnarl
