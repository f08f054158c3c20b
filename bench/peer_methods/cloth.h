#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl::peers {

/// The sheet that methods of cloth simulation take for granted, without inertia or gravity: springs along edges, and
/// between the two vertices opposite each edge against bending (Provot 1995), as position constraints (Müller et al.,
/// "Position Based Dynamics", 2007, §3.3). Rest lengths are those of the input.
class Cloth {
 public:
  Cloth(const Positions& rest, std::span<const Triangle> triangles, const EdgeTable& edges);

  /// Sweeps over all springs, each of which moves both ends; in place.
  void relax(Positions& x, int sweeps) const;

 private:
  struct Spring {
    Index i, j;
    double length;     // at rest
    double stiffness;  // share of the difference that one sweep takes away
  };
  std::vector<Spring> springs_;
};

}  // namespace unsnarl::peers
