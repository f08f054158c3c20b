#pragma once

#include "applications/curves/crossings.h"

namespace unsnarl {

struct ShrinkOptions {
  /// Points of a curve about which it is tried to shrink it, and halvings of its size: 2^-40 is below the digits of a
  /// float32.
  int places = 16, halvings = 40;
};

/// The last resort for curves that meet others: each is shrunk about one of its points until it is free. A curve with
/// two pinned points or crossings of its own is left. Returns the crossings left.
std::vector<SegmentPair> shrink_curves(const CurveNet& net, CurveState& state, const ShrinkOptions& options);

}  // namespace unsnarl
