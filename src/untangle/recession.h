#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// Constants of Recession.
struct RecessionOptions {
  double step = 0.3;              ///< mean edges: how far a vertex goes between two looks at the field
  int most_steps = 400;           ///< of a vertex
  double arrived = 0.03;          ///< of a step: a vertex that makes less has come to the spine
  double largest_cotangent = 10;  ///< weights of edges, at most, and its inverse at least: psi needs them positive
};

/// Lets the boundary of a surface recede along the surface itself, as it is at rest: f becomes f o phi, with phi an
/// isotopy of the surface into itself. What is left of the image shrinks towards a graph, its spine, and graphs in
/// space do not meet. So every surface with a boundary has an embedding this way, orientable or not, with pinch points
/// or without, however deep it runs through itself. The mesh must follow: rows of faces along the spine become as long
/// as it is, and half-way is in practice as far as it pays; by then the boundary cuts the double curves, and the
/// contour method slips what is left of them over it.
///
/// The spine comes from taking away triangles at free edges, and edges at free vertices, those nearest the boundary
/// first. The ways lead along the gradient of psi, harmonic, 0 on the boundary and 1 on the spine: the surface without
/// its spine is a collar of the boundary, where such a psi has no critical point, so that no two ways part.
class Recession {
 public:
  /// Vertices from `free_count` on stand still, and so do components without a boundary edge of two free vertices. The
  /// spine keeps away from the vertices `avoided` as from the boundary: those of intersecting faces, where it may not
  /// cross double curves more often than it must.
  Recession(std::span<const Triangle> triangles, const Positions& rest, Index free_count,
            std::span<const Index> avoided = {}, const RecessionOptions& options = {});

  /// False: nothing can recede.
  bool possible() const { return possible_; }
  /// Where the vertices are after `share` (from 0, at rest, to 1) of their ways. Others are left as they are in x.
  void positions(double share, Positions& x) const;

 private:
  /// A vertex on its way: in a triangle at rest, at the sum of weights * corners.
  struct Traveller {
    Index vertex;
    Index triangle;
    Vec3 weights;
  };
  std::vector<char> find_spine(const std::vector<char>& reached, const std::vector<char>& is_boundary,
                               std::span<const Index> avoided) const;
  void solve_field(const std::vector<char>& reached, const std::vector<char>& is_boundary);
  void smooth_field(const std::vector<Vec3>& gradients);
  void smooth_fan(Index vertex, std::span<const Index> fan, bool closed, const std::vector<Vec3>& gradients);
  Vec3 velocity(const Traveller& traveller) const;
  /// Its way.
  struct Line {
    Index vertex;
    std::vector<Vec3> points;
    std::vector<double> lengths;  // from the start
  };
  void follow_lines();
  void travel(Traveller& traveller, double duration) const;
  Index across(Index triangle, int edge) const;

  std::span<const Triangle> triangles_;
  const Positions& rest_;
  RecessionOptions options_;
  EdgeTable edges_;
  double edge_length_ = 0;
  bool possible_ = false;
  std::vector<char> on_spine_;
  std::vector<std::array<Vec3, 3>> field_;  // in each triangle's plane, at its corners
  std::vector<Traveller> travellers_;
  std::vector<Line> lines_;
};

}  // namespace unsnarl
