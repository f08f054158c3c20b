#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// A coarse cloud of points that stands for a surface: Poisson-disk clusters of its vertices. A shape-level force
/// between clusters is spread back over their vertices. (An evaluation of the Gaussian energy takes 0.1 ms instead of
/// the 10 to 100 ms of the sum over all vertices.)
class FlowSamples {
 public:
  /// Clusters of radius `spacing` (length, > 0), measured along the edges of `triangles` at rest. Vertices that no
  /// triangle uses belong to none. Vertices from `free_count` on are clustered apart: they never move.
  FlowSamples(std::span<const Triangle> triangles, const Positions& rest, Index free_count, double spacing);

  Index size() const { return static_cast<Index>(areas_.size()); }
  double spacing() const { return spacing_; }
  /// Area of the cluster at rest. Held fixed: recomputing it while the surface moves is positive feedback.
  double area(Index cluster) const { return areas_[cluster]; }
  bool is_free(Index cluster) const { return is_free_[cluster]; }
  /// The cluster of a vertex; -1: none.
  Index cluster_of(Index vertex) const { return cluster_of_[vertex]; }

  /// Area-weighted means of the clusters' vertices, one column each.
  void points(const Positions& x, Positions& points) const;
  /// The transpose: adds `gradient` of the points, spread over the vertices, to `vertex_gradient`.
  void spread(const Positions& gradient, Positions& vertex_gradient) const;

  /// Whether an edge joins the two clusters.
  bool adjacent(Index i, Index j) const;

 private:
  double spacing_;
  std::vector<double> areas_;
  std::vector<char> is_free_;
  std::vector<Index> cluster_of_;
  std::vector<double> weights_;  // of each vertex in its cluster's mean
  std::vector<Index> offsets_;   // of each cluster's neighbours, ascending
  std::vector<Index> neighbours_;
};

}  // namespace unsnarl
