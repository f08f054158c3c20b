#pragma once

#include "geometry/rounded_box.h"

namespace unsnarl {

/// Up to four rounded boxes side by side, that are compared with another one at a time.
class FourBoxes {
 public:
  void set(int k, const RoundedBox& box) {
    for (int i = 0; i < 3; ++i) {
      lo_[i][k] = box.lo[i];
      hi_[i][k] = box.hi[i];
    }
  }

  /// Bit l: whether box l overlaps the other, or box k of the others.
  unsigned overlapping(const RoundedBox& other) const {
    return overlapping_between([&](int i) { return other.lo[i]; }, [&](int i) { return other.hi[i]; });
  }
  unsigned overlapping(const FourBoxes& others, int k) const {
    return overlapping_between([&](int i) { return others.lo_[i][k]; }, [&](int i) { return others.hi_[i][k]; });
  }

 private:
  template <class Lo, class Hi>
  unsigned overlapping_between(Lo&& lo, Hi&& hi) const {
    auto apart = (lo_[0] > four_times(hi(0))) | (hi_[0] < four_times(lo(0)));
    for (int i = 1; i < 3; ++i) apart |= (lo_[i] > four_times(hi(i))) | (hi_[i] < four_times(lo(i)));
    return ~bits_of(apart) & 15u;
  }

  FourFloats lo_[3] = {}, hi_[3] = {};
};

}  // namespace unsnarl
