#pragma once

#include <vector>

#include "untangle/local/contours.h"

namespace unsnarl {

/// How the two sheets of an intersection curve are moved against each other: as near as a motion of this kind can be to
/// the one that shortens the curve the fastest (Crossing::direction).
enum class SheetMotion {
  slide,    ///< one translation for the whole curve (useless around a limb: the directions cancel)
  offset,   ///< each sheet along its own normals, by the same length everywhere: layers get their order, however curved
  steeper,  ///< of these two the one that shortens the curve faster
  free,     ///< every crossing by itself: the curve also shrinks along the sheets, which crumples them
};

/// Returns for each crossing the vector (without unit) by which the first sheet of its curve is pushed against the
/// second there. Along each curve the vectors have length 1 (root mean square); with `free` they are the crossings'
/// directions.
std::vector<Vec3> sheet_pushes(const Contours& contours, SheetMotion motion);

}  // namespace unsnarl
