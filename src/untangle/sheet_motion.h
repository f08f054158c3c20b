#pragma once

#include <vector>

#include "untangle/contours.h"

namespace unsnarl {

/// How the two sheets of an intersection curve are moved against each other: what is as near as such a motion can be to
/// the one that shortens the curve the fastest (Crossing::direction).
enum class SheetMotion {
  slide,    ///< all of a curve in one direction: where it goes around a limb, what would part its sheets cancels out
  offset,   ///< each sheet along its own normals, everywhere by as much: layers get their order, however curved
  steeper,  ///< the one of these that shortens the curve faster
  free,     ///< every crossing by itself: the curve shrinks along the sheets, too, which crumples them
};

/// What the first sheet of its curve is pushed by against the second at each crossing: 1 along each curve (root mean
/// square), but for `free`.
std::vector<Vec3> sheet_pushes(const Contours& contours, SheetMotion motion);

}  // namespace unsnarl
