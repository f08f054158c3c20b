#pragma once

#include <vector>

#include "contact/intersection_finder.h"
#include "scene/patch.h"

namespace unsnarl {

/// Checks that a moving patch gains no intersecting pair over those it had at the start (none, or obstructions such as
/// duplicate faces). Exact. The patch's triangles must outlive it.
class EmbeddingGuard {
 public:
  explicit EmbeddingGuard(const Patch& patch);

  std::size_t pairs_at_start() const { return tolerated_.size(); }
  /// Pairs at x that were not there at the start.
  std::vector<IntersectingPair> new_pairs(const Positions& x);
  /// Puts vertices of newly intersecting faces back to where they are in `safe` (a state without new pairs),
  /// until there are none. Returns the number of vertices put back.
  Index roll_back(Positions& x, const Positions& safe);

 private:
  const Patch& patch_;
  IntersectionFinder finder_;
  std::vector<IntersectingPair> tolerated_;
};

}  // namespace unsnarl
