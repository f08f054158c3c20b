#pragma once

#include <cstddef>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Which vertices of the file count as one.
struct WeldMap {
  std::vector<Index> vertex_of;  ///< file vertex -> identified vertex; dense ids in the order of first occurrence
  std::vector<Index> first;      ///< identified vertex -> the first file vertex that it stands for
  Index count = 0;               ///< number of identified vertices
  std::size_t merged = 0;        ///< file vertices that count as an earlier one
};

/// Decides it from the positions of the surface, with "equal" meaning exactly equal (-0.0 equals 0.0), or, where
/// `tolerance` > 0, joined by a chain of positions no further apart than it.
///
/// Weld::seams, in steps:
///  (a) a shell is a set of faces connected through shared vertex ids;
///  (b) two boundary edges (used by one face) with equal end points are glued, and their shells become one, unless
///      the two faces have equal corners (coincident sheets, as of two-sided hair cards, stay apart). Where more than
///      two edges meet, edges of one shell find their partners first, opposite directions before equal ones; what no
///      pairing settles is glued together;
///  (c) vertices of one shell at equal positions become one, again unless coincident faces would collapse;
///  (d) so do the ends of edges of length zero, where the edges in that point form no loop (a loop is a pinch: the
///      cross-section of a tube that collapsed);
///  (e) if no vertex has two faces, ids say nothing about what is connected (STL): vertices still on a boundary become
///      one wherever their positions are equal, since parts that were sampled differently along a common border
///      meet in single vertices only.
/// Solids that touch, coincident sheets and collapsed cross-sections stay as they are.
///
/// Precondition: valid ids, finite coordinates (see mesh/validity.h).
WeldMap weld(const SurfaceView& surface, Weld weld = Weld::seams, double tolerance = 0);

}  // namespace unsnarl
