#pragma once

#include <vector>

#include "applications/seifert/link_diagram.h"

namespace unsnarl {

/// The rim of a collar goes straight from below one vertex of the link to below another.
struct ShortCut {
  Index edges = 1;   ///< of the link between the two
  Index middle = 0;  ///< the collar is a fan from the first end up to this vertex, counted from the first; then another
};

/// Where the rim of a collar, which hangs down from each vertex of the link by its depth, may leave out vertices, so
/// that thousands of points do not become tens of thousands of needles: for each component, and each edge that is not
/// left out, the short cut that begins with it. Cuts are no longer than `longest`, in the picture.
///
/// Nothing is added to what the collar could meet:
/// - No edge that is cut off has a crossing. In the picture, a cut meets neither the link nor another cut, comes no
///   nearer to other vertices than `room`, and passes by the crossings; so nothing lies between it and the link.
/// - Along the cut, the edges go forward all the time. From the end where a fan has its tip, they are seen lower and
///   lower, up to the middle, and the other end of the cut lowest; so none hides another.
std::vector<std::vector<ShortCut>> rim_short_cuts(const LinkDiagram& diagram,
                                                  const std::vector<std::vector<double>>& depths, double longest,
                                                  double room);

}  // namespace unsnarl
