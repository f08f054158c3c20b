#pragma once

#include <cstddef>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Which vertices of the file count as one.
struct WeldMap {
  std::vector<Index> vertex_of;  ///< file vertex -> welded vertex; dense ids in the order of first occurrence
  std::vector<Index> first;      ///< welded vertex -> the first file vertex that it stands for
  Index count = 0;               ///< number of welded vertices
  std::size_t merged = 0;        ///< file vertices that count as an earlier one
};

/// Decides it from the positions of the surface, with "equal" meaning exactly equal (-0.0 equals 0.0), or, where
/// `tolerance` > 0, joined by a chain of positions no further apart than it.
///
/// Weld::seams welds open edges, which one face alone uses by the file's ids, and nothing else:
///  (a) a shell is a set of faces connected through shared vertex ids;
///  (b) two open edges with equal end points become one, and their shells too, unless the two faces have equal corners
///      (coincident sheets, as of two-sided hair cards, stay apart). Where more than two open edges lie at one place,
///      edges of one shell find their partners first, opposite directions before equal ones; where no pairing is the
///      only one, all sheets stay apart;
///  (c) if no vertex has two faces (STL), ids say nothing about what is connected: the edges that (b) leaves apart
///      become one, and then the vertices still on open edges wherever their positions are equal, since parts that were
///      sampled differently along a common border meet in single vertices only; again unless coincident faces would
///      share them.
/// A vertex without an open edge is only itself. The ends of an edge of length zero are two vertices, unless the edge
/// is open: that is a point of the boundary.
///
/// Precondition: valid ids, finite coordinates (see mesh/validity.h).
WeldMap weld(const SurfaceView& surface, Weld weld = Weld::seams, double tolerance = 0);

}  // namespace unsnarl
