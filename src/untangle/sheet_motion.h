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

/// Returns for each crossing the vector (without unit) by which the first sheet of its curve is pushed against the
/// second there. Along each curve the vectors have length 1 (root mean square); with `free` they are the crossings'
/// directions.
std::vector<Vec3> sheet_pushes(const Contours& contours, SheetMotion motion);

}  // namespace unsnarl
