#pragma once

#include "geometry/box.h"
#include "geometry/four_lanes.h"

namespace unsnarl {

/// Up to four boxes in single precision, that are compared with another one at a time. Rounding keeps the order of two
/// coordinates or makes them equal: what overlaps always does so here, and a little of what does not.
class FourBoxes {
 public:
  void set(int k, const Box& box) {
    for (int i = 0; i < 3; ++i) {
      lo_[i][k] = static_cast<float>(box.lo[i]);
      hi_[i][k] = static_cast<float>(box.hi[i]);
    }
  }

  /// Bit l: whether box l may overlap box k of the others.
  unsigned overlapping(const FourBoxes& others, int k) const {
    auto apart = lo_[0] > four_times(others.hi_[0][k]);
    apart |= hi_[0] < four_times(others.lo_[0][k]);
    for (int i = 1; i < 3; ++i) {
      apart |= lo_[i] > four_times(others.hi_[i][k]);
      apart |= hi_[i] < four_times(others.lo_[i][k]);
    }
    return ~bits_of(apart) & 15u;
  }

 private:
  FourFloats lo_[3] = {}, hi_[3] = {};
};

}  // namespace unsnarl
