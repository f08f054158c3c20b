#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "mesh/corner_tree.h"

namespace unsnarl {

/// Cuts polygons ear by ear, one polygon after another, keeping its memory.
class EarClipper {
 public:
  /// Appends the triangles, as places in `corners`. Cut off is always the first corner that is an ear, counted from the
  /// start of the polygon; where none is, the first of all. An ear turns left and holds no other vertex. Returns how
  /// many were cut off that are none. `points`: of the corners, at least three; equal corners are one vertex.
  ///
  /// k corners cost about k log k, as long as few corners lie in the triangles that others make with their neighbours.
  std::size_t clip(std::span<const Index> corners, std::span<const Vec3> points, const Vec3& normal,
                   std::vector<Triangle>& triangles);

 private:
  struct Waiting {
    Index place, next;
  };

  Index next_ear(std::span<const Vec3> points, const Vec3& normal);
  bool is_ear(std::span<const Vec3> points, const Vec3& normal, Index place);
  void look_at(Index place);

  CornerTree tree_;
  std::vector<Index> before_, after_;    // places around the polygon
  std::vector<Index> to_look_at_;        // a heap, the smallest place on top
  std::vector<std::uint8_t> is_no_ear_;  // as far as is known
  // Corners wait for another one that lies in their triangle to go: of that one, the first of its entries.
  std::vector<Index> first_waiting_;
  std::vector<Waiting> waiting_;
};

}  // namespace unsnarl
