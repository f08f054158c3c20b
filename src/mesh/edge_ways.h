#pragma once

#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

/// The shortest ways along the edges of a mesh from some of its vertices (Dijkstra), followed only as far as is asked.
class EdgeWays {
 public:
  /// `neighbours`: of each vertex, by edges. The arguments must outlive this.
  EdgeWays(const Positions& x, const IndexLists& neighbours);

  /// Ways begin at these vertices from now on.
  void start(std::span<const Index> from);
  /// The vertices that ways of at most this length lead to, ascending; those where ways begin are among them.
  std::vector<Index> within(double length);

 private:
  /// Length of the shortest way that has not been followed further; infinite: there is none.
  double next() const;
  void follow_next();

  using Entry = std::pair<double, Index>;
  const Positions& x_;
  const IndexLists& neighbours_;
  std::vector<double> length_;  // per vertex: of the shortest way so far; infinite: none yet
  std::vector<Index> met_;      // vertices with a way
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
};

}  // namespace unsnarl
