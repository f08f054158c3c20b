#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Rank of vertices that ProgressiveMesh never removes.
constexpr std::uint8_t rank_that_stays = std::numeric_limits<std::uint8_t>::max();

/// Least quality of a new triangle in CoarsenOptions::any_shape() (no unit)
constexpr double any_shape_quality = 0.02;
/// Vertices with more neighbours stay in CoarsenOptions::any_shape() (unit: neighbours)
constexpr std::size_t any_shape_valence = 40;

/// Which vertices ProgressiveMesh::coarsen() may remove.
struct CoarsenOptions {
  /// Least quality of a new triangle, 4 sqrt(3) area / sum of squared sides: 1 if it is equilateral, 0.15 if one side
  /// is a twelfth of the others. Where the removed triangles are worse, they are the measure (no unit)
  double least_quality = 0.15;
  /// Least cosine between the normals of a new triangle and of the star that it replaces, of 70 degrees (no unit)
  double least_cosine = 0.34;
  /// Largest distance of the vertex from the triangles that replace its star (unit: mean edges of the star)
  double largest_offset = 0.35;
  std::size_t largest_valence = 16;  ///< Vertices with more neighbours stay (unit: neighbours)
  /// Vertices of this rank and above stay, whatever their shape.
  std::uint8_t least_kept_rank = rank_that_stays;

  /// For a handful of faces in the end: whatever keeps the topology, but for triangles that have next to no area and
  /// for vertices of this rank and above.
  static CoarsenOptions any_shape(std::uint8_t least_kept_rank = rank_that_stays) {
    return {any_shape_quality, -1, std::numeric_limits<double>::infinity(), any_shape_valence, least_kept_rank};
  }
};

/// A triangle mesh that loses vertices round by round, each by collapsing it onto a neighbour (half-edge collapse), and
/// gets them back in reverse order. Faces keep their ids. Positions are the caller's.
/// Hoppe: Progressive Meshes, SIGGRAPH 1996.
class ProgressiveMesh {
 public:
  /// A vertex that was collapsed onto a neighbour. Its star was replaced by a fan of triangles around that neighbour.
  struct Removal {
    Index vertex = -1;
    Index parent = -1;
    Triangle corners = {-1, -1, -1};  ///< of the triangle of the fan that is nearest to the vertex
    Vec3 weights = Vec3::Zero();      ///< barycentric coordinates of the point nearest to the vertex
    std::vector<Index> star;          ///< ids of the faces at the vertex, ascending
  };

  static constexpr std::uint8_t stays = rank_that_stays;

  /// `ranks`: one a vertex. A vertex is collapsed only onto one of its rank or above.
  ProgressiveMesh(std::vector<Triangle> triangles, std::vector<std::uint8_t> ranks);

  /// One round: removes vertices no two of which are neighbours, short edges first. The topology is kept (link
  /// condition), and vertices of the boundary are collapsed along it. Returns how many were removed; deterministic at
  /// any thread count.
  Index coarsen(const Positions& x, const CoarsenOptions& options = {});
  /// Undoes the last round. Returns the vertices that came back, in the order in which they had been removed.
  std::vector<Removal> refine();
  std::size_t round_count() const { return rounds_.size(); }

  /// Ids of the faces that there are now, ascending.
  std::span<const Index> faces() const { return faces_; }
  /// How many of these are below `id`.
  std::size_t count_below(Index id) const;
  /// The corners of all of them, in that order.
  std::vector<Triangle> triangles() const;
  /// The corners of one of these faces now.
  const Triangle& operator[](Index face) const { return triangles_[face]; }

 private:
  std::vector<Triangle> triangles_;  // by id; of faces that are not there: as they were last
  std::vector<Index> faces_;
  std::vector<std::uint8_t> ranks_;
  std::vector<std::vector<Removal>> rounds_;
};

}  // namespace unsnarl
