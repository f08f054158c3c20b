#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/types.h"

namespace unsnarl {

/// Positive where a, b, c turn left as seen against the normal. Summed from the left: near-ties are decided by
/// rounding, and independent checkers must decide them alike.
double turn(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c);

/// The corners of a polygon, by their places around it, in boxes of boxes. They can be taken out one by one. Neither
/// their number nor where they lie is limited; a box holds what is close in space, as neighbours need not be.
class CornerTree {
 public:
  /// `corners`: vertices; equal ones are one. `points`: where they are. Both must outlive their use.
  void build(std::span<const Index> corners, std::span<const Vec3> points);
  void remove(Index place);
  bool holds(Index place) const { return !is_gone_[place]; }

  /// A place, late rather than early, that holds another vertex in or on the triangle at the places a, b, c, which
  /// turns left; -1: there is none. Decided by the signs of turn() alone: boxes are passed over only where rounding
  /// cannot matter.
  Index find_inside(const Vec3& normal, Index a, Index b, Index c) const;

 private:
  /// A leaf of the tree holds this many places (unit: places)
  static constexpr Index slots_in_leaf = 16;
  struct Node {
    Box box;
    Index last = -1;  // place of all that it holds
  };

  void sort(Index node, Index begin, Index end);
  Node leaf(Index number) const;
  void gather(Index node);

  std::span<const Index> corners_;
  std::span<const Vec3> points_;
  std::vector<Index> place_in_slot_, slot_of_place_;  // slots run through the leaves
  std::vector<std::uint8_t> is_gone_;                 // by place
  Index leaves_ = 0;                                  // a power of two
  std::vector<Node> nodes_;                           // the children of i are 2 i and 2 i + 1; leaves last
};

}  // namespace unsnarl
