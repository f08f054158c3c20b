#pragma once

#include "applications/curves/crossings.h"

namespace unsnarl {

struct ShrinkOptions {
  int places = 16;  ///< Points of a curve about which it is tried to shrink it (unit: points)
  /// Halvings of its size, at most: 2^-40 is below the digits of a float32 (unit: halvings)
  int halvings = 40;
};

/// The last resort for curves that meet others: each is shrunk about one of its points until it meets none. Curves with
/// two pinned points or with crossings of their own stay as they are. Returns the crossings that are left.
std::vector<SegmentPair> shrink_curves(const CurveNet& net, CurveState& state, const ShrinkOptions& options);

}  // namespace unsnarl
