#pragma once

#include "scene/patch.h"

namespace unsnarl {

/// A face that keeps less than this share of its area is squeezed: a state with such a face is no solution [E132] (no
/// unit)
constexpr double squeezed_area = 1e-4;

/// True where some active triangle has less than `floor` times its area at `start` (and had any).
bool has_squeezed_face(const Patch& patch, const Positions& start, const Positions& x, double floor = squeezed_area);

}  // namespace unsnarl
