#pragma once

#include <cstddef>
#include <span>

#include "unsnarl/curves.h"

/// Every pair of segments, by rational arithmetic. Shares no code with the product.
namespace unsnarl::oracle {

std::size_t count_crossings(std::span<const Curve> curves, std::span<const CurveJoint> joints);

}  // namespace unsnarl::oracle
