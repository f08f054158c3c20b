#pragma once

#include <span>
#include <vector>

#include "contact/face_tree.h"
#include "geometry/types.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// Exact class of the pair of triangles (a, b), or nothing where they meet only in the hull of the vertices they share.
bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind);

/// Finds all intersecting pairs of a set of triangles whose vertices move: the tree is built once and refitted, and
/// where few triangles have moved since the last time, only their pairs are decided anew.
class IntersectionFinder {
 public:
  /// Pairs of two triangles >= active_count are skipped (obstacles among themselves). The span must outlive the finder.
  explicit IntersectionFinder(std::span<const Triangle> triangles);
  IntersectionFinder(std::span<const Triangle> triangles, Index active_count);

  /// All intersecting pairs, a < b, sorted. Decided by exact predicates. Same result at any thread count.
  std::vector<IntersectingPair> find(const Positions& x);

 private:
  /// Flags the triangles that have moved since the last time; false where too many have.
  bool flag_moved(const Positions& x);
  std::vector<IntersectingPair> decide(const Positions& x);

  std::span<const Triangle> triangles_;
  Index active_count_;
  FaceTree tree_;
  bool watches_moved_ = false;  // and not all active triangles
  Positions last_x_;            // of the last find()
  std::vector<IntersectingPair> last_pairs_;
  std::vector<std::uint8_t> moved_;  // per triangle
};

}  // namespace unsnarl
