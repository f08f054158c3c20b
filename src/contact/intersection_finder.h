#pragma once

#include <span>
#include <vector>

#include "contact/face_tree.h"
#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Exact class of the pair of triangles (a, b), or nothing where they meet only in the hull of the vertices they share.
bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind);

/// Finds all intersecting pairs of a set of triangles whose vertices move: the tree is built once and refitted.
class IntersectionFinder {
 public:
  /// Pairs of two triangles >= active_count are skipped (obstacles among themselves). The span must outlive the finder.
  explicit IntersectionFinder(std::span<const Triangle> triangles);
  IntersectionFinder(std::span<const Triangle> triangles, Index active_count);

  /// All intersecting pairs, a < b, sorted. Decided by exact predicates. Same result at any thread count.
  std::vector<IntersectingPair> find(const Positions& x);
  /// True as soon as one pair is found.
  bool any(const Positions& x);

 private:
  std::span<const Triangle> triangles_;
  FaceTree tree_;
};

}  // namespace unsnarl
