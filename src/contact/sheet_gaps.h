#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "contact/contact_candidates.h"
#include "contact/near_along_surface.h"
#include "geometry/types.h"
#include "mesh/adjacency.h"

namespace unsnarl {

// Two primitives, a vertex and a triangle or two edges, are of one sheet if they are near along the surface at rest:
// if triangles at them share a vertex, or if a way over the surface joins them that stays within a ball around the
// middle between them. Its radius is the larger of these two.

/// The ball that joins one sheet: as far as the gap, so that what bends by 90 degrees is one (unit: wanted gap)
constexpr double one_sheet_gaps = 1;
/// The ball that joins one sheet: what lies to both sides of a crease of 15 degrees or more does, where no gap opens
/// unless the angle does [E210] (unit: distance of the two at rest)
constexpr double one_sheet_distances = 4;

/// Decides which primitives are of one sheet.
class OneSheet {
 public:
  /// wanted: the gap, a length. The arguments must outlive this.
  OneSheet(std::span<const Triangle> triangles, const Positions& rest, const EdgeTable& edges, double wanted)
      : triangles_(triangles), ways_(triangles, rest, edges), rest_(rest), wanted_(wanted) {}

  /// Whether two primitives of triangles that share no vertex are of one sheet. Fastest where the first triangle is
  /// that of the last call.
  bool holds(const Stencil& stencil, Index of_first, Index of_second);
  /// Whether it is certain that this holds for all primitives of the two triangles; false where it is not known.
  bool holds_for_all(Index first, Index second);

 private:
  std::span<const Triangle> triangles_;
  NearAlongSurface ways_;
  const Positions& rest_;
  double wanted_;
};

/// Two triangles of two sheets, and how far apart they are.
struct SheetGap {
  double distance = std::numeric_limits<double>::infinity();
  Index first = -1, second = -1;  ///< the triangles, first < second; -1: there are none
  Vec3 place = Vec3::Zero();      ///< the middle between their closest points
};

/// Finds where sheets of a surface are closer to each other than wanted.
class SheetGaps {
 public:
  struct Options {
    double wanted = 0;  ///< gap, a length
    /// Whether two triangles have to keep a gap; empty: all have.
    std::function<bool(Index s, Index t)> counts;
    std::function<bool()> stop;  ///< true: WorkStopped is thrown. May be empty
  };
  /// `rest`: where it is decided what one sheet is. The triangles and `rest` must outlive this.
  SheetGaps(std::span<const Triangle> triangles, const Positions& rest, Options options);

  /// The smallest gap that is less than `below`; of several that are equal, that of the smallest numbers. Distances are
  /// computed in double: the error is a few units in the last place of the coordinates. Parallel, deterministic.
  SheetGap smallest(const Positions& x, double below) const;
  /// For every triangle with a gap less than `below` its smallest one, in the order of the triangles; of a pair, both
  /// list it where it is the smallest of both.
  std::vector<SheetGap> narrow(const Positions& x, double below) const;

 private:
  class Search;
  std::span<const Triangle> triangles_;
  const Positions& rest_;
  Options options_;
  ContactCandidates candidates_;
  std::vector<Index> piece_of_;  // per vertex: a number for what edges connect
};

}  // namespace unsnarl
