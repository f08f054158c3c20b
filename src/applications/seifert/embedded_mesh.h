#pragma once

#include <array>
#include <span>
#include <vector>

#include "applications/seifert/spanning_start.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {

/// Whether a plane across a normal of either triangle, or of an edge within one, keeps them this far apart: cheap, and
/// enough for most that are not near each other. Never true of triangles that meet, whatever is rounded.
bool are_separated(const TrianglePoints& a, const TrianglePoints& b, double by);

/// Faces near a place: a grid of cells over a box, each with the faces whose bounding boxes reach into it.
class FaceGrid {
 public:
  FaceGrid(const Vec3& lo, const Vec3& hi, double cell);

  void insert(Index face, const Vec3& lo, const Vec3& hi);
  void remove(Index face);
  /// Calls visit(face) once for each face in the cells that the box reaches.
  template <class Visit>
  void query(const Vec3& lo, const Vec3& hi, Visit&& visit) {
    ++stamp_;
    for_cells(range(lo, hi), [&](std::vector<Index>& cell) {
      for (const Index f : cell)
        if (seen_[f] != stamp_) {
          seen_[f] = stamp_;
          visit(f);
        }
    });
  }

 private:
  using Range = std::array<int, 6>;
  Range range(const Vec3& lo, const Vec3& hi) const;
  template <class Work>
  void for_cells(const Range& r, Work&& work) {
    for (int z = r[2]; z <= r[5]; ++z)
      for (int y = r[1]; y <= r[4]; ++y)
        for (int x = r[0]; x <= r[3]; ++x) work(cells_[(std::size_t(z) * count_[1] + y) * count_[0] + x]);
  }

  Vec3 lo_;
  double cell_;
  std::array<int, 3> count_;
  std::vector<std::vector<Index>> cells_;
  std::vector<Range> range_of_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t stamp_ = 0;
};

/// An embedded surface that is changed step by step and never stops being one: every step is tried, judged by exact
/// predicates, and taken back where it fails. Boundary vertices stay, and so do boundary edges.
class EmbeddedMesh {
 public:
  /// edge: length that interior edges are to have. gap: distance to keep between sheets; where they are closer it only
  /// may grow. Neither changes what the mesh is now.
  /// boundary_count: the first vertices, which stay.
  EmbeddedMesh(SpanningMesh mesh, Index boundary_count, double edge, double gap);

  /// Only this many vertices can be moved or removed: all but the boundary's, which come first.
  Index boundary_count() const { return boundary_count_; }
  Index vertex_count() const { return static_cast<Index>(x_.size()); }
  /// -1: where the boundary is.
  std::array<Index, 2> faces_at(const Edge& edge) const;
  bool is_alive(Index v) const { return !faces_of_[v].empty(); }
  const Vec3& position(Index v) const { return x_[v]; }
  std::span<const Index> faces_of(Index v) const { return faces_of_[v]; }
  const Triangle& face(Index f) const { return faces_[f]; }
  /// The interior edges, sorted.
  std::vector<Edge> interior_edges() const;
  Index face_count() const { return living_faces_; }

  // Each says whether it was done.

  bool move(Index v, const Vec3& to);
  /// Not where a half becomes thin, but for an edge that is the longest of its triangle. Else triangles beside long
  /// boundary edges would be halved without end: one of their sides always is as long as half that edge.
  bool split(const Edge& edge);
  bool collapse(const Edge& edge, double longest);
  bool flip(const Edge& edge);
  /// Replaces a disc inside the surface by one triangle, where three edges around it, this one among them, are no face:
  /// a needle is cut off at its foot. collapse() cannot do it, since the surface would touch itself.
  bool cut_off(const Edge& edge);

  /// Without what was removed.
  SpanningMesh compact() const;

 private:
  std::vector<Index> neighbours(Index v) const;
  /// The faces on the side of `first` of three edges, without an end of the surface; empty: they are no disc, or many.
  std::vector<Index> disc_within(const Triangle& around, Index first) const;
  Vec3 normal(const Triangle& t) const;  // not of unit length
  /// How far the thinnest of the faces is from being too thin: 0: no area; 1: none is thin.
  double shape(std::span<const Triangle> faces) const;
  /// How far the faces are from what is wrong with a mesh: below 0: they intersect the others; 1: nothing is near.
  /// `without`: faces that are not there. gap: to keep; 0: only intersections count. enough: whatever is no more than
  /// this may be given back as soon as it is known.
  double clearance(std::span<const Triangle> faces, std::span<const Index> without, double gap, double enough);
  /// Whether, with vertex v at `to`, the faces `after` intersect nothing, and are thin or near others only where
  /// `before` (faces `old`) was no better.
  bool is_improved(std::span<const Triangle> before, std::span<const Triangle> after, std::span<const Index> old,
                   Index v, const Vec3& to);
  /// below: what is no less than this may be given back as 1.
  double soundness_of_pair(const Triangle& a, const Triangle& b, double gap, double below) const;
  double squared_longest_edge(const Triangle& t) const;
  double soundness_of(const Triangle& t) const;
  void erase(Index face);
  void put(Index face, const Triangle& t);
  void replace(std::span<const Index> old_faces, std::span<const Triangle> new_faces);

  std::vector<Vec3> x_;
  std::vector<Triangle> faces_;  // removed ones: first vertex -1
  std::vector<std::vector<Index>> faces_of_;
  std::vector<Index> free_faces_;
  std::vector<std::uint8_t> is_without_;
  Index boundary_count_, living_faces_ = 0;
  double gap_;
  FaceGrid grid_;
};

}  // namespace unsnarl
