#pragma once

#include "geometry/box.h"
#include "geometry/four_lanes.h"

namespace unsnarl {

/// A box in single precision. Rounding keeps the order of two coordinates or makes them equal: boxes that overlap
/// always do so rounded, and so do a few others. Default: empty.
struct RoundedBox {
  FourFloats lo = four_times(std::numeric_limits<float>::infinity());  // the last of the four says nothing
  FourFloats hi = -lo;

  RoundedBox() = default;
  explicit RoundedBox(const Box& box)
      : lo{static_cast<float>(box.lo[0]), static_cast<float>(box.lo[1]), static_cast<float>(box.lo[2]), 0},
        hi{static_cast<float>(box.hi[0]), static_cast<float>(box.hi[1]), static_cast<float>(box.hi[2]), 0} {}
  void extend(const RoundedBox& other) {
    lo = lo < other.lo ? lo : other.lo;
    hi = hi > other.hi ? hi : other.hi;
  }
  bool overlaps(const RoundedBox& other) const { return bits_of((lo > other.hi) | (other.lo > hi)) == 0; }
};

}  // namespace unsnarl
