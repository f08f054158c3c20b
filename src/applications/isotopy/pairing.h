#pragma once

#include <array>
#include <span>
#include <vector>

#include "applications/curves/curve_net.h"

namespace unsnarl {

/// In which other curve each lies, the innermost one of several; -1: in none. Precondition: closed, nothing crosses.
std::vector<Index> parents_of(std::span<const Curve> curves);

/// The curve of the end that each of the start becomes: as `pairs` says (numbers at start and end), where it says
/// nothing so that curves lie in each other alike on both sides, and the middles' distances have the smallest sum among
/// such pairings, curves that lie in no other first. Throws std::invalid_argument with the reason where there is none.
std::vector<Index> pair_curves(std::span<const Curve> start, std::span<const Curve> end,
                               std::span<const std::array<std::int32_t, 2>> pairs);

double signed_area(const Curve& curve);

}  // namespace unsnarl
